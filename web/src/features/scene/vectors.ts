// Arithmetic of vectors in three dimensions, in double precision.

import { type Vector3 } from '../../lib/points/quantised';

export const add = (a: Vector3, b: Vector3): Vector3 => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const minus = (a: Vector3, b: Vector3): Vector3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const times = (a: Vector3, factor: number): Vector3 => [a[0] * factor, a[1] * factor, a[2] * factor];
export const dot = (a: Vector3, b: Vector3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const length = (a: Vector3): number => Math.hypot(...a);
export const cross = (a: Vector3, b: Vector3): Vector3 => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

/** What a rotation (a unit quaternion x, y, z, w) makes of a vector. */
export function rotated([x, y, z, w]: readonly [number, number, number, number], v: Vector3): Vector3 {
  const axis: Vector3 = [x, y, z];
  const turned = times(cross(axis, v), 2);
  return add(v, add(times(turned, w), cross(axis, turned)));
}
