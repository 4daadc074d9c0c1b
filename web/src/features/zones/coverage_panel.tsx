// How much of a zone could be judged, scan by scan.

import { useState } from 'preact/hooks';
import { useResource } from '../../app/app';
import { address, type Schema } from '../../lib/api';
import { counted, percent } from '../../lib/format';
import { type Series, SeriesChart } from '../../ui/series_chart';
import { EmptyState, Loaded } from '../../ui/states';
import { Time } from '../../ui/time';

type Coverage = Schema<'Coverage'>;

const kScans = [100, 1000] as const;

export function CoveragePanel({ zone }: { zone: Schema<'Zone'> }) {
  const [limit, setLimit] = useState<(typeof kScans)[number]>(100);
  const page = useResource(address('/api/v1/zones/{id}/coverage', { path: { id: zone.id }, query: { limit } }));
  return (
    <section class="panel zone-coverage" aria-labelledby="coverage">
      <header class="panel-head">
        <h2 id="coverage">Seen through time</h2>
        <span class="muted">what share of its places each scan could call free or occupied</span>
        <span class="spacer" />
        <div class="actions" role="group" aria-label="How many scans">
          {kScans.map((number) => (
            <button key={number} type="button" aria-pressed={number === limit} onClick={() => setLimit(number)}>
              {counted(number, 'scan')}
            </button>
          ))}
        </div>
      </header>
      <div class="panel-body">
        <Loaded of={page} what="coverage">
          {({ items }) =>
            items.length === 0 ? (
              <EmptyState title="No scan since this zone is there.">
                <p>The next one tells how much of it can be seen.</p>
              </EmptyState>
            ) : (
              <CoverageChart items={items} site={zone.site} />
            )
          }
        </Loaded>
      </div>
    </section>
  );
}

function CoverageChart({ items, site }: { items: readonly Coverage[]; site: string }) {
  const scans = [...items].sort((one, other) => Date.parse(one.captured_at) - Date.parse(other.captured_at));
  const vantages = [...new Set(scans.map(({ vantage }) => vantage))].sort((one, other) => one - other);
  const series: Series[] = vantages.map((vantage) => ({
    name: `vantage ${vantage}`,
    values: scans.map((scan) => (scan.vantage === vantage ? scan.share * 100 : null)),
  }));
  const latest = scans.at(-1);
  return (
    <>
      {latest && (
        <p>
          The latest scan, <a href={`/scans/${latest.scan}`}>scan {latest.scan}</a> of{' '}
          <Time at={latest.captured_at} site={site} />, could judge <b>{percent(latest.share, 1)}</b> of it.
        </p>
      )}
      <SeriesChart
        label={`Share that could be judged, of ${counted(scans.length, 'scan')}`}
        site={site}
        at_s={scans.map(({ captured_at }) => Date.parse(captured_at) / 1000)}
        series={series}
        unit="%"
        range={[0, 100]}
      />
    </>
  );
}
