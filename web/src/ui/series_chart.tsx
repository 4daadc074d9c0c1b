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
  series: readonly Series[];
  unit: string;
  /** Of the values; from zero to a little above the greatest when it is not given. */
  range?: readonly [number, number];
  /** Around the first series, such as its interval: drawn as an area. */
  band?: { readonly name: string; readonly low: Values; readonly high: Values } | undefined;
  /** Drawn across, with their words. */
  limits?: readonly Limit[];
  /** Whether a moment without a value breaks the line; otherwise the line goes on over it. */
  gaps?: boolean;
}

/** One for each moment; null where there is none. */
type Values = readonly (number | null)[];

export interface Limit {
  readonly at: number;
  /** A name of the theme, such as "--critical". */
  readonly colour: string;
  readonly words: string;
}

export interface Series {
  /** Not needed where there is one. */
  readonly name?: string;
  readonly values: Values;
}

const kHeight_px = 180;
const kNumber = new Intl.NumberFormat('en-GB', { maximumSignificantDigits: 4 });

/** Several series are told apart by dashes and dots, too. */
const kLooks = [
  { colour: '--accent', dash: [] },
  { colour: '--removed', dash: [7, 4] },
  { colour: '--added', dash: [2, 4] },
  { colour: '--critical', dash: [9, 4, 2, 4] },
] as const;

export function SeriesChart(props: SeriesChartProps) {
  const { label, site, at_s, series, unit, band, limits } = props;
  const place = useRef<HTMLDivElement>(null);
  const zone = useZone(site);
  const theme = useTheme();
  useEffect(() => {
    const element = place.current;
    if (!element) return;
    const chart = new uPlot(
      optionsFor(element, { ...props, zone }),
      [
        [...at_s],
        ...[...series.map(({ values }) => values), ...(band ? [band.low, band.high] : [])].map((each) => [...each]),
      ],
      element,
    );
    const sizes = new ResizeObserver(() => chart.setSize({ width: element.clientWidth, height: kHeight_px }));
    sizes.observe(element);
    return () => {
      sizes.disconnect();
      chart.destroy();
    };
  }, [JSON.stringify([at_s, series, band, limits]), label, unit, zone, theme]);
  const values = series.flatMap((each) => each.values.filter((value) => value !== null));
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

function optionsFor(element: HTMLElement, about: SeriesChartProps & { zone: string }): uPlot.Options {
  const colour = (name: string): string => resolved(element, `var(${name})`);
  const value = (_: uPlot, of: number | null): string => (of == null ? '–' : `${kNumber.format(of)} ${about.unit}`);
  const axis = { stroke: colour('--muted'), grid: { stroke: colour('--line'), width: 1 }, ticks: { show: false } };
  return {
    width: Math.max(200, element.clientWidth),
    height: kHeight_px,
    tzDate: (at_s) => uPlot.tzDate(new Date(at_s * 1000), about.zone),
    cursor: { drag: { x: false, y: false } },
    legend: { show: true },
    scales: { y: { range: (_, __, most) => [...(about.range ?? ([0, most > 0 ? most * 1.1 : 1] as const))] } },
    axes: [
      { ...axis, values: clockTicks },
      { ...axis, size: 64, values: (_, ticks) => ticks.map((tick) => kNumber.format(tick)) },
    ],
    series: [
      { label: `Time (${about.zone})`, value: '{YYYY}-{MM}-{DD} {HH}:{mm}:{ss}' },
      ...about.series.map(({ name }, index): uPlot.Series => {
        const look = kLooks[index % kLooks.length]!;
        return {
          label: name ?? about.label,
          stroke: colour(look.colour),
          dash: [...look.dash],
          width: 2,
          spanGaps: !about.gaps,
          points: { size: 5 },
          value,
        };
      }),
      ...(about.band ? ['from', 'to'] : []).map((end): uPlot.Series => ({
        label: `${about.band?.name} ${end}`,
        width: 0,
        points: { show: false },
        value,
      })),
    ],
    ...(about.band ? { bands: [{ series: bandOf(about.series.length), fill: colour('--band') }] } : {}),
    hooks: { draw: [(chart) => drawLimits(chart, about.limits ?? [], colour)] },
  };
}

/** The upper and the lower edge stand behind the others. */
const bandOf = (series: number): [number, number] => [series + 2, series + 1];

/** Lines across, each with its words at its right end. */
function drawLimits(chart: uPlot, limits: readonly Limit[], colour: (name: string) => string): void {
  const { ctx, bbox } = chart;
  ctx.save();
  ctx.lineWidth = devicePixelRatio;
  ctx.setLineDash([6 * devicePixelRatio, 4 * devicePixelRatio]);
  ctx.font = `${11 * devicePixelRatio}px system-ui, sans-serif`;
  ctx.textAlign = 'right';
  ctx.textBaseline = 'bottom';
  for (const { at, colour: name, words } of limits) {
    const y = chart.valToPos(at, 'y', true);
    if (y < bbox.top || y > bbox.top + bbox.height) continue;
    ctx.strokeStyle = ctx.fillStyle = colour(name);
    ctx.beginPath();
    ctx.moveTo(bbox.left, y);
    ctx.lineTo(bbox.left + bbox.width, y);
    ctx.stroke();
    ctx.fillText(words, bbox.left + bbox.width, y - devicePixelRatio);
  }
  ctx.restore();
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
