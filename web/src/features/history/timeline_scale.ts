// Where moments stand on a line of time: shares of a range, its ticks, and the pieces that are drawn on it.

import { addDays, dateOf, type Range, startOf } from './range';
import { type Interval } from './words';

/** Where a moment stands in a range: 0 at its beginning, 1 at its end; not beyond. */
export const shareOf = (moment_ms: number, range: Range): number =>
  Math.min(1, Math.max(0, (moment_ms - range.from_ms) / (range.to_ms - range.from_ms)));

/** The range of all intervals, with a little room around them. */
export function rangeOf(intervals: readonly Interval[]): Range | undefined {
  const first = intervals[0];
  const last = intervals.at(-1);
  if (!first || !last) return undefined;
  const from_ms = Date.parse(first.from);
  const to_ms = Date.parse(last.to);
  const room_ms = Math.max(5_000, (to_ms - from_ms) * 0.02);
  return { from_ms: from_ms - room_ms, to_ms: to_ms + room_ms };
}

/** What is drawn as one piece: an interval, or several that are too short to be told apart. */
export interface Piece {
  readonly intervals: readonly Interval[];
  readonly from: number;
  readonly to: number;
}

/** Intervals shorter than this share of the line are drawn together with their short neighbours. */
const kLeastShare = 0.004;

export function piecesOf(intervals: readonly Interval[], range: Range): Piece[] {
  const pieces: Piece[] = [];
  for (const interval of intervals) {
    const from = shareOf(Date.parse(interval.from), range);
    const to = shareOf(Date.parse(interval.to), range);
    const last = pieces.at(-1);
    if (last && to - last.from < kLeastShare) {
      pieces[pieces.length - 1] = { intervals: [...last.intervals, interval], from: last.from, to };
    } else {
      pieces.push({ intervals: [interval], from, to });
    }
  }
  return pieces;
}

const kSecond = 1_000;
const kMinute = 60 * kSecond;
const kHour = 60 * kMinute;
const kDay = 24 * kHour;
const kSteps_ms = [
  ...[5, 10, 30].map((n) => n * kSecond),
  ...[1, 2, 5, 10, 15, 30].map((n) => n * kMinute),
  ...[1, 2, 3, 6, 12].map((n) => n * kHour),
  ...[1, 2, 7, 14, 30, 61, 122, 365].map((n) => n * kDay),
];

export interface Tick {
  readonly moment_ms: number;
  readonly share: number;
  /** How fine the ticks are, which decides how they are written. */
  readonly step: 'second' | 'minute' | 'day';
}

/** Ticks at round times of the zone's clock, about `wanted` of them. */
export function ticksOf(range: Range, zone: string, wanted = 8): Tick[] {
  const length_ms = range.to_ms - range.from_ms;
  const step_ms = kSteps_ms.find((candidate) => length_ms / candidate <= wanted) ?? length_ms;
  const step = step_ms < kMinute ? 'second' : step_ms < kDay ? 'minute' : 'day';
  const ticks: Tick[] = [];
  const days = Math.max(1, Math.round(step_ms / kDay));
  for (let date = dateOf(range.from_ms, zone); startOf(date, zone) < range.to_ms; date = addDays(date, days)) {
    const start_ms = startOf(date, zone);
    const end_ms = step === 'day' ? start_ms + 1 : startOf(addDays(date, 1), zone);
    const skipped = Math.max(0, Math.ceil((range.from_ms - start_ms) / step_ms));
    for (
      let moment_ms = start_ms + skipped * step_ms;
      moment_ms < end_ms && moment_ms < range.to_ms;
      moment_ms += step_ms
    ) {
      ticks.push({ moment_ms, share: shareOf(moment_ms, range), step });
    }
  }
  return ticks;
}
