// Any place, any past moment: whether it was free, occupied, or out of sight.

import './history.css';
import { loader, setQuery, useResource, useSelect } from '../../app/app';
import { useSites, useZone } from '../../app/sites';
import { address, type Schema } from '../../lib/api';
import { placeMetres, sizeMetres } from '../../lib/format';
import { isPoint, type Place, placeOf, placeQuery } from '../../lib/place';
import { SitePicker } from '../../ui/site_picker';
import { EmptyPanel, EmptyState } from '../../ui/states';
import { Calendar } from './calendar';
import { Course } from './course';
import { PlaceForm } from './place_form';
import { PlacePicture } from './place_picture';
import { type Range } from './range';
import { RangeBar } from './range_bar';

/** What the link says about the time; nothing where it says nothing, or no time. */
function rangeIn(query: Readonly<Record<string, string>>, now_ms: number): Range | undefined {
  const from_ms = Date.parse(query['from'] ?? '');
  const to_ms = Date.parse(query['to'] ?? '');
  if (Number.isNaN(from_ms)) return undefined;
  return { from_ms, to_ms: Number.isNaN(to_ms) ? Math.max(now_ms, from_ms + 60_000) : to_ms };
}

export function HistoryView() {
  const sites = useSites();
  const query = useSelect((state) => state.location.query);
  const site = query['site'] ?? sites[0]?.name;
  return (
    <>
      <div class="view-head">
        <h1>History</h1>
        <span class="muted">what was at a place through time, from the stored rays</span>
        {site !== undefined && (
          <SitePicker
            site={site}
            onSite={(name) => setQuery({ site: name, point: undefined, box: undefined, interval: undefined })}
          />
        )}
      </div>
      {site === undefined ? (
        <EmptyPanel title="There is no site yet.">
          <p>A place can be asked as soon as scans are stored.</p>
        </EmptyPanel>
      ) : (
        <OfSite key={site} site={site} />
      )}
    </>
  );
}

function OfSite({ site }: { site: string }) {
  const zone = useZone(site);
  const query = useSelect((state) => state.location.query);
  const now_ms = useSelect((state) => state.now_ms);
  const place = placeOf(query);
  const { from, to } = query;
  const asked = place && address('/api/v1/history', { query: { site, ...placeQuery(place), from, to } });
  const history = useResource(asked);
  const latest = useResource(address('/api/v1/scans', { query: { site, limit: 1 } })).data?.items[0];
  const range = rangeIn(query, now_ms);
  const around_ms = range?.from_ms ?? (latest ? Date.parse(latest.captured_at) : now_ms);
  const isOld = latest !== undefined && to === undefined && isBehind(history.data, latest.captured_at);
  const key = JSON.stringify(place);
  const ask = (chosen: Place): void =>
    setQuery({ site, point: undefined, box: undefined, interval: undefined, ...placeQuery(chosen) });
  return (
    <div class="history">
      <section class="panel" aria-labelledby="place">
        <header class="panel-head">
          <h2 id="place">Place</h2>
          {place && <span class="muted">{placeWords(place)}</span>}
        </header>
        <PlacePicture site={site} place={place} onPlace={ask} />
        <PlaceForm key={key} place={place} onPlace={ask} />
      </section>
      <section class="panel" aria-labelledby="when">
        <header class="panel-head">
          <h2 id="when">When</h2>
          <span class="muted">days of {zone}</span>
        </header>
        <div class="panel-body">
          <Calendar site={site} zone={zone} range={range} around_ms={around_ms} />
        </div>
      </section>
      <section class="panel panel-wide" aria-labelledby="course">
        <header class="panel-head">
          <h2 id="course">What was there</h2>
          {isOld && (
            <button type="button" onClick={() => loader.invalidate((known) => known === asked)}>
              Newer scans have arrived: ask again
            </button>
          )}
        </header>
        <RangeBar range={range} zone={zone} around_ms={around_ms} />
        {place ? (
          <Course history={history} site={site} place={place} range={range} />
        ) : query['point'] !== undefined || query['box'] !== undefined ? (
          <BrokenLink />
        ) : (
          <EmptyState title="No place is chosen.">
            <p>Click it in the picture, give its coordinates, or follow a link from an alert, a change or a track.</p>
          </EmptyState>
        )}
      </section>
    </div>
  );
}

const isBehind = (history: Schema<'History'> | undefined, latest: string): boolean => {
  const last = history?.intervals.at(-1);
  return last !== undefined && Date.parse(last.to) < Date.parse(latest);
};

const placeWords = (place: Place): string =>
  isPoint(place)
    ? placeMetres(place.min_m)
    : `${sizeMetres(place.max_m.map((part, axis) => part - (place.min_m[axis] ?? 0)))} at ${placeMetres(
        place.min_m.map((part, axis) => (part + (place.max_m[axis] ?? 0)) / 2),
      )}`;

function BrokenLink() {
  return (
    <EmptyState title="This link names no place.">
      <p>
        It should end in <code>point=x,y,z</code> or <code>box=x0,y0,z0,x1,y1,z1</code>, in metres. Give the coordinates
        above.
      </p>
    </EmptyState>
  );
}
