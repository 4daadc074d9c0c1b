// Where the keyboard stands in the inbox, and which alerts are marked for an action on all of them.

export interface Triage {
  /** The alert that keys act on. */
  readonly current: number | undefined;
  /** Its place in the list, for when it leaves the list: the next one takes it. */
  readonly place: number;
  readonly marked: readonly number[];
  /** What was typed about one alert and is not sent yet. */
  readonly draft: { readonly id: number; readonly note: string } | undefined;
}

export const noTriage: Triage = { current: undefined, place: 0, marked: [], draft: undefined };

/** `ids` are the alerts as they are listed now, which may change at any moment. */
export type TriageAction =
  | { type: 'triage/moved'; ids: readonly number[]; by: 1 | -1 }
  | { type: 'triage/pointed'; ids: readonly number[]; id: number }
  | { type: 'triage/marked'; id: number }
  | { type: 'triage/marked-all'; ids: readonly number[] }
  | { type: 'triage/drafted'; id: number; note: string }
  | { type: 'triage/cleared' };

export function reduceTriage(triage: Triage, action: TriageAction): Triage {
  switch (action.type) {
    case 'triage/moved':
      return moved(triage, action.ids, action.by);
    case 'triage/pointed':
      return { ...triage, current: action.id, place: Math.max(0, action.ids.indexOf(action.id)) };
    case 'triage/marked':
      return {
        ...triage,
        marked: triage.marked.includes(action.id)
          ? triage.marked.filter((id) => id !== action.id)
          : [...triage.marked, action.id],
      };
    case 'triage/marked-all':
      return { ...triage, marked: [...action.ids] };
    case 'triage/drafted':
      return { ...triage, draft: { id: action.id, note: action.note } };
    case 'triage/cleared':
      return triage.marked.length === 0 && !triage.draft ? triage : { ...triage, marked: [], draft: undefined };
  }
}

function moved(triage: Triage, ids: readonly number[], by: 1 | -1): Triage {
  if (ids.length === 0) return triage;
  const here = currentOf(triage, ids);
  const place = triage.current === undefined ? 0 : here !== triage.current ? triage.place : ids.indexOf(here) + by;
  const kept = Math.min(Math.max(place, 0), ids.length - 1);
  return { ...triage, current: ids[kept], place: kept };
}

/** The alert that keys act on; when it left the list, the one that took its place. */
export function currentOf(triage: Triage, ids: readonly number[]): number | undefined {
  if (triage.current === undefined) return undefined;
  if (ids.includes(triage.current)) return triage.current;
  return ids[Math.min(triage.place, ids.length - 1)];
}

/** What an action is carried out on: what is marked and still listed, else the current one. */
export function targetsOf(triage: Triage, ids: readonly number[]): number[] {
  const marked = ids.filter((id) => triage.marked.includes(id));
  if (marked.length > 0) return marked;
  const current = currentOf(triage, ids);
  return current === undefined ? [] : [current];
}

/** The note that goes with an action on these alerts: what was typed about the only one. */
export function noteFor(triage: Triage, ids: readonly number[]): string {
  return ids.length === 1 && triage.draft?.id === ids[0] ? (triage.draft?.note ?? '') : '';
}
