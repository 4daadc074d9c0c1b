// The format "q16" of points: eight bytes each, ready for the graphics card as they arrive. The contract says how it is
// laid out; see `PointFormat` in openapi.json.

import { Problem } from '../problem';

export type Vector3 = readonly [number, number, number];

/** The classes by the numbers that stand for them. */
export const kPointClasses = ['unchanged', 'added', 'removed', 'discrepancy', 'occluded', 'unseen', 'invalid'] as const;
export type PointClass = (typeof kPointClasses)[number];

/** A part of a set of points. Coordinates are `origin_m + step_m * number`. */
export interface QuantisedPoints {
  readonly count: number;
  /** How many points the whole set has, and the place in it of the first one here. */
  readonly total: number;
  readonly first: number;
  readonly origin_m: Vector3;
  readonly step_m: Vector3;
  readonly hasClasses: boolean;
  /** The intensities that 0 and 255 stand for, where there are any. */
  readonly intensity: readonly [number, number] | undefined;
  /** Four numbers a point: x, y, z, and class + 256 × intensity. */
  readonly records: Uint16Array;
}

const kHeaderBytes = 96;
const kPointBytes = 8;
export const kNumbersPerPoint = 4;

function broken(detail: string): Problem {
  return new Problem({ kind: 'broken-points', status: 0, title: 'The points cannot be read', detail });
}

/** @throws Problem when these are no such points */
export function decodeQuantised(bytes: ArrayBuffer): QuantisedPoints {
  const view = new DataView(bytes);
  if (bytes.byteLength < kHeaderBytes || view.getUint32(0) !== 0x52575051) throw broken('They have another format.');
  const version = view.getUint32(4, true);
  if (version !== 1) throw broken(`They have version ${version} of the format; this page knows 1. Load it again.`);
  const count = Number(view.getBigUint64(8, true));
  if (bytes.byteLength !== kHeaderBytes + count * kPointBytes)
    throw broken('Some are missing: the answer was cut off.');
  const vector = (at: number): Vector3 => [
    view.getFloat64(at, true),
    view.getFloat64(at + 8, true),
    view.getFloat64(at + 16, true),
  ];
  const flags = view.getUint32(88, true);
  return {
    count,
    total: Number(view.getBigUint64(16, true)),
    first: Number(view.getBigUint64(24, true)),
    origin_m: vector(32),
    step_m: vector(56),
    hasClasses: (flags & 1) !== 0,
    intensity: (flags & 2) !== 0 ? [view.getFloat32(80, true), view.getFloat32(84, true)] : undefined,
    // As the graphics card, and every machine with a browser, has it: little endian.
    records: new Uint16Array(bytes, kHeaderBytes, count * kNumbersPerPoint),
  };
}

export function placeOf(points: QuantisedPoints, index: number): Vector3 {
  const at = index * kNumbersPerPoint;
  const along = (axis: 0 | 1 | 2): number =>
    points.origin_m[axis] + points.step_m[axis] * (points.records[at + axis] ?? 0);
  return [along(0), along(1), along(2)];
}

export const classOf = (points: QuantisedPoints, index: number): PointClass =>
  kPointClasses[(points.records[index * kNumbersPerPoint + 3] ?? 0) & 255] ?? 'invalid';

/** Whether two parts are of the same set: their numbers mean the same places. */
export function fitTogether(one: QuantisedPoints, other: QuantisedPoints): boolean {
  const same = (a: Vector3, b: Vector3): boolean => a.every((value, axis) => value === b[axis]);
  return one.total === other.total && same(one.origin_m, other.origin_m) && same(one.step_m, other.step_m);
}

export interface Box {
  readonly min: Vector3;
  readonly max: Vector3;
}

/** The box that the numbers span: it holds all points of the set, also those that are not loaded. */
export function boxOf({ origin_m, step_m }: Pick<QuantisedPoints, 'origin_m' | 'step_m'>): Box {
  const kMost = 65535;
  return {
    min: origin_m,
    max: [origin_m[0] + step_m[0] * kMost, origin_m[1] + step_m[1] * kMost, origin_m[2] + step_m[2] * kMost],
  };
}
