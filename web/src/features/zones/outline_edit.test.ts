import { describe, expect, it } from 'vitest';
import type { Place } from '../../ui/top_view/frame';
import { bodyOf, emptyDraft, faultsOf } from './draft';
import { OutlineTool, placed, pressed } from './drawing';
import { beginOutline, type OutlineAction, type OutlineEdit, reduceOutline } from './outline_edit';

/** An outline and what is done to it, as a view holds it. */
function desk(corners: readonly Place[] = []) {
  let edit: OutlineEdit = beginOutline(corners);
  const dispatch = (action: OutlineAction): void => void (edit = reduceOutline(edit, action));
  return { now: () => edit, dispatch, tool: new OutlineTool(() => edit, dispatch) };
}

const click = (desk_: ReturnType<typeof desk>, at: Place): void => {
  if (desk_.tool.press(at, 0.2)) desk_.tool.release();
  else placed(desk_.now(), { place_m: at, reach_m: 0.2, ground_m: 0, top_m: 0 }, desk_.dispatch);
};

const triangle: readonly Place[] = [
  [0, 0],
  [4, 0],
  [4, 4],
];

const key = (name: string, more: Partial<KeyboardEvent> = {}) => ({ key: name, ...more }) as KeyboardEvent;

describe('drawing an outline', () => {
  it('goes by clicks, and a click on the first corner closes it', () => {
    const it_ = desk();
    for (const corner of triangle) click(it_, corner);
    expect(it_.now()).toMatchObject({ corners: triangle, closed: false });
    click(it_, [0.05, 0.05]);
    expect(it_.now()).toMatchObject({ corners: triangle, closed: true });
    click(it_, [9, 9]);
    expect(it_.now().corners).toEqual(triangle);
  });

  it('is not closed by fewer than three corners', () => {
    const it_ = desk();
    for (const corner of triangle.slice(0, 2)) click(it_, corner);
    click(it_, [0, 0]);
    expect(it_.now().closed).toBe(false);
  });

  it('pulls a corner, in one step however long the way', () => {
    const it_ = desk(triangle);
    expect(it_.tool.press([4.1, 4.1], 0.2)).toBe(true);
    for (const y of [5, 6, 7.004]) it_.tool.drag([4, y]);
    it_.tool.release();
    expect(it_.now().corners[2]).toEqual([4, 7]);
    it_.dispatch({ type: 'undone' });
    expect(it_.now().corners).toEqual(triangle);
    it_.dispatch({ type: 'redone' });
    expect(it_.now().corners[2]).toEqual([4, 7]);
  });

  it('pulls a new corner out of the middle of a side, also of the last one', () => {
    const it_ = desk(triangle);
    it_.tool.press([2, 2], 0.2);
    it_.tool.drag([1, 3]);
    it_.tool.release();
    expect(it_.now().corners).toEqual([...triangle, [1, 3]]);
    it_.dispatch({ type: 'undone' });
    expect(it_.now().corners).toEqual(triangle);
    expect(it_.tool.press([9, 9], 0.2)).toBe(false);
  });

  it('takes corners away, and is open again when too few are left', () => {
    const it_ = desk([...triangle, [0, 4]]);
    it_.dispatch({ type: 'removed', corner: 1 });
    expect(it_.now()).toMatchObject({ closed: true, held: undefined });
    it_.dispatch({ type: 'removed', corner: 0 });
    expect(it_.now()).toMatchObject({
      corners: [
        [4, 4],
        [0, 4],
      ],
      closed: false,
    });
    it_.dispatch({ type: 'removed', corner: 7 });
    expect(it_.now().corners).toHaveLength(2);
  });

  it('goes by keys, too', () => {
    const it_ = desk(triangle);
    expect(pressed(it_.now(), key(']'), it_.dispatch)).toBe(true);
    expect(it_.now().held).toBe(0);
    pressed(it_.now(), key('['), it_.dispatch);
    expect(it_.now().held).toBe(2);
    pressed(it_.now(), key('ArrowUp', { ctrlKey: true }), it_.dispatch);
    expect(it_.now().corners[2]).toEqual([4, 4.1]);
    pressed(it_.now(), key('z', { ctrlKey: true }), it_.dispatch);
    expect(it_.now().corners).toEqual(triangle);
    pressed(it_.now(), key('Z', { ctrlKey: true, shiftKey: true }), it_.dispatch);
    expect(it_.now().corners[2]).toEqual([4, 4.1]);
    pressed(it_.now(), key(']'), it_.dispatch);
    pressed(it_.now(), key('Delete'), it_.dispatch);
    expect(it_.now().corners).toHaveLength(2);
    expect(pressed(it_.now(), key('q'), it_.dispatch)).toBe(false);
  });

  it('never loses a step, whatever is done', () => {
    const it_ = desk();
    const actions: OutlineAction[] = [
      ...triangle.map((at): OutlineAction => ({ type: 'added', at })),
      { type: 'closed' },
      { type: 'moved', corner: 1, to: [5, 0] },
      { type: 'inserted', after: 1, at: [5, 2] },
      { type: 'removed', corner: 0 },
      { type: 'cleared' },
    ];
    const seen = actions.map((action) => {
      it_.dispatch(action);
      return it_.now().corners;
    });
    for (const corners of seen.slice(0, -1).reverse()) {
      it_.dispatch({ type: 'undone' });
      expect(it_.now().corners).toEqual(corners);
    }
    for (const corners of seen.slice(1)) {
      it_.dispatch({ type: 'redone' });
      expect(it_.now().corners).toEqual(corners);
    }
  });
});

describe('a zone that is filled in', () => {
  it('says what is wrong with it by the names of its fields', () => {
    expect(Object.keys(faultsOf(emptyDraft, beginOutline()))).toEqual(['name', 'polygon_m', 'z_min_m', 'z_max_m']);
    const draft = { ...emptyDraft, name: 'gate', z_min_m: '2', z_max_m: '1' };
    expect(faultsOf(draft, beginOutline(triangle))).toEqual({ z_max_m: 'must be above the lower end' });
    const crossed = beginOutline([
      [0, 0],
      [4, 4],
      [4, 0],
      [0, 4],
    ]);
    expect(faultsOf({ ...draft, z_max_m: '3' }, crossed).polygon_m).toContain('corners 1 and 3 meet');
    expect(faultsOf({ ...draft, z_max_m: '3' }, { ...beginOutline(triangle), closed: false }).polygon_m).toContain(
      'open',
    );
  });

  it('is sent as numbers', () => {
    const draft = { ...emptyDraft, name: ' gate ', z_min_m: '-0.5', z_max_m: '3' };
    expect(bodyOf(draft, beginOutline(triangle))).toEqual({
      name: 'gate',
      kind: 'alert',
      polygon_m: [
        [0, 0],
        [4, 0],
        [4, 4],
      ],
      z_min_m: -0.5,
      z_max_m: 3,
    });
  });
});
