// Which of the known answers an event makes old.

import { type Schema } from '../lib/api';

export type LiveEvent = Schema<'Event'>;

const kApi = '/api/v1/';

/** The first segments of the addresses that events of a type (its part before the dot) touch. */
const kTouched: Readonly<Record<string, readonly string[]>> = {
  scan: ['scans', 'vantages', 'sensors', 'candidates'],
  comparison: ['comparisons', 'scans', 'changes', 'zones'],
  track: ['tracks', 'alerts', 'calendar'],
  alert: ['alerts', 'tracks', 'calendar'],
  baseline: ['baselines', 'tracks', 'alerts'],
  zone: ['zones'],
  rule: ['rules'],
  silence: ['silences'],
  channel: ['channels'],
  delivery: ['deliveries'],
  survey: ['surveys', 'schedules', 'epochs'],
};

/** Whether what is found at `key` may have changed by `event`. Lists change as a whole; single things only by their own events. */
type Subjects = Pick<LiveEvent, 'type' | 'site' | 'scan' | 'comparison' | 'track' | 'alert' | 'sensor'>;

export function touches(event: Subjects, key: string): boolean {
  const subject = event.type.split('.')[0] ?? '';
  if (key === '/metrics') return subject === 'scan' || subject === 'comparison';
  if (!key.startsWith(kApi)) return false;
  const [resource = '', id] = key.slice(kApi.length).split(/[/?]/);
  if (!(kTouched[subject] ?? []).includes(resource)) return false;
  if (isOfAnother(event, key)) return false;
  const own = { scans: event.scan, comparisons: event.comparison, tracks: event.track, alerts: event.alert }[resource];
  const isOneThing = /^\d+$/.test(id ?? '') && !key.includes('?');
  return !isOneThing || own === undefined || own === null || String(own) === id;
}

/** A list of one site or sensor, and an event of another. */
function isOfAnother(event: Subjects, key: string): boolean {
  const query = new URLSearchParams(key.split('?')[1] ?? '');
  return (['site', 'sensor'] as const).some(
    (name) => event[name] !== null && query.has(name) && query.get(name) !== event[name],
  );
}
