// What was at a place in a range: in words, on a line of time, and as a table.

import { setQuery, useSelect } from '../../app/app';
import { useZone } from '../../app/sites';
import { type Resource } from '../../lib/resources';
import { type Schema } from '../../lib/api';
import { count, counted, dateTime, shortTime } from '../../lib/format';
import { type Place, placeQuery } from '../../lib/place';
import { Loaded } from '../../ui/states';
import { IntervalsTable, PresenceBadge } from './intervals_table';
import { type Range } from './range';
import { Timeline } from './timeline';
import { rangeOf } from './timeline_scale';
import { historyInWords, type Interval } from './words';

type History = Schema<'History'>;

export interface CourseProps {
  history: Resource<History>;
  site: string;
  place: Place;
  /** As the link gives it; without one it is that of the intervals. */
  range: Range | undefined;
}

export function Course({ history, site, place, range }: CourseProps) {
  return (
    <Loaded of={history} what="history of this place">
      {(data) => <Told history={data} site={site} place={place} range={range ?? rangeOf(data.intervals)} />}
    </Loaded>
  );
}

interface ToldProps {
  history: History;
  site: string;
  place: Place;
  range: Range | undefined;
}

function Told({ history, site, place, range }: ToldProps) {
  const zone = useZone(site);
  const now_ms = useSelect((state) => state.now_ms);
  const selected = useSelect((state) => Number(state.location.query['interval'])) || undefined;
  const { intervals } = history;
  const shown = intervals.find(({ first_scan }) => first_scan === selected);
  const select = (firstScan: number): void => setQuery({ interval: String(firstScan) }, { replace: true });
  return (
    <>
      <div class="panel-body course-words" role="status">
        {historyInWords(intervals, (time) => shortTime(time, zone, now_ms)).map((sentence) => (
          <p key={sentence}>{sentence}</p>
        ))}
        <p class="muted">
          {counted(history.scans, 'scan')} asked.
          {!history.complete && ` Only the latest ${count(history.scans)} of this time: choose a shorter one for all.`}
        </p>
      </div>
      {range && intervals.length > 0 && (
        <div class="panel-body">
          <p class="muted timeline-ends">
            <span>{dateTime(new Date(range.from_ms).toISOString(), zone)}</span>
            <span>{dateTime(new Date(range.to_ms).toISOString(), zone)}</span>
          </p>
          <Timeline intervals={intervals} range={range} zone={zone} selected={selected} onSelect={select} />
          <Legend />
          {shown && <OneInterval interval={shown} before={toldBefore(intervals, shown)} place={place} site={site} />}
          <h3>All intervals</h3>
          <IntervalsTable intervals={intervals} site={site} selected={selected} onSelect={select} />
        </div>
      )}
    </>
  );
}

function Legend() {
  return (
    <ul class="legend">
      <li>
        <span class="swatch piece-free" /> free
      </li>
      <li>
        <span class="swatch piece-occupied" /> occupied
      </li>
      <li>
        <span class="swatch piece-not_seen" /> not seen
      </li>
      <li>
        <span class="swatch" /> no scan, or it changed between two
      </li>
    </ul>
  );
}

/** The interval before one that shows the place differently; what could not see it tells nothing. */
function toldBefore(intervals: readonly Interval[], interval: Interval): Interval | undefined {
  if (interval.state === 'not_seen') return undefined;
  return intervals.slice(0, intervals.indexOf(interval)).findLast(({ state }) => state !== 'not_seen');
}

/** The interval that is looked at, and how it came about: between which two scans the place changed. */
function OneInterval({
  interval,
  before,
  place,
  site,
}: {
  interval: Interval;
  before: Interval | undefined;
  place: Place;
  site: string;
}) {
  const zone = useZone(site);
  const from_ms = Date.parse(interval.from);
  const to_ms = Date.parse(interval.to);
  const room_ms = Math.max(30_000, (to_ms - from_ms) / 4);
  const zoom = (): void =>
    setQuery({
      ...placeQuery(place),
      from: new Date(from_ms - room_ms).toISOString(),
      to: new Date(to_ms + room_ms).toISOString(),
    });
  return (
    <section class="one-interval" aria-label="The chosen interval">
      <p>
        <PresenceBadge state={interval.state} /> {dateTime(interval.from, zone)} to {dateTime(interval.to, zone)}, in{' '}
        {counted(interval.scans, 'scan')} (<ScanLinks interval={interval} />
        ).
        {interval.not_seen > 0 && ` ${counted(interval.not_seen, 'scan')} between could not see it.`}
      </p>
      {before && (
        <p>
          It came about between <a href={`/scans/${before.last_scan}`}>scan {before.last_scan}</a> and{' '}
          <a href={`/scans/${interval.first_scan}`}>scan {interval.first_scan}</a>:{' '}
          <a href={`/compare?scan=${interval.first_scan}&reference=scans&scans=${before.last_scan}`}>
            compare these two
          </a>
          .
        </p>
      )}
      <div class="actions">
        <button type="button" onClick={zoom}>
          Zoom to it
        </button>
      </div>
    </section>
  );
}

function ScanLinks({ interval }: { interval: Interval }) {
  const { first_scan, last_scan } = interval;
  return (
    <>
      <a href={`/scans/${first_scan}`}>scan {first_scan}</a>
      {last_scan !== first_scan && (
        <>
          {' to '}
          <a href={`/scans/${last_scan}`}>scan {last_scan}</a>
        </>
      )}
    </>
  );
}
