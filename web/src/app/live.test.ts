import { describe, expect, it } from 'vitest';
import { touches } from './live';

const event = (type: string, own: object = {}) => ({
  type,
  site: 'yard',
  sensor: 'mast',
  scan: null,
  comparison: null,
  track: null,
  alert: null,
  ...own,
});

describe('an event makes old', () => {
  it('the lists of its kind, and the one thing that it tells of', () => {
    const opened = event('alert.opened', { alert: 7, scan: 3 });
    expect(touches(opened, '/api/v1/alerts?state=open')).toBe(true);
    expect(touches(opened, '/api/v1/alerts/7')).toBe(true);
    expect(touches(opened, '/api/v1/alerts/8')).toBe(false);
    expect(touches(opened, '/api/v1/scans?limit=50')).toBe(false);
    expect(touches(event('scan.stored', { scan: 3 }), '/api/v1/scans?limit=50')).toBe(true);
    expect(touches(event('comparison.done', { scan: 3, comparison: 4 }), '/api/v1/scans/3')).toBe(true);
    expect(touches(event('comparison.done', { scan: 3, comparison: 4 }), '/api/v1/scans/2')).toBe(false);
    expect(touches(event('comparison.done', { scan: 3 }), '/metrics')).toBe(true);
  });

  it('no list of another site or sensor', () => {
    expect(touches(event('scan.stored'), '/api/v1/scans?limit=1&sensor=mast')).toBe(true);
    expect(touches(event('scan.stored'), '/api/v1/scans?limit=1&sensor=gate')).toBe(false);
    expect(touches(event('scan.stored'), '/api/v1/scans?site=quarry')).toBe(false);
    expect(touches({ ...event('scan.stored'), sensor: null }, '/api/v1/scans?sensor=gate')).toBe(true);
  });
});
