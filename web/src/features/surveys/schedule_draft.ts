// A schedule as it is filled in: numbers are texts until they are sent.

import type { Schema } from '../../lib/api';
import type { Difference } from '../../ui/edited_elsewhere';
import { cronInWords } from './cron_words';
import {
  type DefinitionDraft,
  definitionDraftOf,
  definitionOf,
  newDefinition,
  numberOrNull,
  numberText,
} from './definition_draft';
import { type Figure, kFigures, referenceInWords } from './words';

type Schedule = Schema<'SurveySchedule'>;
type Policy = Schedule['survey']['reference']['policy'];

export interface ThresholdDraft {
  readonly figure: Figure;
  /** The zone's id; empty for the total. */
  readonly zone: string;
  readonly yellow: string;
  readonly orange: string;
  readonly red: string;
  readonly raise_after: string;
  readonly clear_after: string;
  readonly clear_share: number;
}

export interface ScheduleDraft extends DefinitionDraft {
  readonly name: string;
  readonly enabled: boolean;
  readonly cron: string;
  /** Empty: that of the site. */
  readonly time_zone: string;
  readonly window_h: string;
  readonly grace_min: string;
  readonly required_sensors: readonly string[];
  readonly catch_up: Schedule['catch_up'];
  readonly policy: Policy;
  readonly epoch: string;
  readonly days: string;
  readonly residual_mm: string;
  readonly position_mm: string;
  readonly angle_deg: string;
  readonly thresholds: readonly ThresholdDraft[];
}

export const newThreshold: ThresholdDraft = {
  figure: 'net_m3',
  zone: '',
  yellow: '',
  orange: '',
  red: '',
  raise_after: '1',
  clear_after: '2',
  clear_share: 0.9,
};

/** With the daemon's own defaults, but for the name. */
export const newDraft: ScheduleDraft = {
  ...newDefinition,
  name: 'nightly',
  enabled: true,
  cron: '30 5 * * *',
  time_zone: '',
  window_h: '6',
  grace_min: '10',
  required_sensors: [],
  catch_up: 'latest',
  policy: 'previous',
  epoch: '',
  days: '7',
  residual_mm: '50',
  position_mm: '50',
  angle_deg: '0.115',
  thresholds: [],
};

export const draftOf = ({ survey, ...schedule }: Schedule): ScheduleDraft => ({
  name: schedule.name,
  enabled: schedule.enabled,
  cron: schedule.cron,
  time_zone: schedule.time_zone,
  window_h: numberText(schedule.window_s / 3600),
  grace_min: numberText(schedule.grace_s / 60),
  required_sensors: schedule.required_sensors,
  catch_up: schedule.catch_up,
  ...definitionDraftOf(survey),
  policy: survey.reference.policy,
  epoch: numberText(survey.reference.epoch),
  days: numberText(survey.reference.days ?? 7),
  residual_mm: numberText(survey.tolerance.residual_m * 1000),
  position_mm: numberText(survey.tolerance.position_m * 1000),
  angle_deg: numberText(survey.tolerance.angle_deg),
  thresholds: survey.thresholds.map((each) => ({
    figure: each.figure,
    zone: numberText(each.zone),
    yellow: numberText(each.yellow),
    orange: numberText(each.orange),
    red: numberText(each.red),
    raise_after: numberText(each.raise_after),
    clear_after: numberText(each.clear_after),
    clear_share: each.clear_share,
  })),
});

