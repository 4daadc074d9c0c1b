import { setQuery, useResource, useSelect } from '../../app/app';
import { useZone } from '../../app/sites';
import { address, type Schema } from '../../lib/api';
import { count, counted, percent } from '../../lib/format';
import { referenceInWords } from '../../lib/reference';
import { EmptyState, Loaded } from '../../ui/states';
import { ViewLink } from '../../ui/view_link';
import { CandidatesTable } from './candidates_table';

/** What comparisons of a scan found, one at a time, and why its priors were chosen. */
export function Comparisons({ scan }: { scan: Schema<'Scan'> }) {
  const zone = useZone(scan.site);
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
              with {referenceInWords(reference, zone)}
            </button>
          ))}
          <a class="button" href={`/compare?scan=${scan.id}`}>
            Compare by hand …
          </a>
        </div>
      </header>
      {shown ? <OneComparison id={shown.id} scan={scan.id} /> : <EmptyState title="It was compared with nothing." />}
    </section>
  );
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
