// The hand that draws an outline on the picture from above: what a press, a click and a key mean for it.

import type { PickedPlace } from '../../ui/top_view/top_view';
import { type Place } from '../../ui/top_view/frame';
import { type Tool } from '../../ui/top_view/gestures';
import { type OutlineAction, type OutlineEdit } from './outline_edit';

export type Dispatch = (action: OutlineAction) => void;

/** To the centimetre, which is finer than a hand draws. */
const rounded = ([x, y]: Place): Place => [Math.round(x * 100) / 100, Math.round(y * 100) / 100];

const distance = (one: Place, other: Place): number => Math.hypot(one[0] - other[0], one[1] - other[1]);

function nearest(places: readonly Place[], at: Place, reach_m: number): number | undefined {
  let best: number | undefined;
  for (const [index, place] of places.entries()) {
    const far = distance(place, at);
    if (far <= reach_m && (best === undefined || far < distance(places[best]!, at))) best = index;
  }
  return best;
}

/** The places between corners where another can be pulled out. */
export const middlesOf = ({ corners, closed }: Pick<OutlineEdit, 'corners' | 'closed'>): Place[] =>
  corners
    .map((corner, index): Place => {
      const next = corners[(index + 1) % corners.length] ?? corner;
      return [(corner[0] + next[0]) / 2, (corner[1] + next[1]) / 2];
    })
    .slice(0, closed ? corners.length : Math.max(0, corners.length - 1));

/** Takes hold of corners, and of the places between them. The first corner, pressed and let go, closes the outline. */
export class OutlineTool implements Tool {
  private still: number | undefined;

  constructor(
    private readonly edit: () => OutlineEdit,
    private readonly dispatch: Dispatch,
  ) {}

  press(at: Place, reach_m: number): boolean {
    const corner = nearest(this.edit().corners, at, reach_m);
    this.still = corner;
    if (corner !== undefined) this.dispatch({ type: 'held', corner });
    else {
      const after = nearest(middlesOf(this.edit()), at, reach_m * 0.7);
      if (after === undefined) return false;
      this.dispatch({ type: 'inserted', after, at: rounded(at) });
    }
    return true;
  }

  drag(at: Place): void {
    this.still = undefined;
    this.dispatch({ type: 'pulled', to: rounded(at) });
  }

  release(): void {
    this.dispatch({ type: 'let go' });
    if (this.still === 0) this.dispatch({ type: 'closed' });
  }
}

/** A click beside all corners, or Enter with the place in the middle. */
export function placed(edit: OutlineEdit, { place_m, reach_m }: PickedPlace, dispatch: Dispatch): void {
  if (edit.closed) dispatch({ type: 'held', corner: undefined });
  else if (nearest(edit.corners.slice(0, 1), place_m, reach_m) === 0) dispatch({ type: 'closed' });
  else dispatch({ type: 'added', at: rounded(place_m) });
}

const kNudge_m = 0.1;
const kNudges: Readonly<Record<string, Place>> = {
  ArrowLeft: [-kNudge_m, 0],
  ArrowRight: [kNudge_m, 0],
  ArrowUp: [0, kNudge_m],
  ArrowDown: [0, -kNudge_m],
};

/** What a key that the picture does not use means for the outline. */
export function pressed(edit: OutlineEdit, event: KeyboardEvent, dispatch: Dispatch): boolean {
  const action = actionOf(edit, event);
  if (action) dispatch(action);
  return action !== undefined;
}

function actionOf(edit: OutlineEdit, event: KeyboardEvent): OutlineAction | undefined {
  const { corners, held } = edit;
  const key = event.key.toLowerCase();
  if (event.ctrlKey || event.metaKey) {
    const nudge = kNudges[event.key];
    const corner = held === undefined ? undefined : corners[held];
    if (nudge && corner && held !== undefined) {
      return { type: 'moved', corner: held, to: rounded([corner[0] + nudge[0], corner[1] + nudge[1]]) };
    }
    if (key === 'z') return { type: event.shiftKey ? 'redone' : 'undone' };
    return key === 'y' ? { type: 'redone' } : undefined;
  }
  if (key === 'delete' || key === 'backspace') return { type: 'removed', corner: held ?? corners.length - 1 };
  if (key === 'escape') return { type: 'held', corner: undefined };
  if (key === 'c') return { type: 'closed' };
  if (corners.length > 0 && (key === '[' || key === ']')) {
    const from = held ?? (key === ']' ? -1 : 0);
    return { type: 'held', corner: (from + (key === ']' ? 1 : -1) + corners.length) % corners.length };
  }
  return undefined;
}
