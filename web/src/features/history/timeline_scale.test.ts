import { describe, expect, it } from 'vitest';
import { piecesOf, rangeOf, shareOf, ticksOf } from './timeline_scale';
import { spanAround } from './range';
import { type Interval } from './words';

const interval = (state: Interval['state'], from: string, to: string): Interval => ({
  state,
  from,
  to,
  first_scan: 1,
  last_scan: 2,
  scans: 2,
  not_seen: 0,
});
const kBerlin = 'Europe/Berlin';

describe('a line of time', () => {
  it('places moments, and cuts what lies beyond', () => {
    const range = { from_ms: 1000, to_ms: 2000 };
    expect([500, 1000, 1250, 2000, 9000].map((moment) => shareOf(moment, range))).toEqual([0, 0, 0.25, 1, 1]);
    const all = rangeOf([
      interval('free', '2026-03-01T00:00:00Z', '2026-03-01T01:00:00Z'),
      interval('occupied', '2026-03-01T02:00:00Z', '2026-03-01T03:20:00Z'),
    ]);
    expect(all).toEqual({ from_ms: Date.parse('2026-02-28T23:56:00Z'), to_ms: Date.parse('2026-03-01T03:24:00Z') });
    expect(rangeOf([])).toBeUndefined();
  });

  it('draws together what is too short to be told apart', () => {
    const range = spanAround(Date.parse('2026-03-01T12:00:00Z'), 'day', 'UTC');
    const many = [
      interval('free', '2026-03-01T00:00:00Z', '2026-03-01T10:00:00Z'),
      interval('occupied', '2026-03-01T10:01:00Z', '2026-03-01T10:02:00Z'),
      interval('free', '2026-03-01T10:03:00Z', '2026-03-01T10:04:00Z'),
      interval('occupied', '2026-03-01T10:05:00Z', '2026-03-01T20:00:00Z'),
    ];
    expect(piecesOf(many, range).map(({ intervals }) => intervals.length)).toEqual([1, 2, 1]);
    const seconds = Array.from({ length: 5000 }, (_, index) => {
      const at = new Date(range.from_ms + index * 10_000).toISOString();
      return interval(index % 2 ? 'free' : 'occupied', at, at);
    });
    expect(piecesOf(seconds, range).length).toBeLessThan(260);
  });

  it('has ticks at round times of the zone, also when clocks are changed', () => {
    const hours = ticksOf(spanAround(Date.parse('2026-03-01T12:00:00Z'), 'day', kBerlin), kBerlin);
    expect(hours.map(({ moment_ms }) => new Date(moment_ms).toISOString().slice(11, 16))).toEqual([
      '23:00',
      '02:00',
      '05:00',
      '08:00',
      '11:00',
      '14:00',
      '17:00',
      '20:00',
    ]);
    const days = ticksOf(spanAround(Date.parse('2026-03-29T12:00:00Z'), 'month', kBerlin), kBerlin);
    expect(days.map(({ moment_ms }) => new Date(moment_ms).toISOString().slice(5, 16))).toEqual([
      '02-28T23:00',
      '03-07T23:00',
      '03-14T23:00',
      '03-21T23:00',
      '03-28T23:00',
    ]);
    const minutes = ticksOf(
      { from_ms: Date.parse('2026-03-01T08:00:20Z'), to_ms: Date.parse('2026-03-01T08:06:40Z') },
      kBerlin,
    );
    expect(minutes.map(({ moment_ms }) => new Date(moment_ms).toISOString().slice(14, 19))).toEqual([
      '01:00',
      '02:00',
      '03:00',
      '04:00',
      '05:00',
      '06:00',
    ]);
  });
});
