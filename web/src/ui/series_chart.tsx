// A figure through time, drawn by uPlot: loaded with the first view that needs it, and drawn only when something changes.

import 'uplot/dist/uPlot.min.css';
import './series_chart.css';
import { useEffect, useRef } from 'preact/hooks';
import uPlot from 'uplot';
import { useSelect } from '../app/app';
import { useZone } from '../app/sites';

export interface SeriesChartProps {
  /** What is drawn; said to those who hear it, with its least and greatest value. */
  label: string;
  site: string;
  /** Seconds since 1970, ascending. */
  at_s: readonly number[];
  values: readonly number[];
  unit: string;
}

const kHeight_px = 180;
const kNumber = new Intl.NumberFormat('en-GB', { maximumSignificantDigits: 4 });

export function SeriesChart({ label, site, at_s, values, unit }: SeriesChartProps) {
  const place = useRef<HTMLDivElement>(null);
  const zone = useZone(site);
  const theme = useTheme();
  useEffect(() => {
    const element = place.current;
    if (!element) return;
    const chart = new uPlot(
      optionsFor(element, { label, unit, zone }),
      [at_s as number[], values as number[]],
      element,
    );
    const sizes = new ResizeObserver(() => chart.setSize({ width: element.clientWidth, height: kHeight_px }));
    sizes.observe(element);
    return () => {
      sizes.disconnect();
      chart.destroy();
    };
  }, [JSON.stringify(at_s), JSON.stringify(values), label, unit, zone, theme]);
  const [least, most] = [Math.min(...values), Math.max(...values)];
  return (
    <figure class="chart">
      <figcaption>
        {label} <span class="muted">({unit})</span>
      </figcaption>
      <div
        ref={place}
        role="img"
        aria-label={`${label}: from ${kNumber.format(least)} to ${kNumber.format(most)} ${unit}`}
      />
    </figure>
  );
}

/** Colours are read when the chart is made, so that it is made anew when they change. */
function useTheme(): string {
  const theme = useSelect((state) => state.settings.theme);
  return theme === 'auto' ? (matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light') : theme;
}

function optionsFor(element: HTMLElement, about: { label: string; unit: string; zone: string }): uPlot.Options {
  const colour = (name: string): string => resolved(element, `var(${name})`);
  const axis = { stroke: colour('--muted'), grid: { stroke: colour('--line'), width: 1 }, ticks: { show: false } };
  return {
    width: Math.max(200, element.clientWidth),
    height: kHeight_px,
    tzDate: (at_s) => uPlot.tzDate(new Date(at_s * 1000), about.zone),
    cursor: { drag: { x: false, y: false } },
    legend: { show: true },
    scales: { y: { range: (_, __, most) => [0, most > 0 ? most * 1.1 : 1] } },
    axes: [
      { ...axis, values: clockTicks },
      { ...axis, size: 64, values: (_, ticks) => ticks.map((tick) => kNumber.format(tick)) },
    ],
    series: [
      { label: `Time (${about.zone})`, value: '{YYYY}-{MM}-{DD} {HH}:{mm}:{ss}' },
      {
        label: about.label,
        stroke: colour('--accent'),
        width: 2,
        points: { size: 5 },
        value: (_, value) => (value == null ? '–' : `${kNumber.format(value)} ${about.unit}`),
      },
    ],
  };
}

/** With 24 hours: uPlot's own templates have 12. */
const clockTicks: uPlot.Axis.Values = [
  [3600 * 24 * 365, '{YYYY}', null, null, null, null, null, null, 1],
  [3600 * 24 * 28, '{MMM}', '\n{YYYY}', null, null, null, null, null, 1],
  [3600 * 24, '{D} {MMM}', '\n{YYYY}', null, null, null, null, null, 1],
  [60, '{HH}:{mm}', null, null, '\n{D} {MMM}', null, null, null, 1],
  [1, '{HH}:{mm}:{ss}', null, null, '\n{D} {MMM}', null, null, null, 1],
];

/** What a colour of the theme is now: canvases do not know `light-dark()`. A new element has it at once, without a transition. */
function resolved(place: HTMLElement, colour: string): string {
  const probe = place.appendChild(document.createElement('span'));
  probe.style.color = colour;
  const value = getComputedStyle(probe).color;
  probe.remove();
  return value;
}
