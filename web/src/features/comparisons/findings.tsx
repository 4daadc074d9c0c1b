// The figures of a comparison: what became of each point, how much could be judged, and how long it took.

import { type Schema } from '../../lib/api';
import { count, counted, duration, percent } from '../../lib/format';
import { Time } from '../../ui/time';

type Comparison = Schema<'Comparison'>;

const kClasses = [
  { name: 'unchanged', words: 'an earlier scan supports them' },
  { name: 'added', words: 'the place was free before' },
  { name: 'removed', words: 'of earlier scans; the place is free now' },
  { name: 'discrepancy', words: 'two scans of the same time disagree' },
  { name: 'occluded', words: 'behind what was seen earlier' },
  { name: 'unseen', words: 'no earlier scan looked there' },
  { name: 'invalid', words: 'no measurement of a surface' },
] as const;

export function Findings({ comparison }: { comparison: Comparison }) {
  return (
    <section class="panel" aria-labelledby="findings">
      <header class="panel-head">
        <h2 id="findings">Figures</h2>
      </header>
      <dl class="figures panel-body">
        <div>
          <dt>Found</dt>
          <dd>{counted(comparison.changes, 'change')}</dd>
        </div>
        <div>
          <dt>Could be judged</dt>
          <dd>{percent(comparison.testable, 1)} of the points</dd>
        </div>
        <div>
          <dt>Asked for</dt>
          <dd>
            <Time at={comparison.created_at} site={comparison.site} />
          </dd>
        </div>
        {comparison.finished_at !== null && (
          <div>
            <dt>Done</dt>
            <dd>
              <Time at={comparison.finished_at} site={comparison.site} />
            </dd>
          </div>
        )}
      </dl>
      <Points comparison={comparison} />
      <Timings timings_ms={comparison.timings_ms} />
      {comparison.warnings.map((warning) => (
        <p key={warning} class="panel-body comparison-warning">
          {warning}
        </p>
      ))}
    </section>
  );
}

/** Each class of points with its share as a bar. */
function Points({ comparison }: { comparison: Comparison }) {
  const { counts, id } = comparison;
  const most = Math.max(1, ...Object.values(counts));
  return (
    <div class="panel-body">
      <h3>Points</h3>
      <table class="bars">
        <caption class="visually-hidden">Points by what became of them</caption>
        <tbody>
          {kClasses.map(({ name, words }) => (
            <tr key={name}>
              <th scope="row" title={words}>
                {name}
              </th>
              <td class="numeric">{count(counts[name])}</td>
              <td class="bar-cell" aria-hidden="true">
                <span class={`bar bar-${name}`} style={{ width: `${((counts[name] / most) * 100).toFixed(2)}%` }} />
              </td>
            </tr>
          ))}
        </tbody>
      </table>
      <p class="actions">
        <span class="muted">Changed points:</span>
        {(['ply', 'pcd', 'csv'] as const).map((format) => (
          <a
            key={format}
            href={`/api/v1/comparisons/${id}/points?class=added,removed&format=${format}`}
            download={`comparison-${id}-changed.${format}`}
          >
            {format.toUpperCase()}
          </a>
        ))}
      </p>
    </div>
  );
}

/** "12 ms", "1.4 s": a few hundredths of a millisecond are nothing. */
const took = (ms: number): string => (ms < 1 ? 'under 1\u00a0ms' : duration(ms / 1000));

function Timings({ timings_ms }: { timings_ms: Comparison['timings_ms'] }) {
  const steps = Object.entries(timings_ms).filter(([name]) => name !== 'total');
  if (steps.length === 0) return null;
  return (
    <details class="panel-body timings">
      <summary>Took {took(timings_ms['total'] ?? 0)}</summary>
      <dl class="figures">
        {steps.map(([name, ms]) => (
          <div key={name}>
            <dt>{name}</dt>
            <dd>{took(ms)}</dd>
          </div>
        ))}
      </dl>
    </details>
  );
}
