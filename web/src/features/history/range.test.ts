import { describe, expect, it } from 'vitest';
import { addMonths, neighbour, spanAround, spanOf, weekday } from './range';

const kBerlin = 'Europe/Berlin';
const around = (time: string, span: 'day' | 'week' | 'month', zone = kBerlin) => {
  const { from_ms, to_ms } = spanAround(Date.parse(time), span, zone);
  return [new Date(from_ms).toISOString(), new Date(to_ms).toISOString()];
};

describe('ranges of a calendar', () => {
  it('begin and end with the days of the zone, also when clocks are changed', () => {
    expect(around('2026-03-01T23:30:00Z', 'day')).toEqual(['2026-03-01T23:00:00.000Z', '2026-03-02T23:00:00.000Z']);
    expect(around('2026-03-29T12:00:00Z', 'day')).toEqual(['2026-03-28T23:00:00.000Z', '2026-03-29T22:00:00.000Z']);
    expect(around('2026-03-29T12:00:00Z', 'week')).toEqual(['2026-03-22T23:00:00.000Z', '2026-03-29T22:00:00.000Z']);
    expect(around('2026-03-29T12:00:00Z', 'month')).toEqual(['2026-02-28T23:00:00.000Z', '2026-03-31T22:00:00.000Z']);
    expect(around('2026-12-31T23:30:00Z', 'month', 'UTC')).toEqual([
      '2026-12-01T00:00:00.000Z',
      '2027-01-01T00:00:00.000Z',
    ]);
  });

  it('are known again, and have neighbours', () => {
    for (const span of ['day', 'week', 'month'] as const) {
      const range = spanAround(Date.parse('2026-03-29T12:00:00Z'), span, kBerlin);
      expect(spanOf(range, kBerlin)).toBe(span);
      const next = neighbour(range, 1, kBerlin);
      expect(next.from_ms).toBe(range.to_ms);
      expect(spanOf(next, kBerlin)).toBe(span);
      expect(neighbour(next, -1, kBerlin)).toEqual(range);
    }
    const hour = { from_ms: 0, to_ms: 3_600_000 };
    expect(spanOf(hour, kBerlin)).toBeUndefined();
    expect(neighbour(hour, -1, kBerlin)).toEqual({ from_ms: -3_600_000, to_ms: 0 });
  });

  it('know weekdays and the lengths of months', () => {
    expect(weekday('2026-03-02')).toBe(0);
    expect(weekday('2026-03-01')).toBe(6);
    expect(addMonths('2026-01-31', 1)).toBe('2026-02-28');
    expect(addMonths('2026-03-31', -1)).toBe('2026-02-28');
    expect(addMonths('2026-12-15', 1)).toBe('2027-01-15');
  });
});
