// One scan: where and when it was taken, how its pose fits, what comparisons found, and why its priors were chosen.

import './scans.css';
import { useState } from 'preact/hooks';
import { loader, navigate, setQuery, showProblem, showToast, useResource, useSelect } from '../../app/app';
import { address, type Schema, send } from '../../lib/api';
import { bytes, count, counted, degrees, metres, percent, placeMetres } from '../../lib/format';
import { Problem } from '../../lib/problem';
import { type Resource } from '../../lib/resources';
import { StateBadge } from '../../ui/badges';
import { Dialog } from '../../ui/dialog';
import { EmptyState, Loaded } from '../../ui/states';
import { Time } from '../../ui/time';
import { ViewLink } from '../../ui/view_link';
import { RegistrationBadge, ScanStateBadge } from './badges';
import { CandidatesTable } from './candidates_table';

type Scan = Schema<'Scan'>;

const addressOf = (id: number) => address('/api/v1/scans/{id}', { path: { id } });

export function ScanView({ id }: { id: string }) {
  const scan = useResource(addressOf(Number(id)));
  return (
    <Loaded of={scan} what="scan">
      {(data) => (
        <>
          <div class="view-head">
            <h1>Scan {data.id}</h1>
            <ScanStateBadge scan={data} />
            <span class="muted">
              by <ViewLink to={`/sensors/${encodeURIComponent(data.sensor)}`}>{data.sensor}</ViewLink> at {data.site},{' '}
              <Time at={data.captured_at} site={data.site} whole />
            </span>
          </div>
          <div class="panels">
            <Facts scan={data} />
            <Keeping key={data.id} scan={data} resource={scan} />
            <Comparisons scan={data} />
          </div>
        </>
      )}
    </Loaded>
  );
}

function Facts({ scan }: { scan: Scan }) {
  const { registration } = scan;
  return (
    <section class="panel" aria-labelledby="facts">
      <header class="panel-head">
        <h2 id="facts">What was taken</h2>
      </header>
      <dl class="figures panel-body">
        <div>
          <dt>Points</dt>
          <dd>
            {counted(scan.points, 'point')}
            {scan.intensity && ', with intensity'}
          </dd>
        </div>
        {scan.grid && (
          <div>
            <dt>Grid of shots</dt>
            <dd>
              {count(scan.grid.rows)} × {count(scan.grid.columns)}
            </dd>
          </div>
        )}
        <div>
          <dt>Kept in</dt>
          <dd>{bytes(scan.stored_bytes)}</dd>
        </div>
        <div>
          <dt>Received</dt>
          <dd>
            <Time at={scan.received_at} site={scan.site} />
          </dd>
        </div>
        <div>
          <dt>Taken from</dt>
          <dd>
            {placeMetres(scan.pose.position_m)}, vantage {scan.vantage}
          </dd>
        </div>
        <div>
          <dt>Fit of its pose</dt>
          <dd>
            <RegistrationBadge registration={registration} />{' '}
            {registration.against !== null && (
              <>
                on <a href={`/scans/${registration.against}`}>scan {registration.against}</a>
              </>
            )}
          </dd>
        </div>
        {registration.state !== 'none' && (
          <div>
            <dt>Corrected by</dt>
            <dd>
              {metres(registration.shift_m, 4)}, {degrees(registration.turn_deg, 4)}
            </dd>
          </div>
        )}
        {registration.inliers !== null && (
          <div>
            <dt>Surfaces that agree</dt>
            <dd>
              {percent(registration.inliers, 1)}
              {registration.residual_m !== null && `, to ${metres(registration.residual_m, 4)}`}
            </dd>
          </div>
        )}
        <div>
          <dt>SHA-256 of the file</dt>
          <dd>
            <code title={scan.sha256}>{scan.sha256.slice(0, 16)}…</code>
          </dd>
        </div>
        <div>
          <dt>The raw observation</dt>
          <dd class="actions">
            {(['pcd', 'ply', 'csv'] as const).map((format) => (
              <a
                key={format}
                href={`/api/v1/scans/${scan.id}/points?format=${format}`}
                download={`scan-${scan.id}.${format}`}
              >
                {format.toUpperCase()}
              </a>
            ))}
          </dd>
        </div>
      </dl>
      {scan.failure !== null && <p class="panel-body scan-failure">{scan.failure}</p>}
    </section>
  );
}

