// One change through time: what it is, who saw it and who saw it gone, how its size went, its alerts and its changes.

import './tracks.css';
import { useResource, useSelect } from '../../app/app';
import { lazy } from '../../app/lazy';
import { address, type Schema } from '../../lib/api';
import { count, metres, placeMetres } from '../../lib/format';
import { historyLink, pointPlace } from '../../lib/place';
import { KindBadge } from '../../ui/badges';
import { ChangesTable } from '../../ui/changes_table';
import { SightStrip } from '../../ui/sight_strip';
import { EmptyState, Loaded } from '../../ui/states';
import { Time } from '../../ui/time';
import { TrackFigures } from '../../ui/track_figures';
import { ViewLink } from '../../ui/view_link';
import { AlertLine } from '../alerts/alert_line';
import { findingsOf } from './findings';
import { TrackStateBadge } from './track_state';

type Track = Schema<'TrackDetail'>;

const trackAddress = (id: number) => address('/api/v1/tracks/{id}', { path: { id } });

export function TrackView({ id }: { id: string }) {
  const track = useResource(trackAddress(Number(id)));
  return (
    <Loaded of={track} what="track">
      {(data) => (
        <>
          <div class="view-head">
            <h1>Track {data.id}</h1>
            <KindBadge kind={data.kind} />
            <TrackStateBadge track={data} />
            <span class="muted">at {data.site}</span>
            <span class="spacer" />
            <a class="button" href={historyLink(data.site, pointPlace(data.centroid_m))}>
              History of this place
            </a>
          </div>
          <div class="panels">
            <Facts track={data} />
            <Alerts track={data} />
            <Sights track={data} />
            <Sizes track={data} />
            <Changes track={data} />
          </div>
        </>
      )}
    </Loaded>
  );
}

function Facts({ track }: { track: Track }) {
  return (
    <section class="panel" aria-labelledby="facts">
      <header class="panel-head">
        <h2 id="facts">What it is</h2>
      </header>
      <dl class="figures panel-body">
        <div>
          <dt>First seen</dt>
          <dd>
            <Time at={track.first_seen_at} site={track.site} /> in{' '}
            <a href={`/scans/${track.first_scan}`}>scan {track.first_scan}</a>
          </dd>
        </div>
        <div>
          <dt>Last seen</dt>
          <dd>
            <Time at={track.last_seen_at} site={track.site} /> in{' '}
            <a href={`/scans/${track.last_scan}`}>scan {track.last_scan}</a>
          </dd>
        </div>
        {track.ended_at !== null && track.ended_scan !== null && (
          <div>
            <dt>Seen gone</dt>
            <dd>
              <Time at={track.ended_at} site={track.site} /> in{' '}
              <a href={`/scans/${track.ended_scan}`}>scan {track.ended_scan}</a>
            </dd>
          </div>
        )}
        <TrackFigures track={track} />
      </dl>
      <Moved track={track} other={track.moved_from} words="It was moved here from" />
      <Moved track={track} other={track.moved_to} words="It was moved to" />
    </section>
  );
}

/** The other half of a moved pair: the same object at its other place. */
function Moved({ track, other, words }: { track: Track; other: number | null; words: string }) {
  const found = useResource(other === null ? undefined : trackAddress(other)).data;
  if (other === null) return null;
  const apart_m = found && Math.hypot(...track.centroid_m.map((part, axis) => part - (found.centroid_m[axis] ?? 0)));
  return (
    <p class="panel-body moved">
      {words} <a href={`/tracks/${other}`}>track {other}</a>
      {found && apart_m !== undefined && (
        <>
          , {metres(apart_m)} away at {placeMetres(found.centroid_m)} <KindBadge kind={found.kind} />
        </>
      )}
    </p>
  );
}