/** What the form does not show stays as it is in `from`. */
export function bodyOf(
  draft: ScheduleDraft,
  from: Pick<Schedule, 'site'> & Partial<Schedule>,
): Schema<'NewSurveySchedule'> {
  const { policy } = draft;
  return {
    site: from.site,
    name: draft.name.trim(),
    enabled: draft.enabled,
    cron: draft.cron.trim(),
    ...(draft.time_zone.trim() === '' ? {} : { time_zone: draft.time_zone.trim() }),
    window_s: Number(draft.window_h) * 3600,
    grace_s: Number(draft.grace_min) * 60,
    sensors: from.sensors ?? [],
    required_sensors: [...draft.required_sensors],
    required_vantages: from.required_vantages ?? [],
    catch_up: draft.catch_up,
    survey: {
      ...definitionOf(draft),
      reference: {
        policy,
        ...(policy === 'fixed' ? { epoch: numberOrNull(draft.epoch) } : {}),
        ...(policy === 'days_ago' ? { days: numberOrNull(draft.days) } : {}),
      },
      tolerance: {
        residual_m: Number(draft.residual_mm) / 1000,
        position_m: Number(draft.position_mm) / 1000,
        angle_deg: Number(draft.angle_deg),
      },
      thresholds: draft.thresholds.map((each) => ({
        figure: each.figure,
        zone: numberOrNull(each.zone),
        yellow: numberOrNull(each.yellow),
        orange: numberOrNull(each.orange),
        red: numberOrNull(each.red),
        raise_after: Number(each.raise_after),
        clear_after: Number(each.clear_after),
        clear_share: each.clear_share,
      })),
    },
  };
}

/** What is wrong before anything is sent, by the daemon's own names of fields. */
export function faultsOf(draft: ScheduleDraft): Readonly<Record<string, string>> {
  const faults: Record<string, string> = {};
  if (draft.name.trim() === '') faults['name'] = 'needs a name';
  if (draft.cron.trim() === '') faults['cron'] = 'needs a time, such as 30 5 * * * for every day at 05:30';
  if (!(Number(draft.window_h) > 0)) faults['window_s'] = 'must be more than 0 h';
  if (draft.policy === 'fixed' && draft.epoch === '') faults['survey.reference.epoch'] = 'needs an epoch';
  if (draft.policy === 'days_ago' && !(Number(draft.days) >= 1)) faults['survey.reference.days'] = 'must be at least 1';
  for (const [index, { yellow, orange, red }] of draft.thresholds.entries()) {
    const given = [yellow, orange, red].filter((value) => value !== '').map(Number);
    if (given.length === 0) faults[`survey.thresholds.${index}`] = 'needs at least one level';
    else if (given.some((value, at) => at > 0 && value <= given[at - 1]!))
      faults[`survey.thresholds.${index}`] = 'each level must begin above the one before';
  }
  return faults;
}

/** What differs between what is there and what is filled in. */
export function differencesOf(theirs: ScheduleDraft, mine: ScheduleDraft): Difference[] {
  const row = (name: string, of: (draft: ScheduleDraft) => string): Difference => ({
    name,
    theirs: of(theirs),
    mine: of(mine),
  });
  return [
    row('Name', ({ name }) => name),
    row('Runs', ({ cron }) => cronInWords(cron) ?? cron),
    row('Time zone', ({ time_zone }) => time_zone),
    row('On', ({ enabled }) => (enabled ? 'yes' : 'no')),
    row('Window', ({ window_h, grace_min }) => `${window_h} h, begun ${grace_min} min later`),
    row('Missed runs', ({ catch_up }) => catch_up),
    row('Compared with', (draft) => referenceInWords(referenceOf(draft))),
    row('Zones', ({ zones }) => zones.join(', ')),
    row('Required sensors', ({ required_sensors }) => required_sensors.join(', ')),
    row('Cells, core points, density', (draft) => `${draft.cell_m} m, ${draft.core_spacing_m} m, ${draft.density}`),
    row('Steepest ground', ({ greatest_slope_deg }) => (greatest_slope_deg === '' ? '' : `${greatest_slope_deg}°`)),
    row('Tolerance', (draft) => `${draft.residual_mm} mm, ${draft.position_mm} mm, ${draft.angle_deg}°`),
    row('Levels', ({ thresholds }) => thresholds.map(thresholdWords).join('; ')),
  ];
}

const referenceOf = ({ policy, epoch, days }: ScheduleDraft): Schedule['survey']['reference'] => ({
  policy,
  epoch: numberOrNull(epoch),
  days: numberOrNull(days),
});

const thresholdWords = ({ figure, zone, yellow, orange, red }: ThresholdDraft): string =>
  `${kFigures[figure]} of ${zone === '' ? 'the total' : `zone ${zone}`} from ${[yellow, orange, red].join(' / ')}`;
