import { expect, it } from 'vitest';
import { findingsOf } from './findings';

const change = (scan: number, second: number, points: number) => ({
  scan,
  captured_at: `2026-03-01T08:00:${String(second).padStart(2, '0')}Z`,
  volume_m3: 0.5,
  points,
});

it('the pieces that one scan found are one finding, and findings go with time', () => {
  const start_s = Date.parse('2026-03-01T08:00:00Z') / 1000;
  expect(findingsOf([change(7, 30, 5), change(3, 10, 40), change(3, 10, 2)])).toEqual([
    { at_s: start_s + 10, volume_m3: 1, points: 42 },
    { at_s: start_s + 30, volume_m3: 0.5, points: 5 },
  ]);
  expect(findingsOf([])).toEqual([]);
});