function Alerts({ track }: { track: Track }) {
  return (
    <section class="panel" aria-labelledby="alerts">
      <header class="panel-head">
        <h2 id="alerts">Its alerts</h2>
      </header>
      {track.alerts.length === 0 ? (
        <EmptyState title="It raised no alert." />
      ) : (
        <ul class="alert-lines">
          {track.alerts.map((alert) => (
            <li key={alert.id}>
              <AlertLine alert={alert} site={false} />
            </li>
          ))}
        </ul>
      )}
    </section>
  );
}

function Sights({ track }: { track: Track }) {
  return (
    <section class="panel panel-wide" aria-labelledby="sights">
      <header class="panel-head">
        <h2 id="sights">Who saw it</h2>
        <span class="muted">scan by scan, the earliest first</span>
      </header>
      <div class="panel-body">
        <SightStrip observations={track.observations} site={track.site} />
        <Runs track={track} />
      </div>
    </section>
  );
}

const kSights = { seen: 'seen', absent: 'absent', unseen: 'out of sight' } as const;

/** The same as the strip, with times and scans. */
function Runs({ track }: { track: Track }) {
  if (track.observations.length === 0) return null;
  return (
    <details class="runs">
      <summary>Times and scans</summary>
      <div class="table-scroll" tabIndex={0} role="region" aria-label="observations">
        <table>
          <thead>
            <tr>
              <th scope="col">Sight</th>
              <th scope="col" class="numeric">
                Vantage
              </th>
              <th scope="col">From</th>
              <th scope="col">To</th>
              <th scope="col" class="numeric">
                Scans
              </th>
              <th scope="col">First and last</th>
            </tr>
          </thead>
          <tbody>
            {track.observations.map((run) => (
              <tr key={`${run.vantage} ${run.first_scan}`}>
                <td>{kSights[run.sight]}</td>
                <td class="numeric">{run.vantage}</td>
                <td>
                  <Time at={run.from} site={track.site} />
                </td>
                <td>
                  <Time at={run.to} site={track.site} />
                </td>
                <td class="numeric">{count(run.scans)}</td>
                <td>
                  <a href={`/scans/${run.first_scan}`}>scan {run.first_scan}</a>
                  {run.last_scan !== run.first_scan && (
                    <>
                      {', '}
                      <a href={`/scans/${run.last_scan}`}>scan {run.last_scan}</a>
                    </>
                  )}
                </td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </details>
  );
}

const SizeCharts = lazy(() => import('./size_charts').then((module) => module.SizeCharts));
/** So many of the latest changes are drawn. */
const kMostDrawn = 1000;

/** How large it was found from scan to scan; a single finding is no course. */
function Sizes({ track }: { track: Track }) {
  const page = useResource(
    address('/api/v1/tracks/{id}/changes', { path: { id: track.id }, query: { limit: kMostDrawn } }),
  );
  const findings = findingsOf(page.data?.items ?? []);
  if (findings.length < 2) return null;
  return (
    <section class="panel panel-wide" aria-labelledby="sizes">
      <header class="panel-head">
        <h2 id="sizes">Its size through time</h2>
        {page.data?.next != null && <span class="muted">by the latest {count(kMostDrawn)} changes</span>}
      </header>
      <div class="panel-body charts">
        <SizeCharts site={track.site} findings={findings} />
      </div>
    </section>
  );
}

function Changes({ track }: { track: Track }) {
  const cursor = useSelect((state) => state.location.query['cursor']);
  const page = useResource(
    address('/api/v1/tracks/{id}/changes', { path: { id: track.id }, query: { limit: 50, cursor } }),
  );
  return (
    <section class="panel panel-wide" aria-labelledby="changes">
      <header class="panel-head">
        <h2 id="changes">Its changes</h2>
        <span class="muted">what each scan that saw it found of it</span>
      </header>
      <div class="panel-body">
        <ChangesTable
          caption={`changes of track ${track.id}`}
          page={page}
          of="track"
          empty={
            <EmptyState title="Its changes are not stored any more.">
              <ViewLink to="/storage">What retention deleted</ViewLink>
            </EmptyState>
          }
        />
      </div>
    </section>
  );
}