/** Pinned scans are never deleted; a note says why. Tied to the version that is shown. */
function Keeping({ scan, resource }: { scan: Scan; resource: Resource<Scan> }) {
  const [note, setNote] = useState(scan.note);
  const [asking, setAsking] = useState(false);
  const edit = async (body: Schema<'ScanEdit'>): Promise<void> => {
    try {
      const path = { id: scan.id };
      loader.put(addressOf(scan.id), await send('patch', '/api/v1/scans/{id}', { path, body, etag: resource.etag }));
      loader.invalidate((key) => key.startsWith('/api/v1/scans?'));
      showToast('good', 'Kept.');
    } catch (failure) {
      if (!(failure instanceof Problem)) throw failure;
      showProblem(failure);
      loader.invalidate((key) => key === addressOf(scan.id));
    }
  };
  const remove = async (): Promise<void> => {
    setAsking(false);
    try {
      await send('delete', '/api/v1/scans/{id}', { path: { id: scan.id } });
      loader.invalidate((key) => key.startsWith('/api/v1/scans?'));
      showToast('good', `Scan ${scan.id} was deleted.`);
      navigate('/scans');
    } catch (failure) {
      if (!(failure instanceof Problem)) throw failure;
      showProblem(failure);
    }
  };
  return (
    <section class="panel" aria-labelledby="keeping">
      <header class="panel-head">
        <h2 id="keeping">Keeping</h2>
        {scan.pinned && <StateBadge tone="good">pinned</StateBadge>}
      </header>
      <form
        class="panel-body"
        onSubmit={(event) => {
          event.preventDefault();
          void edit({ note });
        }}
      >
        <label class="field">
          Note
          <textarea rows={2} maxLength={2000} value={note} onInput={(event) => setNote(event.currentTarget.value)} />
        </label>
        <div class="actions">
          <button type="submit" disabled={note === scan.note}>
            Keep the note
          </button>
          <button type="button" onClick={() => void edit({ pinned: !scan.pinned })}>
            {scan.pinned ? 'Unpin' : 'Pin: never delete it'}
          </button>
          <button type="button" disabled={scan.pinned} onClick={() => setAsking(true)}>
            Delete
          </button>
        </div>
      </form>
      {asking && (
        <Dialog title={`Delete scan ${scan.id}?`} onClose={() => setAsking(false)}>
          <p>Its points, its comparisons and their changes are gone for good.</p>
          <div class="actions">
            <button type="button" class="primary" onClick={() => void remove()}>
              Delete it
            </button>
            <button type="button" data-first onClick={() => setAsking(false)}>
              Keep it
            </button>
          </div>
        </Dialog>
      )}
    </section>
  );
}

function Comparisons({ scan }: { scan: Scan }) {
  const asked = useSelect((state) => state.location.query['comparison']);
  const shown = scan.comparisons.find(({ id }) => String(id) === asked) ?? scan.comparisons[0];
  return (
    <section class="panel panel-wide" aria-labelledby="comparisons">
      <header class="panel-head">
        <h2 id="comparisons">Comparisons</h2>
        <div class="actions" role="group" aria-label="Comparison">
          {scan.comparisons.map(({ id, reference }) => (
            <button
              key={id}
              type="button"
              aria-pressed={id === shown?.id}
              onClick={() => setQuery({ comparison: String(id) }, { replace: true })}
            >
              with {referenceInWords(reference)}
            </button>
          ))}
        </div>
      </header>
      {shown ? <OneComparison id={shown.id} scan={scan.id} /> : <EmptyState title="It was compared with nothing." />}
    </section>
  );
}

function referenceInWords(reference: Schema<'Reference'>): string {
  if (reference === 'previous') return 'what was before';
  if (reference === 'baseline') return 'what is normal';
  return 'scans' in reference ? `scans ${reference.scans.join(', ')}` : 'a time range';
}

function OneComparison({ id, scan }: { id: number; scan: number }) {
  const comparison = useResource(address('/api/v1/comparisons/{id}', { path: { id } }));
  return (
    <Loaded of={comparison} what="comparison">
      {(data) => (
        <>
          <dl class="figures panel-body">
            <div>
              <dt>State</dt>
              <dd>{data.state === 'running' ? `running, ${percent(data.progress)}` : data.state}</dd>
            </div>
            <div>
              <dt>Found</dt>
              <dd>
                <ViewLink to={`/comparisons/${data.id}`}>{counted(data.changes, 'change')}</ViewLink>
              </dd>
            </div>
            <div>
              <dt>Could be judged</dt>
              <dd>{percent(data.testable, 1)} of the points</dd>
            </div>
            {(['unchanged', 'added', 'removed', 'occluded', 'unseen', 'invalid'] as const).map((name) => (
              <div key={name}>
                <dt>{name}</dt>
                <dd>{counted(data.counts[name], 'point')}</dd>
              </div>
            ))}
            <div>
              <dt>Took</dt>
              <dd>{count(data.timings_ms['total'] ?? 0)} ms</dd>
            </div>
          </dl>
          {data.warnings.map((warning) => (
            <p key={warning} class="panel-body scan-warning">
              {warning}
            </p>
          ))}
          {data.failure !== null && <p class="panel-body scan-failure">{data.failure}</p>}
          <CandidatesTable scan={scan} comparison={data.id} />
        </>
      )}
    </Loaded>
  );
}
