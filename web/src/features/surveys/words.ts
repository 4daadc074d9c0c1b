// Surveys in words: figures with their units and intervals, states of runs, levels.

import { type Schema } from '../../lib/api';
import { metres, percent, squareMetres } from '../../lib/format';

export type Figure = Schema<'SurveyFigure'>;
export type Level = 'green' | 'yellow' | 'orange' | 'red';
export type RunState = Schema<'SurveyRun'>['state'];

export const kFigures: Readonly<Record<Figure, string>> = {
  net_m3: 'Net, all seen ground',
  cut_m3: 'Cut',
  fill_m3: 'Fill',
  changed_net_m3: 'Net, changed ground',
  changed_area_m2: 'Changed area',
  greatest_rise_m: 'Greatest rise',
  greatest_fall_m: 'Greatest fall',
  mean_change_m: 'Mean change',
  m3c2_greatest_m: 'Greatest change along the normal',
  m3c2_mean_m: 'Mean change along the normal',
  seen_share: 'Seen in both epochs',
};
export const kFigureNames = Object.keys(kFigures) as Figure[];

export const unitOf = (figure: Figure): string =>
  figure.endsWith('_m3') ? 'm³' : figure.endsWith('_m2') ? 'm²' : figure.endsWith('_m') ? 'm' : '%';

export const kRunStates: Readonly<Record<RunState, { words: string; tone: 'good' | 'bad' | 'busy' | 'plain' }>> = {
  done: { words: 'done', tone: 'good' },
  queued: { words: 'waiting', tone: 'busy' },
  running: { words: 'running', tone: 'busy' },
  no_scans: { words: 'no scans', tone: 'bad' },
  refused: { words: 'refused', tone: 'bad' },
  failed: { words: 'failed', tone: 'bad' },
  skipped: { words: 'skipped', tone: 'plain' },
  cancelled: { words: 'cancelled', tone: 'plain' },
};
/** Nights on which a result was due and none came. */
export const isMissed = ({ state }: { state: RunState }): boolean =>
  state === 'no_scans' || state === 'refused' || state === 'failed' || state === 'skipped' || state === 'cancelled';

const numbers = [0, 1].map(
  (digits) => new Intl.NumberFormat('en-GB', { minimumFractionDigits: digits, maximumFractionDigits: digits }),
);
const kMinus = '\u2212';

/** Whole from a hundred on. What rounds to zero has no sign. */
function plain(value: number, digits: number, signed: boolean): string {
  const text = numbers[digits]!.format(Math.abs(value));
  if (!/[1-9]/.test(text)) return text;
  return value < 0 ? kMinus + text : signed ? `+${text}` : text;
}
const digitsFor = (...values: readonly number[]): 0 | 1 => (Math.max(...values.map(Math.abs)) < 100 ? 1 : 0);

/** "1,216 m³", "12.4 m³"; with a sign where it matters: "+1,216 m³", "−312 m³". */
export const cubicMetres = (value: number, signed = false): string =>
  `${plain(value, digitsFor(value), signed)}\u00a0m³`;

export const tonnes = (value: number, signed = false): string => `${plain(value, digitsFor(value), signed)}\u00a0t`;

/** "1,153 to 1,279 m³", both ends as exact as the larger one. Null ends are open. */
export function interval(low: number | null, high: number | null, unit = 'm³', signed = false): string {
  if (low === null && high === null) return 'no bounds';
  const digits = digitsFor(low ?? 0, high ?? 0);
  const end = (value: number): string => plain(value, digits, signed);
  if (low === null) return `at most ${end(high!)}\u00a0${unit}`;
  if (high === null) return `at least ${end(low)}\u00a0${unit}`;
  return `${end(low)} to ${end(high)}\u00a0${unit}`;
}

/** A rise or fall in metres, with its sign. */
export const riseMetres = (value: number, digits = 2): string =>
  (value > 0 ? '+' : '') + metres(value, digits).replace('-', kMinus);

/** A value of a figure, with its unit. */
export function figureText(figure: Figure, value: number): string {
  const unit = unitOf(figure);
  if (unit === 'm³') return cubicMetres(value, figure.includes('net'));
  if (unit === 'm²') return squareMetres(value);
  return unit === 'm' ? riseMetres(value) : percent(value);
}

const kOrder: readonly Level[] = ['green', 'yellow', 'orange', 'red'];

export const worst = (levels: readonly (Level | null)[]): Level | undefined =>
  kOrder.findLast((level) => levels.includes(level));

/** What a survey was compared with: by hand, the epoch that was named. */
export const referenceOf = ({
  schedule,
  before,
  ground,
}: Schema<'SurveyDetail'>): Schema<'SurveyDefinition'>['reference'] =>
  schedule === null ? { policy: 'fixed', epoch: before.epoch, days: null } : ground.survey.reference;

/** What a survey is compared with, after "compared with". */
export function referenceInWords({ policy, days, epoch }: Schema<'SurveyDefinition'>['reference']): string {
  switch (policy) {
    case 'previous':
      return 'the night before';
    case 'accepted':
      return 'the latest accepted state';
    case 'fixed':
      return `epoch ${epoch}`;
    case 'days_ago':
      return days === 1 ? 'the same time a day ago' : `the same time ${days} days ago`;
  }
}
