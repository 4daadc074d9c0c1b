// Rules and their hours as sentences.

import type { Schema } from '../../lib/api';
import { lastingInWords, leastInWords } from '../alerts/rule_words';

type Rule = Pick<
  Schema<'NewRule'>,
  'kinds' | 'min_points' | 'min_volume_m3' | 'min_extent_m' | 'persistence' | 'severity' | 'schedule'
>;
export type Window = Schema<'Schedule'>[number];
export type Day = NonNullable<Window['days']>[number];

export const kDays: readonly { readonly day: Day; readonly word: string }[] = [
  { day: 'mon', word: 'Mon' },
  { day: 'tue', word: 'Tue' },
  { day: 'wed', word: 'Wed' },
  { day: 'thu', word: 'Thu' },
  { day: 'fri', word: 'Fri' },
  { day: 'sat', word: 'Sat' },
  { day: 'sun', word: 'Sun' },
];

const kVerbs: Readonly<Record<Schema<'Severity'>, string>> = {
  info: 'Notes',
  advisory: 'Advises',
  warning: 'Warns',
  critical: 'Raises a critical alert',
};

/** "Warns when something of at least 20 points is added in Fence, seen in 3 of the last 4 scans …, for at least 1 min." */
export function ruleSentence(rule: Rule, zone: string | undefined): string {
  const least = leastInWords({
    min_points: rule.min_points ?? 0,
    min_volume_m3: rule.min_volume_m3 ?? 0,
    min_extent_m: rule.min_extent_m ?? 0,
  });
  const what = least === '' ? 'anything' : `something of at least ${least}`;
  const kinds = (rule.kinds ?? ['added', 'removed']).join(' or ');
  const hours = rule.schedule && rule.schedule.length > 0 ? `, ${scheduleInWords(rule.schedule)}` : '';
  return `${kVerbs[rule.severity ?? 'warning']} when ${what} is ${kinds} ${zone === undefined ? 'anywhere' : `in ${zone}`}, ${lastingInWords(rule.persistence ?? {})}${hours}.`;
}

/** "Mon to Fri from 20:00 to 06:00 (the next day), Sat and Sun all day". */
export const scheduleInWords = (schedule: readonly Window[]): string =>
  schedule.length === 0 ? 'at all hours' : schedule.map(windowInWords).join('; ');

function windowInWords({ days, from = '00:00', to = '24:00' }: Window): string {
  return `${daysInWords(days ?? kDays.map(({ day }) => day))} ${hoursInWords(from, to)}`;
}

function hoursInWords(from: string, to: string): string {
  if (from === '00:00' && (to === '24:00' || to === '00:00')) return 'all day';
  return `from ${from} to ${to}${to <= from ? ' (the next day)' : ''}`;
}

/** Runs of at least three days as "Mon to Fri". */
export function daysInWords(days: readonly Day[]): string {
  const numbers = kDays.flatMap(({ day }, index) => (days.includes(day) ? [index] : []));
  if (numbers.length === kDays.length) return 'every day';
  const runs: number[][] = [];
  for (const number of numbers) {
    const run = runs.at(-1);
    if (run && run.at(-1) === number - 1) run.push(number);
    else runs.push([number]);
  }
  const word = (index: number): string => kDays[index]?.word ?? '';
  const words = runs.flatMap((run) =>
    run.length >= 3 ? [`${word(run[0]!)} to ${word(run.at(-1)!)}`] : run.map((index) => word(index)),
  );
  return words.length < 2 ? words.join('') : `${words.slice(0, -1).join(', ')} and ${words.at(-1)}`;
}
