// A rule as it is filled in: numbers are texts until they are sent.

import type { Schema } from '../../lib/api';
import type { Difference } from '../../ui/edited_elsewhere';
import { type Day, kDays, ruleSentence } from './rule_words';

export interface WindowDraft {
  readonly days: readonly Day[];
  readonly from: string;
  readonly to: string;
}

export interface RuleDraft {
  readonly name: string;
  /** The zone's id; empty for anywhere. */
  readonly zone: string;
  readonly added: boolean;
  readonly removed: boolean;
  readonly min_points: string;
  readonly min_volume_m3: string;
  readonly min_extent_m: string;
  readonly scans: string;
  readonly of: string;
  readonly seconds: string;
  readonly severity: Schema<'Severity'>;
  readonly schedule: readonly WindowDraft[];
  readonly enabled: boolean;
  readonly auto_resolve: boolean;
}

export const wholeWeek: WindowDraft = { days: kDays.map(({ day }) => day), from: '20:00', to: '06:00' };

export const newDraft: RuleDraft = {
  name: '',
  zone: '',
  added: true,
  removed: true,
  min_points: '',
  min_volume_m3: '',
  min_extent_m: '',
  scans: '2',
  of: '3',
  seconds: '20',
  severity: 'warning',
  schedule: [],
  enabled: true,
  auto_resolve: true,
};

/** Zero, which asks for nothing, stands as an empty field. */
const filled = (value: number): string => (value === 0 ? '' : String(value));

export const draftOf = (rule: Schema<'Rule'>): RuleDraft => ({
  name: rule.name,
  zone: rule.zone === null ? '' : String(rule.zone),
  added: rule.kinds.includes('added'),
  removed: rule.kinds.includes('removed'),
  min_points: filled(rule.min_points),
  min_volume_m3: filled(rule.min_volume_m3),
  min_extent_m: filled(rule.min_extent_m),
  scans: String(rule.persistence.scans ?? 1),
  of: String(rule.persistence.of ?? 1),
  seconds: filled(rule.persistence.seconds ?? 0),
  severity: rule.severity,
  schedule: rule.schedule.map(({ days, from = '00:00', to = '24:00' }) => ({
    days: days ?? wholeWeek.days,
    from,
    // An end at 24:00 and one at 00:00 of the next day are the same; a field for times only takes the latter.
    to: to === '24:00' ? '00:00' : to,
  })),
  enabled: rule.enabled,
  auto_resolve: rule.auto_resolve,
});

export const bodyOf = (draft: RuleDraft, site: string): Schema<'NewRule'> => ({
  site,
  name: draft.name.trim(),
  zone: draft.zone === '' ? null : Number(draft.zone),
  kinds: [...(draft.added ? (['added'] as const) : []), ...(draft.removed ? (['removed'] as const) : [])],
  min_points: Number(draft.min_points),
  min_volume_m3: Number(draft.min_volume_m3),
  min_extent_m: Number(draft.min_extent_m),
  persistence: { scans: Number(draft.scans), of: Number(draft.of), seconds: Number(draft.seconds) },
  severity: draft.severity,
  schedule: draft.schedule.map(({ days, from, to }) => ({ days: [...days], from, to })),
  enabled: draft.enabled,
  auto_resolve: draft.auto_resolve,
});

/** What is wrong before anything is sent, by the daemon's own names of fields. */
export function faultsOf(draft: RuleDraft): Readonly<Record<string, string>> {
  const faults: Record<string, string> = {};
  if (draft.name.trim() === '') faults['name'] = 'needs a name';
  if (!draft.added && !draft.removed) faults['kinds'] = 'needs at least one of added and removed';
  const [scans, of] = [Number(draft.scans), Number(draft.of)];
  if (!(scans >= 1)) faults['persistence.scans'] = 'must be at least 1';
  else if (!(of >= scans)) faults['persistence.of'] = `must be at least ${scans}: it is seen in so many of these`;
  for (const [index, { days }] of draft.schedule.entries()) {
    if (days.length === 0) faults[`schedule.${index}`] = 'needs at least one day';
  }
  return faults;
}

/** What differs between what is there and what is filled in. */
export function differencesOf(
  theirs: Schema<'NewRule'>,
  mine: Schema<'NewRule'>,
  zoneName: (id: number | null | undefined) => string | undefined,
): Difference[] {
  const sentence = (rule: Schema<'NewRule'>): string => ruleSentence(rule, zoneName(rule.zone));
  const yesNo = (value: boolean | undefined): string => (value ? 'yes' : 'no');
  return [
    { name: 'Name', theirs: theirs.name, mine: mine.name },
    { name: 'Rule', theirs: sentence(theirs), mine: sentence(mine) },
    { name: 'In force', theirs: yesNo(theirs.enabled), mine: yesNo(mine.enabled) },
    { name: 'Resolves by itself', theirs: yesNo(theirs.auto_resolve), mine: yesNo(mine.auto_resolve) },
  ];
}
