import { describe, expect, it } from 'vitest';
import { bodyOf, byHandLike, faultsOf, newByHand } from './by_hand_draft';

const epochs = [
  { id: 9, state: 'refused' as const },
  { id: 7, state: 'accepted' as const },
  { id: 4, state: 'usable' as const },
  { id: 2, state: 'usable' as const },
];

describe('a survey by hand', () => {
  it('begins with the latest two epochs that can be used', () => {
    const draft = newByHand(epochs);
    expect(bodyOf(draft, 'pit', 'Australia/Perth')).toEqual({
      site: 'pit',
      before: 4,
      after: 7,
      survey: { zones: [], cell_m: 1, core_spacing_m: 1, density_t_per_m3: null, greatest_slope_deg: null },
    });
    expect(faultsOf(draft)).toEqual({});
  });

  it('is made once more with the same epochs and settings', () => {
    const definition = { zones: [3], cell_m: 2, core_spacing_m: 0.5, density_t_per_m3: 2.65, greatest_slope_deg: null };
    const survey = { before: { epoch: 2 }, after: { epoch: 4 }, ground: { survey: definition } };
    const draft = byHandLike(survey as unknown as Parameters<typeof byHandLike>[0]);
    expect(bodyOf(draft, 'pit', 'UTC')).toEqual({ site: 'pit', before: 2, after: 4, survey: definition });
  });

  it('asks for time windows where there are no two epochs', () => {
    const draft = newByHand(epochs.slice(0, 2));
    expect([draft.before.by, draft.after.by]).toEqual(['window', 'window']);
    expect(Object.keys(faultsOf(draft))).toEqual(['before.from', 'before.to', 'after.from', 'after.to']);
  });

  it('takes times on the clock of the site', () => {
    const window = { by: 'window', epoch: '', from: '2026-03-01T07:00', to: '2026-03-01T13:00' } as const;
    const draft = { ...newByHand(epochs), before: window };
    expect(bodyOf(draft, 'pit', 'Australia/Perth').before).toEqual({
      from: '2026-02-28T23:00:00.000Z',
      to: '2026-03-01T05:00:00.000Z',
    });
  });

  it('says which epoch is missing', () => {
    const { before, after, ...rest } = newByHand(epochs);
    expect(faultsOf({ ...rest, after, before: { ...before, epoch: '' } })).toEqual({ before: 'needs an epoch' });
  });
});
