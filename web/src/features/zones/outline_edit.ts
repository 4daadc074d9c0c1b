// Drawing and changing an outline, step by step, with each step to be taken back. Pure: the picture, the table of corners
// and the keyboard all send the same actions.

import { type Place } from '../../ui/top_view/frame';

export interface Outline {
  readonly corners: readonly Place[];
  /** Whether the last corner is joined to the first; until then corners are added at the end. */
  readonly closed: boolean;
}

export interface OutlineEdit extends Outline {
  /** The corner that is taken hold of. */
  readonly held: number | undefined;
  /** A pull is under way: all of its moves are one step. */
  readonly pulling: boolean;
  readonly past: readonly Outline[];
  readonly future: readonly Outline[];
}

export type OutlineAction =
  | { type: 'added'; at: Place }
  | { type: 'closed' }
  | { type: 'held'; corner: number | undefined }
  | { type: 'inserted'; after: number; at: Place }
  | { type: 'pulled'; to: Place }
  | { type: 'let go' }
  | { type: 'moved'; corner: number; to: Place }
  | { type: 'removed'; corner: number }
  | { type: 'cleared' }
  | { type: 'undone' }
  | { type: 'redone' };

const kLeastCorners = 3;

export const beginOutline = (corners: readonly Place[] = []): OutlineEdit => ({
  corners,
  closed: corners.length > 0,
  held: undefined,
  pulling: false,
  past: [],
  future: [],
});

export function reduceOutline(edit: OutlineEdit, action: OutlineAction): OutlineEdit {
  const { corners } = edit;
  switch (action.type) {
    case 'added':
      return edit.closed ? edit : step(edit, { corners: [...corners, action.at] }, corners.length);
    case 'closed':
      return edit.closed || corners.length < kLeastCorners ? edit : step(edit, { closed: true }, undefined);
    case 'held':
      return { ...edit, held: action.corner, pulling: false };
    case 'inserted':
      return inserted(edit, action);
    case 'pulled':
      return pulled(edit, action.to);
    case 'let go':
      return { ...edit, pulling: false };
    case 'moved':
      return step(edit, { corners: moved(corners, action.corner, action.to) }, action.corner);
    case 'removed':
      return removed(edit, action.corner);
    case 'cleared':
      return step(edit, { corners: [], closed: false }, undefined);
    case 'undone':
      return undone(edit);
    case 'redone':
      return redone(edit);
  }
}

const moved = (corners: readonly Place[], corner: number, to: Place): Place[] =>
  corners.map((each, at) => (at === corner ? to : each));

const outlineOf = ({ corners, closed }: Outline): Outline => ({ corners, closed });

function step(edit: OutlineEdit, change: Partial<Outline>, held: number | undefined): OutlineEdit {
  return { ...edit, ...change, held, pulling: false, past: [...edit.past, outlineOf(edit)], future: [] };
}

/** A new corner that is pulled on at once is one step with its pull. */
function inserted(edit: OutlineEdit, { after, at }: { after: number; at: Place }): OutlineEdit {
  return {
    ...step(edit, { corners: [...edit.corners.slice(0, after + 1), at, ...edit.corners.slice(after + 1)] }, after + 1),
    pulling: true,
  };
}

function pulled(edit: OutlineEdit, to: Place): OutlineEdit {
  if (edit.held === undefined || edit.held >= edit.corners.length) return edit;
  const corners = moved(edit.corners, edit.held, to);
  return edit.pulling ? { ...edit, corners } : { ...step(edit, { corners }, edit.held), pulling: true };
}

/** What is left of fewer than three corners is open again. */
function removed(edit: OutlineEdit, corner: number): OutlineEdit {
  if (corner < 0 || corner >= edit.corners.length) return edit;
  const corners = edit.corners.filter((_, each) => each !== corner);
  return step(edit, { corners, closed: edit.closed && corners.length >= kLeastCorners }, undefined);
}

function undone(edit: OutlineEdit): OutlineEdit {
  const before = edit.past.at(-1);
  if (!before) return edit;
  return {
    ...before,
    held: undefined,
    pulling: false,
    past: edit.past.slice(0, -1),
    future: [outlineOf(edit), ...edit.future],
  };
}

function redone(edit: OutlineEdit): OutlineEdit {
  const [next, ...future] = edit.future;
  if (!next) return edit;
  return { ...next, held: undefined, pulling: false, past: [...edit.past, outlineOf(edit)], future };
}
