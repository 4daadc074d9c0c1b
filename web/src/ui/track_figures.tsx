// What a change through time is, in figures: the same beside its alerts as on its own page.

import { type Schema } from '../lib/api';
import { count, counted, duration, percent, placeMetres, sizeMetres, volume } from '../lib/format';

type Track = Schema<'Track'>;

/** From the first scan that saw it to the last. */
export const lastedSeconds = ({ first_seen_at, last_seen_at }: Track): number =>
  (Date.parse(last_seen_at) - Date.parse(first_seen_at)) / 1000;

/** Entries of a list of figures. */
export function TrackFigures({ track }: { track: Track }) {
  const { size_m, volume_m3, centroid_m, points, confidence, seen, absent } = track;
  return (
    <>
      <div>
        <dt>Size</dt>
        <dd>{sizeMetres(size_m)}</dd>
      </div>
      <div>
        <dt>Volume of its box</dt>
        <dd>{volume(volume_m3)}</dd>
      </div>
      <div>
        <dt>Place</dt>
        <dd>{placeMetres(centroid_m)}</dd>
      </div>
      <div>
        <dt>Points</dt>
        <dd>{counted(points, 'point')}</dd>
      </div>
      <div>
        <dt>Confidence</dt>
        <dd
          title={`seen free ${percent(confidence.free)}, supported ${percent(confidence.supported)}, could not tell ${percent(confidence.unknown)}`}
        >
          {percent(confidence.value)}
        </dd>
      </div>
      <div>
        <dt>Lasted</dt>
        <dd>
          {duration(lastedSeconds(track))}, in {counted(seen, 'scan')}
          {absent > 0 && `; absent in ${count(absent)}`}
        </dd>
      </div>
    </>
  );
}
