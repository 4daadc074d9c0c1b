import { type Schema } from '../../lib/api';

/** What one scan found of a track. */
export interface Finding {
  readonly at_s: number;
  /** Of the boxes of all pieces. */
  readonly volume_m3: number;
  readonly points: number;
}

/** What each scan found, in the order of time; one scan may have found it in pieces. @param changes the latest first. */
export function findingsOf(
  changes: readonly Pick<Schema<'Change'>, 'scan' | 'captured_at' | 'volume_m3' | 'points'>[],
): Finding[] {
  const byScan = new Map<number, Finding>();
  for (const { scan, captured_at, volume_m3, points } of [...changes].reverse()) {
    const known = byScan.get(scan) ?? { at_s: Date.parse(captured_at) / 1000, volume_m3: 0, points: 0 };
    byScan.set(scan, { ...known, volume_m3: known.volume_m3 + volume_m3, points: known.points + points });
  }
  return [...byScan.values()];
}
