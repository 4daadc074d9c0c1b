// How points come from the daemon. The one place to change when there is a better form for them.

import { address, fetchBytes } from '../../lib/api';
import { type Cloud } from './clouds';

/** Clouds are kept as long as they are among the latest that were asked for. */
const kMostKept = 12;
const kept = new Map<string, Promise<Cloud>>();

/** The points of a scan in the site's frame, at least `spacing_m` apart; asked for once. @throws Problem */
export function loadCloud(scan: number, spacing_m: number): Promise<Cloud> {
  const key = `${scan}:${spacing_m}`;
  const known = kept.get(key);
  kept.delete(key);
  const cloud = known ?? fetchCloud(scan, spacing_m);
  kept.set(key, cloud);
  cloud.catch(() => kept.delete(key));
  for (const old of [...kept.keys()].slice(0, Math.max(0, kept.size - kMostKept))) kept.delete(old);
  return cloud;
}

async function fetchCloud(scan: number, spacing_m: number): Promise<Cloud> {
  const query = { frame: 'world', format: 'bin', voxel_m: spacing_m } as const;
  const bytes = await fetchBytes(address('/api/v1/scans/{id}/points', { path: { id: scan }, query }));
  return decodePoints(bytes, scan, spacing_m);
}

/** Reads `format=bin`: "RWPB", u32 version, u64 points, 3 f64 origin, u32 columns and their names, then planes of f32. */
export function decodePoints(bytes: ArrayBuffer, scan: number, spacing_m: number): Cloud {
  const view = new DataView(bytes);
  const points = Number(view.getBigUint64(8, true));
  const origin_m = [16, 24, 32].map((at) => view.getFloat64(at, true)) as [number, number, number];
  let at = 44;
  for (let column = view.getUint32(40, true); column > 0; --column) at += 2 + view.getUint8(at + 1);
  const xyz_m = new Float32Array(3 * points);
  for (let axis = 0; axis < 3; ++axis) {
    for (let point = 0; point < points; ++point) {
      xyz_m[3 * point + axis] = view.getFloat32(at + 4 * (axis * points + point), true);
    }
  }
  return { scan, origin_m, xyz_m, spacing_m };
}
