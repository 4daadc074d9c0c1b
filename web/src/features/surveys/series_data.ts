// A series of a figure as a chart takes it: nights without a result are gaps, and levels stand on both sides of zero.

import type { Schema } from '../../lib/api';
import type { Limit } from '../../ui/series_chart';
import { type Figure, isMissed } from './words';

type Series = Schema<'SurveySeries'>;
type Run = Pick<Schema<'SurveyRun'>, 'due_at' | 'state'>;
type Thresholds = Schema<'Thresholds'>;

export interface Course {
  readonly at_s: readonly number[];
  readonly values: readonly (number | null)[];
  readonly low: readonly (number | null)[];
  readonly high: readonly (number | null)[];
}

const seconds = (time: string): number => Date.parse(time) / 1000;

/** The values, with a gap at the time of each run without a result. Shares are in per cent. */
export function courseOf(series: Series, runs: readonly Run[]): Course {
  const scale = series.figure === 'seen_share' ? 100 : 1;
  const scaled = (value: number | null): number | null => (value === null ? null : value * scale);
  const known = series.values.map(({ at, value, low, high }) => ({
    at_s: seconds(at),
    value: scaled(value),
    low: scaled(low),
    high: scaled(high),
  }));
  const missed = runs
    .filter(isMissed)
    .map(({ due_at }) => ({ at_s: seconds(due_at), value: null, low: null, high: null }));
  const all = [...known, ...missed].sort((one, other) => one.at_s - other.at_s);
  return {
    at_s: all.map(({ at_s }) => at_s),
    values: all.map(({ value }) => value),
    low: all.map(({ low }) => low),
    high: all.map(({ high }) => high),
  };
}

const kLevels = ['yellow', 'orange', 'red'] as const;
const kColours = { yellow: '--level-yellow', orange: '--level-orange', red: '--critical' } as const;

/** The levels of a figure, on both sides of zero where it can fall below. */
export function limitsOf(figure: Figure, thresholds: Thresholds | undefined): Limit[] {
  if (!thresholds) return [];
  const scale = figure === 'seen_share' ? 100 : 1;
  const sides = /cut|fill|area|seen/.test(figure) ? [1] : /fall/.test(figure) ? [-1] : [1, -1];
  return kLevels.flatMap((level) => {
    const at = thresholds[level];
    return at === null ? [] : sides.map((side) => ({ at: side * at * scale, colour: kColours[level], words: level }));
  });
}

/** All values with a little room, zero, and the next level beyond them, so that it shows how far it is. */
export function rangeOf(
  course: Pick<Course, 'values' | 'low' | 'high'>,
  limits: readonly Limit[],
): readonly [number, number] {
  const values = [...course.values, ...course.low, ...course.high].filter((value) => value !== null);
  const [least, most] = [Math.min(0, ...values), Math.max(0, ...values)];
  const reach = Math.max(most, -least);
  const near = limits.map(({ at }) => at).filter((at) => Math.abs(at) <= 1.6 * reach);
  const [low, high] = [Math.min(least, ...near), Math.max(most, ...near)];
  const room = (high - low || 1) * 0.08;
  return [low < 0 ? low - room : 0, high > 0 ? high + room : 0];
}
