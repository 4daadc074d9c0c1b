import { describe, expect, it } from 'vitest';
import { clockOf, dayOf, ago, bytes, counted, dateTime, duration, metres, percent, shortTime, volume } from './format';

/** Without caring which kind of blank stands before a unit. */
const plain = (text: string): string => text.replaceAll('\u00a0', ' ');

describe('what people read', () => {
  it('has its unit', () => {
    expect(plain(volume(0.0716))).toBe('71.6 L');
    expect(volume(1.2)).toContain('\u00a0m³');
    expect(plain(volume(1.2))).toBe('1.2 m³');
    expect(plain(percent(0.835))).toBe('84 %');
    expect([0, 999, 1000, 2_840_000_000].map(bytes).map(plain)).toEqual(['0 B', '999 B', '1 kB', '2.84 GB']);
    expect([0.34, 4.25, 59, 185, 7500, 270_000].map(duration).map(plain)).toEqual([
      '340 ms',
      '4.3 s',
      '59 s',
      '3 min',
      '2 h 05 min',
      '3 d 3 h',
    ]);
    expect([-0.001, -0.004, -0.006].map((value) => plain(metres(value)))).toEqual(['0.00 m', '0.00 m', '-0.01 m']);
    expect(counted(1, 'scan')).toBe('1 scan');
    expect(counted(3214, 'scan')).toBe('3,214 scans');
  });

  it('stands in the zone of the site, which is named', () => {
    const time = '2026-03-28T22:30:05Z';
    expect(dateTime(time, 'Europe/Berlin')).toBe('28 Mar 2026, 23:30:05 CET');
    expect(dateTime('2026-03-29T22:30:05Z', 'Europe/Berlin')).toBe('30 Mar 2026, 00:30:05 CEST');
    expect(shortTime(time, 'Australia/Perth', Date.parse('2026-03-28T23:00:00Z'))).toBe('06:30:05 GMT+8');
    expect(shortTime(time, 'Europe/Berlin', Date.parse('2026-03-28T23:30:00Z'))).toBe('28 Mar, 23:30:05 CET');
  });

  it('names the year where it is another one', () => {
    const now_ms = Date.parse('2026-03-28T23:30:00Z');
    expect(shortTime('2025-12-31T23:30:00Z', 'UTC', now_ms)).toBe('31 Dec 2025, 23:30:00 UTC');
    expect(shortTime('2025-12-31T23:30:00Z', 'Europe/Berlin', now_ms)).toBe('1 Jan, 00:30:00 CET');
  });

  it('says how long ago', () => {
    const now_ms = Date.parse('2026-03-28T12:00:00Z');
    expect(plain(ago('2026-03-28T11:57:00Z', now_ms))).toBe('3 min ago');
    expect(plain(ago('2026-03-28T12:00:01Z', now_ms))).toBe('just now');
    expect(plain(ago('2026-03-28T14:00:00Z', now_ms))).toBe('in 2 h 00 min');
  });

  it('name a night by its day', () => {
    const now_ms = Date.parse('2026-12-31T12:00:00Z');
    expect(dayOf('2026-11-20T20:00:00Z', 'Australia/Perth', now_ms)).toBe('Sat 21 Nov');
    expect(dayOf('2026-11-20T20:00:00Z', 'Australia/Perth', now_ms + 86_400_000)).toBe('Sat 21 Nov 2026');
    expect(clockOf('2026-11-20T05:00:00Z', 'Australia/Perth')).toMatch(/^13:00 (GMT\+8|AWST)$/);
  });
});
