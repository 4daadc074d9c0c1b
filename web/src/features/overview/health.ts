// How a sensor fares, from what the daemon says of it.

import { type Schema } from '../../lib/api';
import { duration } from '../../lib/format';

export interface Health {
  readonly tone: 'good' | 'bad' | 'busy' | 'plain';
  readonly word: string;
  /** Why, in a sentence; empty when all is well. */
  readonly why: string;
}

type SensorFacts = Pick<Schema<'Sensor'>, 'name' | 'interval_s'>;
type ScanFacts = Pick<Schema<'Scan'>, 'captured_at' | 'state' | 'failure' | 'registration'>;
type AlertFacts = Pick<Schema<'Alert'>, 'sensor' | 'cause' | 'state' | 'title'>;

const kOfTheSensor = ['sensor-silent', 'sensor-moved', 'registration', 'coverage-dropped'];
/** A sensor that promised a scan each interval and has let two go by is silent. */
const kSilentAfterIntervals = 2;

/** The first that holds: an alert of the system about it; silence; a scan that failed; all is well. */
export function healthOf(
  sensor: SensorFacts,
  latest: ScanFacts | undefined,
  alerts: readonly AlertFacts[],
  now_ms: number,
): Health {
  const alert = alerts.find(
    (candidate) =>
      candidate.sensor === sensor.name && candidate.state !== 'resolved' && kOfTheSensor.includes(candidate.cause),
  );
  if (alert) return { tone: 'bad', word: alert.cause.replace('sensor-', '').replace('-', ' '), why: alert.title };
  if (!latest) return { tone: 'plain', word: 'no scans yet', why: '' };
  const age_s = (now_ms - Date.parse(latest.captured_at)) / 1000;
  if (sensor.interval_s !== null && age_s > kSilentAfterIntervals * sensor.interval_s) {
    return { tone: 'bad', word: 'silent', why: `A scan was due every ${duration(sensor.interval_s)}.` };
  }
  if (latest.state === 'failed')
    return { tone: 'bad', word: 'failed', why: latest.failure ?? 'The latest scan could not be compared.' };
  if (latest.registration.state === 'bad')
    return { tone: 'bad', word: 'does not fit', why: 'The latest scan fits nowhere at the pose that it gives.' };
  if (latest.state !== 'compared') return { tone: 'busy', word: latest.state, why: '' };
  return { tone: 'good', word: 'good', why: '' };
}
