// A survey by hand as it is filled in: two epochs, or time windows on the clock of the site.

import type { Schema } from '../../lib/api';
import { momentOf } from '../../lib/zone';
import { type DefinitionDraft, definitionDraftOf, definitionOf, newDefinition } from './definition_draft';

export type Side = 'before' | 'after';

export interface SideDraft {
  readonly by: 'epoch' | 'window';
  /** Its id; empty: none yet. */
  readonly epoch: string;
  /** As <input type="datetime-local"> has it. */
  readonly from: string;
  readonly to: string;
}

export interface ByHandDraft extends DefinitionDraft {
  readonly before: SideDraft;
  readonly after: SideDraft;
}

/** The latest two epochs, which come the latest first; time windows where there are no two. */
export function newByHand(epochs: readonly Pick<Schema<'Epoch'>, 'id' | 'state'>[]): ByHandDraft {
  const usable = epochs.filter(({ state }) => state !== 'refused').map(({ id }) => String(id));
  const [after = '', before = ''] = usable;
  const isThere = before !== '';
  return { ...newDefinition, before: sideOf(before, isThere), after: sideOf(after, isThere) };
}

/** The same two epochs once more. */
export const byHandLike = ({ before, after, ground }: Schema<'SurveyDetail'>): ByHandDraft => ({
  ...definitionDraftOf(ground.survey),
  before: sideOf(String(before.epoch)),
  after: sideOf(String(after.epoch)),
});

const sideOf = (epoch: string, isThere = true): SideDraft =>
  isThere ? { by: 'epoch', epoch, from: '', to: '' } : { by: 'window', epoch: '', from: '', to: '' };

/** What is wrong before anything is sent, by the daemon's own names of fields. */
export function faultsOf(draft: ByHandDraft): Readonly<Record<string, string>> {
  const faults: Record<string, string> = {};
  for (const name of ['before', 'after'] as const) {
    const { by, epoch, from, to } = draft[name];
    if (by === 'epoch' && epoch === '') faults[name] = 'needs an epoch';
    if (by === 'window' && from === '') faults[`${name}.from`] = 'needs a time';
    if (by === 'window' && to === '') faults[`${name}.to`] = 'needs a time';
  }
  return faults;
}

/** @param zone of the site, on whose clock the times are. */
export function bodyOf(draft: ByHandDraft, site: string, zone: string): Schema<'NewSurvey'> {
  const side = ({ by, epoch, from, to }: SideDraft): Schema<'EpochOrWindow'> =>
    by === 'epoch' ? Number(epoch) : { from: momentOf(from, zone).toISOString(), to: momentOf(to, zone).toISOString() };
  return { site, before: side(draft.before), after: side(draft.after), survey: definitionOf(draft) };
}
