import { describe, expect, it } from 'vitest';
import { draftOf, limitsOf } from './limits';
import { sharesOf } from './shares';

describe('what the disk is full of', () => {
  it('adds up to the disk', () => {
    const shares = sharesOf({
      sites: [
        { site: 'yard', payload_bytes: 300 },
        { site: 'quarry', payload_bytes: 200 },
      ],
      metadata_bytes: 50,
      metadata_copies_bytes: 10,
      spool_bytes: 5,
      disk: { bytes: 1000, free_bytes: 400 },
    } as unknown as Parameters<typeof sharesOf>[0]);
    expect(shares.reduce((sum, { bytes }) => sum + bytes, 0)).toBe(1000);
    expect(shares.find(({ look }) => look === 'others')?.bytes).toBe(35);
  });
});

describe('limits of retention', () => {
  it('are bytes to the daemon and gigabytes to people, and empty where nothing is said', () => {
    const limits = { max_age_days: 30, max_bytes: 2_500_000_000, min_free_bytes: null };
    const draft = { max_age_days: '30', max_gb: '2.5', min_free_gb: '' };
    expect(draftOf(limits)).toEqual(draft);
    expect(limitsOf(draft)).toEqual(limits);
    expect(limitsOf({ ...draft, max_age_days: '0' }).max_age_days).toBe(0);
  });
});
