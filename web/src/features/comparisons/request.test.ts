import { describe, expect, it } from 'vitest';
import { type Schema } from '../../lib/api';
import { draftLike, draftOf, requestFrom } from './request';

const kBerlin = 'Europe/Berlin';
const comparison = (reference: Schema<'Reference'>): Schema<'Comparison'> =>
  ({ scan: 7, reference, parameters: { grouping: 'consensus', range_m: 0.3 } }) as Schema<'Comparison'>;

describe('a comparison by hand', () => {
  it('is what its link says', () => {
    const { request, errors } = requestFrom(draftOf({ scan: '12', reference: 'scans', scans: '3,5' }), kBerlin);
    expect(request).toEqual({ scan: 12, reference: { scans: [3, 5] }, parameters: { grouping: 'consensus' } });
    expect(errors.size).toBe(0);
    expect(requestFrom(draftOf({ scan: '12' }), kBerlin).request.reference).toBe('previous');
  });

  it('has its time range on the clock of the site', () => {
    const draft = {
      ...draftOf({ scan: '1' }),
      kind: 'window' as const,
      from: '2026-03-01T00:00',
      to: '2026-03-01T06:00',
    };
    expect(requestFrom(draft, kBerlin).request.reference).toEqual({
      from: '2026-02-28T23:00:00.000Z',
      to: '2026-03-01T05:00:00.000Z',
    });
  });

  it('says what is missing by the names that the daemon has for it', () => {
    const errors = (query: Record<string, string>) => [...requestFrom(draftOf(query), kBerlin).errors.keys()];
    expect(errors({})).toEqual(['scan']);
    expect(errors({ scan: '1, 2' })).toEqual(['scan']);
    expect(errors({ scan: '1', reference: 'window' })).toEqual(['reference.from', 'reference.to']);
    expect(errors({ scan: '1', reference: 'scans', scans: 'all' })).toEqual(['reference.scans']);
    const draft = { ...draftOf({ scan: '1' }), texts: { angle_deg: 'wide' } };
    expect([...requestFrom(draft, kBerlin).errors.keys()]).toEqual(['parameters.angle_deg']);
  });

  it('can be made again', () => {
    const defaults = { grouping: 'consensus' as const, range_m: 0.15 };
    for (const reference of [
      'baseline' as const,
      { scans: [3, 5] },
      { from: '2026-02-28T23:00:00.000Z', to: '2026-03-01T05:00:00.000Z' },
    ]) {
      expect(requestFrom(draftLike(comparison(reference), defaults, kBerlin), kBerlin).request).toEqual({
        scan: 7,
        reference,
        parameters: { grouping: 'consensus', range_m: 0.3 },
      });
    }
  });
});
