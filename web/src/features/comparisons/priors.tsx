import { type Schema } from '../../lib/api';
import { count, percent } from '../../lib/format';
import { EmptyState } from '../../ui/states';

/** The earlier scans that stood for the state of the world, and what each of them showed. */
export function Priors({ comparison }: { comparison: Schema<'Comparison'> }) {
  const { priors } = comparison;
  return (
    <section class="panel panel-wide" aria-labelledby="priors">
      <header class="panel-head">
        <h2 id="priors">Compared with</h2>
        <a href={`/scans/${comparison.scan}?comparison=${comparison.id}`}>why these scans</a>
      </header>
      {priors.length === 0 ? (
        <EmptyState title="No earlier scan was there to compare with." />
      ) : (
        <div class="panel-body">
          <div class="table-scroll" tabIndex={0} role="region" aria-label="priors">
            <table>
              <caption class="visually-hidden">Priors</caption>
              <thead>
                <tr>
                  <th scope="col">Scan</th>
                  <th scope="col" class="numeric not-narrow">
                    Vantage
                  </th>
                  <th scope="col" class="numeric">
                    Overlap
                  </th>
                  <th scope="col" class="numeric">
                    Added
                  </th>
                  <th scope="col" class="numeric">
                    Removed
                  </th>
                </tr>
              </thead>
              <tbody>
                {priors.map(({ scan, vantage, overlap, added, removed }) => (
                  <tr key={scan}>
                    <td>
                      <a href={`/scans/${scan}`}>scan {scan}</a>
                    </td>
                    <td class="numeric not-narrow">{vantage}</td>
                    <td class="numeric">{percent(overlap, 1)}</td>
                    <td class="numeric">{count(added)} points</td>
                    <td class="numeric">{count(removed)} points</td>
                  </tr>
                ))}
              </tbody>
            </table>
          </div>
        </div>
      )}
    </section>
  );
}
