// What the scans of each vantage showed of a place, run by run: seen, absent, or out of sight. Width is the number of
// scans; every run says the same in words.

import './sight_strip.css';
import { useZone } from '../app/sites';
import { type Schema } from '../lib/api';
import { counted, dateTime } from '../lib/format';

type Observation = Schema<'Observation'>;

const kWords: Record<Observation['sight'], string> = { seen: 'seen', absent: 'absent', unseen: 'out of sight' };

export function SightStrip({ observations, site }: { observations: readonly Observation[]; site: string }) {
  const zone = useZone(site);
  const vantages = [...new Set(observations.map((run) => run.vantage))].sort((one, other) => one - other);
  if (vantages.length === 0) return <p class="muted">No scan has told anything about it yet.</p>;
  return (
    <dl class="sights">
      {vantages.map((vantage) => (
        <div key={vantage}>
          <dt>Vantage {vantage}</dt>
          <dd class="sight-runs">
            {observations
              .filter((run) => run.vantage === vantage)
              .map((run) => (
                <span
                  key={run.first_scan}
                  class={`sight sight-${run.sight}`}
                  style={{ flexGrow: run.scans }}
                  title={`${dateTime(run.from, zone)} to ${dateTime(run.to, zone)}`}
                >
                  {kWords[run.sight]} <span class="sight-number">{counted(run.scans, 'scan')}</span>
                </span>
              ))}
          </dd>
        </div>
      ))}
    </dl>
  );
}
