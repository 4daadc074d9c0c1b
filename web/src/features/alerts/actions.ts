// What an operator does with alerts: each action is tied to the version that the operator saw, so that nobody overrules
// what somebody else did a moment ago without knowing it.

import { loader, showToast, store } from '../../app/app';
import { type Address, type Answer, address, ask, type Schema, send } from '../../lib/api';
import { counted } from '../../lib/format';
import { Problem } from '../../lib/problem';

export type ActionKind = 'acknowledge' | 'resolve' | 'snooze' | 'accept';

export interface AlertAction {
  readonly kind: ActionKind;
  readonly by: string;
  readonly note: string;
  /** Of a snooze: when it is over. */
  readonly until?: string;
}

/** An alert as the operator saw it. */
export type SeenAlert = Pick<Schema<'Alert'>, 'id' | 'edited_at'>;

const kDone: Record<ActionKind, string> = {
  acknowledge: 'acknowledged',
  resolve: 'resolved',
  snooze: 'snoozed',
  accept: 'accepted as normal',
};

const addressOf = (id: number): Address<Schema<'AlertDetail'>> => address('/api/v1/alerts/{id}', { path: { id } });

/** Carries an action out on each alert, says what came of it, and has the lists asked again. */
export async function actOn(alerts: readonly SeenAlert[], action: AlertAction): Promise<void> {
  let done = 0;
  const problems: Problem[] = [];
  for (const alert of alerts) {
    try {
      loader.put(addressOf(alert.id), await actOnOne(alert, action));
      done += 1;
    } catch (failure) {
      if (!(failure instanceof Problem)) throw failure;
      problems.push(failure);
    }
  }
  if (done > 0) showToast('good', `${counted(done, 'alert')} ${kDone[action.kind]}.`);
  for (const problem of problems.slice(0, 3)) showToast('bad', `${problem.title}. ${problem.message}`);
  loader.invalidate((key) => key.startsWith('/api/v1/alerts?'));
}

async function actOnOne(seen: SeenAlert, action: AlertAction): Promise<Answer<Schema<'AlertDetail'>>> {
  const known = await versionOf(seen.id, seen.edited_at);
  if (known.data.edited_at !== seen.edited_at) throw changedMeanwhile(known.data);
  const path = { id: seen.id };
  const body = { by: action.by, ...(action.note === '' ? {} : { note: action.note }) };
  const etag = known.etag;
  switch (action.kind) {
    case 'acknowledge':
      return send('post', '/api/v1/alerts/{id}/acknowledge', { path, body, etag });
    case 'resolve':
      return send('post', '/api/v1/alerts/{id}/resolve', { path, body, etag });
    case 'accept':
      return send('post', '/api/v1/alerts/{id}/accept', { path, body, etag });
    case 'snooze':
      return send('post', '/api/v1/alerts/{id}/snooze', { path, body: { ...body, until: action.until ?? '' }, etag });
  }
}

/** The version to name in the action: the one that is known already if it is the one that was seen. */
async function versionOf(id: number, edited_at: string): Promise<Answer<Schema<'AlertDetail'>>> {
  const from = addressOf(id);
  const known = store.state().resources[from];
  const data = known?.data as Schema<'AlertDetail'> | undefined;
  if (data?.edited_at === edited_at && !known?.stale) return { data, etag: known?.etag };
  const answer = await ask(from);
  if (!answer) throw new Error('unreachable: no version was named');
  return answer;
}

function changedMeanwhile(alert: Schema<'AlertDetail'>): Problem {
  const last = alert.history.at(-1);
  const what = last ? `${last.action}${last.by === '' ? '' : ` by ${last.by}`}` : `${alert.state} now`;
  return new Problem({
    kind: 'precondition-failed',
    status: 412,
    title: `Alert ${alert.id} changed meanwhile`,
    detail: `It was ${what}; nothing was done. Look at it again.`,
  });
}
