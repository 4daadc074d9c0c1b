import { describe, expect, it } from 'vitest';
import { healthOf } from './health';

const noon_ms = Date.parse('2026-03-01T12:00:00Z');
const sensor = { name: 'mast', interval_s: null };
const scan = {
  captured_at: '2026-03-01T11:59:00Z',
  state: 'compared' as const,
  failure: null,
  registration: {
    state: 'good' as const,
    correction: { position_m: [0, 0, 0], orientation_xyzw: [0, 0, 0, 1] },
    shift_m: 0,
    turn_deg: 0,
    residual_m: null,
    inliers: null,
    against: null,
    uncertainty: null,
  },
};
type Scan = Parameters<typeof healthOf>[1];
const word = (given: object, alerts: Parameters<typeof healthOf>[2] = []): string =>
  healthOf(sensor, { ...scan, ...given } as Scan, alerts, noon_ms).word;

describe('the health of a sensor', () => {
  it('is good when its latest scan was compared and nothing is told of it', () => {
    expect(word({})).toBe('good');
    expect(word({ state: 'queued' })).toBe('queued');
    expect(word({ state: 'failed', failure: 'too few points' })).toBe('failed');
    expect(healthOf(sensor, undefined, [], noon_ms).word).toBe('no scans yet');
  });

  it('is what the system alerts of, as long as that stands', () => {
    const moved = { sensor: 'mast', cause: 'sensor-moved', title: 'It was moved.', state: 'open' as const };
    expect(word({}, [moved])).toBe('moved');
    expect(word({}, [{ ...moved, state: 'resolved' }])).toBe('good');
    expect(word({}, [{ ...moved, sensor: 'gate' }])).toBe('good');
    expect(word({}, [{ ...moved, cause: 'change' }])).toBe('good');
  });

  it('is silence after two intervals without a scan', () => {
    const after = (interval_s: number): string => healthOf({ ...sensor, interval_s }, scan as Scan, [], noon_ms).word;
    expect(after(31)).toBe('good');
    expect(after(29)).toBe('silent');
  });
});
