// How points come from the daemon for a picture from above: an even thinning, kept with all others of this page.

import { address } from '../../lib/api';
import { type LoadedPoints, pointStore } from '../../lib/points/point_store';
import { kNumbersPerPoint } from '../../lib/points/quantised';
import { type Cloud } from './clouds';

/** Of each scan; four of them are painted in a few milliseconds. */
const kBudget = 150_000;

/** The points of a scan in the site's frame. @throws Problem */
export async function loadCloud(scan: number, spacing_m: number): Promise<Cloud> {
  const query = { frame: 'world', format: 'q16' } as const;
  let points: LoadedPoints | undefined;
  await pointStore.load(address('/api/v1/scans/{id}/points', { path: { id: scan }, query }), kBudget, (loaded) => {
    points = loaded;
  });
  return cloudOf(points?.parts ?? [], scan, spacing_m);
}

/** The parts as one cloud; they share their origin and steps. */
export function cloudOf(parts: LoadedPoints['parts'], scan: number, spacing_m: number): Cloud {
  const xyz_m = new Float32Array(3 * parts.reduce((sum, { count }) => sum + count, 0));
  let at = 0;
  for (const { count, step_m, records } of parts) {
    for (let point = 0; point < count; ++point) {
      for (let axis = 0; axis < 3; ++axis) xyz_m[at++] = records[kNumbersPerPoint * point + axis]! * step_m[axis]!;
    }
  }
  return { scan, origin_m: parts[0]?.origin_m ?? [0, 0, 0], xyz_m, spacing_m };
}
