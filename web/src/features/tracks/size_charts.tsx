// How large a track was found through time; uPlot is loaded with it.

import { SeriesChart } from '../../ui/series_chart';
import { type Finding } from './findings';

export function SizeCharts({ site, findings }: { site: string; findings: readonly Finding[] }) {
  const at_s = findings.map((finding) => finding.at_s);
  return (
    <>
      <SeriesChart
        label="Volume of its boxes"
        site={site}
        at_s={at_s}
        series={[{ values: findings.map(({ volume_m3 }) => volume_m3 * 1000) }]}
        unit="L"
      />
      <SeriesChart
        label="Points"
        site={site}
        at_s={at_s}
        series={[{ values: findings.map(({ points }) => points) }]}
        unit="points"
      />
    </>
  );
}
