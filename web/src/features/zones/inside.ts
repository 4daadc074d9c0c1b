// Which of the points that are shown lie in a zone, and how high those over its ground are.

import { type Cloud, sizeOf } from '../../ui/top_view/clouds';
import { type Bounds, boundsOf, type Place } from '../../ui/top_view/frame';
import { isInside } from './polygon';

export interface Inside {
  /** For each cloud which points lie over the outline, whatever their height. */
  readonly over: readonly Uint8Array[];
  /** The heights of those, and how far along the outline's longer side each lies. */
  readonly z_m: Float64Array;
  readonly along_m: Float64Array;
  readonly bounds: Bounds;
  /** Whether the longer side goes east. */
  readonly goesEast: boolean;
}

/** Undefined for what is no outline yet. */
export function pointsOver(clouds: readonly Cloud[], corners: readonly Place[]): Inside | undefined {
  const bounds = boundsOf(corners);
  if (!bounds || corners.length < 3) return undefined;
  const { min, max } = bounds;
  const goesEast = max[0] - min[0] >= max[1] - min[1];
  const z: number[] = [];
  const along: number[] = [];
  const over = clouds.map((cloud) => {
    const flags = new Uint8Array(sizeOf(cloud));
    const { xyz_m, origin_m } = cloud;
    for (let point = 0; point < flags.length; ++point) {
      const x = xyz_m[3 * point]! + origin_m[0];
      const y = xyz_m[3 * point + 1]! + origin_m[1];
      if (x < min[0] || x > max[0] || y < min[1] || y > max[1] || !isInside(corners, [x, y])) continue;
      flags[point] = 1;
      z.push(xyz_m[3 * point + 2]! + origin_m[2]);
      along.push(goesEast ? x : y);
    }
    return flags;
  });
  return { over, z_m: Float64Array.from(z), along_m: Float64Array.from(along), bounds, goesEast };
}

/** Of the points over the outline those between two heights: as marks for each cloud, and how many. */
export function pointsBetween(
  clouds: readonly Cloud[],
  inside: Inside,
  [low_m, high_m]: readonly [number, number],
): { marks: readonly Uint8Array[]; count: number } {
  let count = 0;
  const marks = inside.over.map((flags, index) => {
    const cloud = clouds[index];
    return flags.map((flag, point) => {
      if (!flag || !cloud) return 0;
      const z = cloud.xyz_m[3 * point + 2]! + cloud.origin_m[2];
      const isIn = z >= low_m && z <= high_m;
      if (isIn) ++count;
      return isIn ? 1 : 0;
    });
  });
  return { marks, count };
}
