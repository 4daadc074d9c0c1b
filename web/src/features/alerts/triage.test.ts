import { describe, expect, it } from 'vitest';
import { currentOf, noTriage, noteFor, reduceTriage, targetsOf, type Triage, type TriageAction } from './triage';

const ids = [9, 7, 5];
const after = (...actions: TriageAction[]): Triage => actions.reduce(reduceTriage, noTriage);
const down = (list = ids): TriageAction => ({ type: 'triage/moved', ids: list, by: 1 });
const up = (list = ids): TriageAction => ({ type: 'triage/moved', ids: list, by: -1 });

describe('triage', () => {
  it('goes down and up and stops at the ends', () => {
    expect(after(down()).current).toBe(9);
    expect(after(down(), down(), down(), down()).current).toBe(5);
    expect(after(down(), up(), up()).current).toBe(9);
    expect(after(down([])).current).toBeUndefined();
  });

  it('goes on at the same place when the alert leaves the list', () => {
    const triage = after(down(), down()); // at 7
    expect(currentOf(triage, [9, 5])).toBe(5);
    expect(currentOf(triage, [9])).toBe(9);
    expect(currentOf(triage, [])).toBeUndefined();
    expect(reduceTriage(triage, down([9, 5])).current).toBe(5);
  });

  it('stays with its alert when others come before it', () => {
    const triage = after(down(), down()); // at 7
    expect(currentOf(triage, [11, 9, 7, 5])).toBe(7);
    expect(reduceTriage(triage, down([11, 9, 7, 5])).current).toBe(5);
  });

  it('keeps what is typed about an alert until something is done', () => {
    const drafted = after({ type: 'triage/drafted', id: 7, note: 'on my way' });
    expect(noteFor(drafted, [7])).toBe('on my way');
    expect(noteFor(drafted, [9])).toBe('');
    expect(noteFor(drafted, [7, 9])).toBe('');
    expect(noteFor(reduceTriage(drafted, { type: 'triage/cleared' }), [7])).toBe('');
  });

  it('acts on what is marked and still listed, else on the current one', () => {
    const marked = after(down(), { type: 'triage/marked', id: 5 }, { type: 'triage/marked', id: 7 });
    expect(targetsOf(marked, ids)).toEqual([7, 5]);
    expect(targetsOf(marked, [9, 5])).toEqual([5]);
    expect(targetsOf(marked, [9])).toEqual([9]);
    expect(reduceTriage(marked, { type: 'triage/marked', id: 5 }).marked).toEqual([7]);
    expect(targetsOf(reduceTriage(marked, { type: 'triage/cleared' }), ids)).toEqual([9]);
  });
});
