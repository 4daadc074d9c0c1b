// How large a track was found through time; uPlot is loaded with it.

import { useZone } from '../../app/sites';
import { count, volume } from '../../lib/format';
import { Chart } from '../../ui/chart';
import { type Finding } from './findings';

export function SizeCharts({ site, findings }: { site: string; findings: readonly Finding[] }) {
  const times_s = findings.map(({ at_s }) => at_s);
  const litres = findings.map(({ volume_m3 }) => volume_m3 * 1000);
  const points = findings.map((finding) => finding.points);
  const inLitres = (value: number): string => volume(value / 1000);
  return (
    <>
      <OneChart name="Volume of its boxes" unit="L" site={site} times_s={times_s} values={litres} words={inLitres} />
      <OneChart name="Points" unit="" site={site} times_s={times_s} values={points} words={count} />
    </>
  );
}

interface OneChartProps {
  name: string;
  unit: string;
  site: string;
  times_s: readonly number[];
  values: readonly number[];
  words: (value: number) => string;
}

function OneChart({ name, unit, site, times_s, values, words }: OneChartProps) {
  const zone = useZone(site);
  const [least, most] = [Math.min(...values), Math.max(...values)];
  return (
    <figure class="size-chart">
      <figcaption>
        {name} <span class="muted">times of {zone}</span>
      </figcaption>
      <Chart
        label={`${name}: from ${words(least)} to ${words(most)}`}
        times_s={times_s}
        series={[{ name, values }]}
        unit={unit}
        range={[0, Math.max(1, most * 1.1)]}
        time_zone={zone}
      />
    </figure>
  );
}
