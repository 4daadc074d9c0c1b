import { describe, expect, it } from 'vitest';
import { localOf, momentOf, nextTimeOfDay } from './zone';

const utc = (local: string, zone: string): string => momentOf(local, zone).toISOString();

describe('what is typed on the clock of a zone', () => {
  it('is a moment, before and after the clocks change', () => {
    expect(utc('2026-03-28T06:00', 'Europe/Berlin')).toBe('2026-03-28T05:00:00.000Z');
    expect(utc('2026-03-29T06:00', 'Europe/Berlin')).toBe('2026-03-29T04:00:00.000Z');
    expect(utc('2026-03-29T06:00', 'Australia/Perth')).toBe('2026-03-28T22:00:00.000Z');
    expect(utc('2026-03-29T06:00', 'UTC')).toBe('2026-03-29T06:00:00.000Z');
  });

  it('has an answer in the hours that are left out, or come twice', () => {
    expect(utc('2026-03-29T02:30', 'Europe/Berlin')).toBe('2026-03-29T01:30:00.000Z');
    expect(utc('2026-10-25T02:30', 'Europe/Berlin')).toBe('2026-10-25T00:30:00.000Z');
  });

  it('reads back', () => {
    for (const zone of ['UTC', 'Europe/Berlin', 'America/St_Johns', 'Asia/Kathmandu']) {
      expect(localOf(momentOf('2026-07-01T13:45', zone), zone)).toBe('2026-07-01T13:45');
    }
  });

  it('is found for the next morning', () => {
    const evening_ms = Date.parse('2026-03-28T22:30:00Z');
    expect(nextTimeOfDay('06:00', 'Europe/Berlin', evening_ms).toISOString()).toBe('2026-03-29T04:00:00.000Z');
    const night_ms = Date.parse('2026-03-28T02:00:00Z');
    expect(nextTimeOfDay('06:00', 'Europe/Berlin', night_ms).toISOString()).toBe('2026-03-28T05:00:00.000Z');
  });
});
