// Figures through time, drawn by uPlot, in a site's time zone and the colours of the theme.

import 'uplot/dist/uPlot.min.css';
import { useEffect, useRef } from 'preact/hooks';
import uPlot from 'uplot';

export interface Series {
  readonly name: string;
  /** One for each time; null where there is none. */
  readonly values: readonly (number | null)[];
}

export interface ChartProps {
  /** What it shows, for those who hear it. */
  label: string;
  times_s: readonly number[];
  series: readonly Series[];
  unit: string;
  /** Of the values; after the data when it is not given. */
  range?: readonly [number, number];
  time_zone: string;
}

const kHeight_px = 220;
const kNumber = new Intl.NumberFormat('en-GB', { maximumFractionDigits: 1 });
const withUnit = (value: number, unit: string): string => `${kNumber.format(value)}\u00a0${unit}`.trimEnd();
/** Told apart by people who do not see all colours alike, after Okabe and Ito, and by dashes. */
const kLooks = [
  { colour: '#0072b2', dark: '#56b4e9', dash: [] },
  { colour: '#b34700', dark: '#ff9a52', dash: [6, 3] },
  { colour: '#006b4c', dark: '#3fd0a4', dash: [2, 3] },
  { colour: '#8a3d74', dark: '#e09bcb', dash: [8, 3, 2, 3] },
] as const;

/** Marks of the time axis by how far they lie apart (s), with what is added where the year, and where the day is another. */
const kTimeMarks: uPlot.Axis.Values = [
  [365 * 86_400, '{YYYY}', null, null, null, null, null, null, 1],
  [28 * 86_400, '{MMM}', '\n{YYYY}', null, null, null, null, null, 1],
  [86_400, '{D} {MMM}', '\n{YYYY}', null, null, null, null, null, 1],
  [60, '{HH}:{mm}', '\n{D} {MMM} {YYYY}', null, '\n{D} {MMM}', null, null, null, 1],
  [1, '{HH}:{mm}:{ss}', '\n{D} {MMM} {YYYY}', null, '\n{D} {MMM}', null, null, null, 1],
];

export function Chart(props: ChartProps) {
  const place = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const element = place.current;
    if (!element) return;
    const chart = new uPlot(optionsOf(props, element), dataOf(props), element);
    const sizes = new ResizeObserver(() => chart.setSize({ width: element.clientWidth, height: kHeight_px }));
    sizes.observe(element);
    const scheme = matchMedia('(prefers-color-scheme: dark)');
    const redraw = (): void => chart.redraw();
    scheme.addEventListener('change', redraw);
    return () => {
      scheme.removeEventListener('change', redraw);
      sizes.disconnect();
      chart.destroy();
    };
  }, [props.times_s.join(), JSON.stringify(props.series), props.time_zone]);
  return <div ref={place} class="chart" role="img" aria-label={props.label} />;
}

const dataOf = ({ times_s, series }: ChartProps): uPlot.AlignedData =>
  [[...times_s], ...series.map(({ values }) => [...values])] as uPlot.AlignedData;

function optionsOf(props: ChartProps, element: HTMLElement): uPlot.Options {
  const style = (name: string) => (): string => getComputedStyle(element).getPropertyValue(name).trim();
  // light-dark() is no colour to a canvas: what a property means is asked of an element that has it.
  const colour = (): string => getComputedStyle(element).color;
  const isDark = (): boolean => luminance(colour()) > 0.5;
  const grid = { stroke: () => (isDark() ? '#2a3743' : '#d3dae1'), width: 1 };
  const axis = { stroke: colour, grid, ticks: grid, font: `12px ${style('--font')() || 'sans-serif'}` };
  return {
    width: element.clientWidth,
    height: kHeight_px,
    tzDate: (seconds) => uPlot.tzDate(new Date(seconds * 1000), props.time_zone),
    scales: { y: props.range ? { range: [...props.range] } : {} },
    axes: [
      { ...axis, values: kTimeMarks },
      { ...axis, size: 56, values: (_, values) => values.map((value) => withUnit(value, props.unit)) },
    ],
    series: [
      { label: 'Time', value: '{YYYY}-{MM}-{DD} {HH}:{mm}:{ss}' },
      ...props.series.map(({ name }, index) => {
        const look = kLooks[index % kLooks.length]!;
        return {
          label: name,
          stroke: () => (isDark() ? look.dark : look.colour),
          dash: [...look.dash],
          width: 2,
          spanGaps: true,
          points: { show: true, size: 5, fill: () => (isDark() ? look.dark : look.colour) },
          value: (_: uPlot, value: number | null) => (value === null ? '–' : withUnit(value, props.unit)),
        };
      }),
    ],
  };
}

/** How bright a computed colour such as "rgb(220, 229, 237)" is, from 0 to 1. */
function luminance(colour: string): number {
  const [red = 0, green = 0, blue = 0] = (colour.match(/[\d.]+/g) ?? []).map(Number);
  return (0.2126 * red + 0.7152 * green + 0.0722 * blue) / 255;
}
