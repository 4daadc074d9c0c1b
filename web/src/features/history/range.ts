// Ranges of time that the calendar of a zone knows: days, weeks from Monday, months.

import { localOf, momentOf } from '../../lib/zone';

export interface Range {
  readonly from_ms: number;
  /** Not included. */
  readonly to_ms: number;
}

export const kSpans = ['day', 'week', 'month'] as const;
export type Span = (typeof kSpans)[number];

const kDayMs = 86_400_000;

/** A date is a text such as "2026-03-01"; it is reckoned with as if its day had 24 hours. */
const asDate = (ms: number): string => new Date(ms).toISOString().slice(0, 10);

export const dateOf = (moment_ms: number, zone: string): string => localOf(new Date(moment_ms), zone).slice(0, 10);

export const addDays = (date: string, days: number): string => asDate(Date.parse(date) + days * kDayMs);

/** The same day of another month, or its last day. */
export function addMonths(date: string, months: number): string {
  const [year = 0, month = 1, day = 1] = date.split('-').map(Number);
  const last = new Date(Date.UTC(year, month - 1 + months + 1, 0)).getUTCDate();
  return asDate(Date.UTC(year, month - 1 + months, Math.min(day, last)));
}

/** 0: Monday. */
export const weekday = (date: string): number => (new Date(date).getUTCDay() + 6) % 7;

/** When a day begins on the clocks of a zone. */
export const startOf = (date: string, zone: string): number => momentOf(`${date}T00:00`, zone).getTime();

/** The first day of the span in which a date lies. */
function firstDay(date: string, span: Span): string {
  if (span === 'day') return date;
  return span === 'week' ? addDays(date, -weekday(date)) : `${date.slice(0, 7)}-01`;
}

const step = (date: string, span: Span, by: number): string =>
  span === 'month' ? addMonths(date, by) : addDays(date, by * (span === 'week' ? 7 : 1));

/** The day, week or month in which a moment lies. */
export function spanAround(moment_ms: number, span: Span, zone: string): Range {
  const first = firstDay(dateOf(moment_ms, zone), span);
  return { from_ms: startOf(first, zone), to_ms: startOf(step(first, span, 1), zone) };
}

/** Which span a range is exactly, if any. */
export function spanOf(range: Range, zone: string): Span | undefined {
  return kSpans.find((span) => {
    const whole = spanAround(range.from_ms, span, zone);
    return whole.from_ms === range.from_ms && whole.to_ms === range.to_ms;
  });
}

/** The range before or after: the next day, week or month, else as long a time. */
export function neighbour(range: Range, by: 1 | -1, zone: string): Range {
  const span = spanOf(range, zone);
  if (span) return spanAround(by > 0 ? range.to_ms : range.from_ms - 1, span, zone);
  const length_ms = range.to_ms - range.from_ms;
  return { from_ms: range.from_ms + by * length_ms, to_ms: range.to_ms + by * length_ms };
}
