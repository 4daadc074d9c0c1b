// What was at a place through time, in sentences: each change with the scans that bracket it.

import { type Schema } from '../../lib/api';
import { count, counted } from '../../lib/format';

export type Interval = Schema<'HistoryInterval'>;

const kStates: Record<Interval['state'], string> = { free: 'free', occupied: 'occupied', not_seen: 'not seen' };
export const stateWords = (state: Interval['state']): string => kStates[state];

/** So many of the latest changes are told; the table has all. */
const kMostTold = 3;

/** @param timeOf how a moment is written. */
export function historyInWords(intervals: readonly Interval[], timeOf: (time: string) => string): string[] {
  const told = intervals.filter(({ state }) => state !== 'not_seen');
  const first = told[0];
  const last = told.at(-1);
  if (!first || !last) {
    const scans = intervals.reduce((sum, { scans: some }) => sum + some, 0);
    return [
      scans === 0 ? 'No scan was taken in this time.' : `None of ${counted(scans, 'scan')} could see this place.`,
    ];
  }
  const changes = told.slice(1).map((after, index) => ({ before: told[index] as Interval, after }));
  if (changes.length === 0) return [always(first), ...notSeenAtTheEnds(intervals, timeOf)];
  const shown = changes.slice(-kMostTold);
  const sentences = shown.map(({ before, after }) => change(before, after, intervals, timeOf));
  if (changes.length > shown.length)
    sentences.unshift(`It changed ${count(changes.length)} times; these are the latest.`);
  return [...sentences, ...notSeenAtTheEnds(intervals, timeOf)];
}

function always(only: Interval): string {
  const missed = only.not_seen > 0 ? `; ${counted(only.not_seen, 'scan')} between could not see it` : '';
  return `${capital(kStates[only.state])} in ${only.scans === 1 ? 'the one scan' : `all ${counted(only.scans, 'scan')}`} that saw it${missed}.`;
}

/** "Free until 02:10, occupied since 02:40; 3 scans between could not see it." */
function change(before: Interval, after: Interval, all: readonly Interval[], timeOf: (time: string) => string): string {
  const between = all.slice(all.indexOf(before) + 1, all.indexOf(after));
  const unseen = between.reduce((sum, { scans }) => sum + scans, 0);
  const missed = unseen > 0 ? `; ${counted(unseen, 'scan')} between could not see it` : '';
  return `${capital(kStates[before.state])} until ${timeOf(before.to)}, ${kStates[after.state]} since ${timeOf(after.from)}${missed}.`;
}

function notSeenAtTheEnds(intervals: readonly Interval[], timeOf: (time: string) => string): string[] {
  const first = intervals[0];
  const last = intervals.at(-1);
  return [
    ...(first?.state === 'not_seen' ? [`Not seen before ${timeOf(intervals[1]?.from ?? first.to)}.`] : []),
    ...(last?.state === 'not_seen' ? [`Not seen since ${timeOf(last.from)}.`] : []),
  ];
}

const capital = (text: string): string => text.charAt(0).toUpperCase() + text.slice(1);
