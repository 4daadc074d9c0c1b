import { describe, expect, it } from 'vitest';
import { courseOf, limitsOf, rangeOf } from './series_data';

const value = (at: string, value: number, spread: number | null) => ({
  survey: 1,
  at,
  value,
  low: spread === null ? null : value - spread,
  high: spread === null ? null : value + spread,
  trend: value,
  level: null,
});
const series = (figure: 'net_m3' | 'seen_share', values: ReturnType<typeof value>[]) => ({
  figure,
  unit: '',
  zone: null,
  schedule: 1,
  cumulative: true,
  values,
  velocities: [],
  forecast: null,
});
const thresholds = {
  figure: 'net_m3' as const,
  zone: null,
  yellow: 200,
  orange: null,
  red: 1000,
  clear_share: 0.9,
  raise_after: 1,
  clear_after: 2,
};

describe('a series of a figure', () => {
  it('has a gap at each run without a result, and only there', () => {
    const nights = [value('2026-03-01T02:00:00Z', 5, 1), value('2026-03-03T02:00:00Z', 7, 1)];
    const course = courseOf(series('net_m3', nights), [
      { due_at: '2026-03-01T05:00:00Z', state: 'done' },
      { due_at: '2026-03-02T05:00:00Z', state: 'no_scans' },
    ]);
    expect(course.values).toEqual([5, null, 7]);
    expect(course.low).toEqual([4, null, 6]);
    expect(course.at_s).toEqual([...course.at_s].sort());
  });

  it('of shares is in per cent', () => {
    expect(courseOf(series('seen_share', [value('2026-03-01T02:00:00Z', 0.7, null)]), []).values).toEqual([70]);
  });

  it('has its levels on both sides of zero only where it can be below', () => {
    expect(limitsOf('net_m3', thresholds).map(({ at }) => at)).toEqual([200, -200, 1000, -1000]);
    expect(limitsOf('cut_m3', thresholds).map(({ at }) => at)).toEqual([200, 1000]);
    expect(limitsOf('greatest_fall_m', thresholds).map(({ at }) => at)).toEqual([-200, -1000]);
    expect(limitsOf('net_m3', undefined)).toEqual([]);
  });

  it('shows zero, all of the interval, and the level that is near, but not one that is far', () => {
    const course = { values: [150, null], low: [100, null], high: [190, null] };
    const [low, high] = rangeOf(course, limitsOf('cut_m3', thresholds));
    expect(low).toBe(0);
    expect(high).toBeGreaterThan(200);
    expect(high).toBeLessThan(300);
  });
});
