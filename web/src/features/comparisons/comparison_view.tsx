// One comparison: how far it is, what it was made with, and what it found.

import './comparisons.css';
import { useResource, useSelect } from '../../app/app';
import { useAskAgain } from '../../app/polling';
import { useZone } from '../../app/sites';
import { address, type Schema } from '../../lib/api';
import { percent } from '../../lib/format';
import { referenceInWords } from '../../lib/reference';
import { ChangesTable } from '../../ui/changes_table';
import { EmptyState, Loaded } from '../../ui/states';
import { Time } from '../../ui/time';
import { ComparisonStateBadge, isUnfinished } from './comparison_state';
import { Findings } from './findings';
import { ParametersOf } from './parameters_of';
import { Priors } from './priors';

type Comparison = Schema<'Comparison'>;

/** The end of a comparison is told by an event; how far it is, is asked this often. */
const kAskProgressMs = 700;

export function ComparisonView({ id }: { id: string }) {
  const from = address('/api/v1/comparisons/{id}', { path: { id: Number(id) } });
  const comparison = useResource(from);
  useAskAgain(from, comparison.data && isUnfinished(comparison.data) ? kAskProgressMs : undefined);
  return (
    <Loaded of={comparison} what="comparison">
      {(data) => (
        <>
          <Head comparison={data} />
          {isUnfinished(data) ? <Progress comparison={data} /> : <Result comparison={data} />}
        </>
      )}
    </Loaded>
  );
}

function Head({ comparison }: { comparison: Comparison }) {
  const zone = useZone(comparison.site);
  const scan = useResource(address('/api/v1/scans/{id}', { path: { id: comparison.scan } })).data;
  return (
    <div class="view-head">
      <h1>Comparison {comparison.id}</h1>
      <ComparisonStateBadge comparison={comparison} />
      <span class="muted">
        of <a href={`/scans/${comparison.scan}?comparison=${comparison.id}`}>scan {comparison.scan}</a>
        {scan && (
          <>
            {' '}
            by {scan.sensor}, <Time at={scan.captured_at} site={scan.site} />,
          </>
        )}{' '}
        with {referenceInWords(comparison.reference, zone)}
      </span>
      <span class="spacer" />
      {comparison.state === 'done' && (
        <a class="button" href={`/comparisons/${comparison.id}/3d`}>
          In 3D
        </a>
      )}
      <a class="button" href={`/compare?like=${comparison.id}`}>
        Again, with other parameters
      </a>
    </div>
  );
}

function Progress({ comparison }: { comparison: Comparison }) {
  const words =
    comparison.state === 'queued' ? 'It waits for its turn.' : `It is under way: ${percent(comparison.progress)}.`;
  return (
    <section class="panel comparison-progress" aria-live="polite">
      <div class="panel-body">
        <p>{words}</p>
        <progress max={1} value={comparison.progress} aria-label="Progress" />
        <p class="muted">The result stands here as soon as it is there.</p>
      </div>
    </section>
  );
}

function Result({ comparison }: { comparison: Comparison }) {
  return (
    <div class="panels">
      {comparison.failure !== null && (
        <p class="panel panel-wide panel-body comparison-failure" role="alert">
          It failed: {comparison.failure}
        </p>
      )}
      <Findings comparison={comparison} />
      <ParametersOf comparison={comparison} />
      <Changes comparison={comparison} />
      <Priors comparison={comparison} />
    </div>
  );
}

function Changes({ comparison }: { comparison: Comparison }) {
  const cursor = useSelect((state) => state.location.query['cursor']);
  const page = useResource(
    address('/api/v1/comparisons/{id}/changes', { path: { id: comparison.id }, query: { limit: 50, cursor } }),
  );
  return (
    <section class="panel panel-wide" aria-labelledby="changes">
      <header class="panel-head">
        <h2 id="changes">What it found</h2>
      </header>
      <div class="panel-body">
        <ChangesTable
          caption={`changes of comparison ${comparison.id}`}
          page={page}
          of="comparison"
          empty={<EmptyState title="Nothing changed, as far as could be judged." />}
        />
      </div>
    </section>
  );
}
