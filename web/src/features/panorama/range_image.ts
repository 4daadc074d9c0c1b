// A range image: how far a scan saw in each direction, as it looks from where the scanner stood. Azimuths grow to the left,
// as they do for somebody who stands there. Pure.

import { type Schema } from '../../lib/api';
import { type QuantisedPoints, placeOf, type Vector3 } from '../../lib/points/quantised';
import { length, minus, rotated } from '../scene/vectors';

export interface Direction {
  /** Counter-clockwise from the scanner's x axis, from -180 to 180. */
  readonly azimuth_deg: number;
  readonly elevation_deg: number;
}

export interface RangeImage {
  readonly width: number;
  readonly height: number;
  readonly cell_deg: number;
  /** The upper edge of the first row. */
  readonly top_deg: number;
  /** Row by row from above; NaN where nothing was seen. */
  readonly ranges_m: Float32Array;
}

type Panorama = Schema<'Panorama'>;

const kDegrees = 180 / Math.PI;

export function directionOf(offset_m: Vector3): Direction {
  return {
    azimuth_deg: Math.atan2(offset_m[1], offset_m[0]) * kDegrees,
    elevation_deg: Math.atan2(offset_m[2], Math.hypot(offset_m[0], offset_m[1])) * kDegrees,
  };
}

/** The direction of a place in the scanner's frame. */
export function directionFrom(pose: Schema<'Pose'>, place_m: Vector3): Direction {
  const [x = 0, y = 0, z = 0] = pose.position_m;
  const [qx = 0, qy = 0, qz = 0, qw = 1] = pose.orientation_xyzw;
  return directionOf(rotated([-qx, -qy, -qz, qw], minus(place_m, [x, y, z])));
}

/** Where a direction stands in the image, in cells from its upper left corner. */
export const cellOf = (image: Omit<RangeImage, 'ranges_m'>, { azimuth_deg, elevation_deg }: Direction) => ({
  x: (180 - azimuth_deg) / image.cell_deg,
  y: (image.top_deg - elevation_deg) / image.cell_deg,
});

export const directionAt = (image: Omit<RangeImage, 'ranges_m'>, x: number, y: number): Direction => ({
  azimuth_deg: 180 - x * image.cell_deg,
  elevation_deg: image.top_deg - y * image.cell_deg,
});

export function rangeAt(image: RangeImage, x: number, y: number): number | undefined {
  const [column, row] = [Math.floor(x), Math.floor(y)];
  if (column < 0 || row < 0 || column >= image.width || row >= image.height) return undefined;
  const range_m = image.ranges_m[row * image.width + column];
  return range_m === undefined || Number.isNaN(range_m) ? undefined : range_m;
}

/** The elevations in which anything was seen, with a cell to spare on both sides. */
function seenElevations({ rows, columns, first_elevation_deg, cell_deg, farthest_m }: Panorama) {
  const seen = Array.from({ length: rows }, (_, row) =>
    farthest_m.slice(row * columns, (row + 1) * columns).some((range_m) => range_m !== null),
  );
  const first = Math.max(0, seen.indexOf(true) - 1);
  const last = Math.min(rows, (seen.lastIndexOf(true) === -1 ? rows - 1 : seen.lastIndexOf(true)) + 2);
  return { low_deg: first_elevation_deg + first * cell_deg, high_deg: first_elevation_deg + last * cell_deg };
}

/** How fine the image may be so that its cells are hit a few times each. */
export function cellFor(points: number, elevations_deg: number): number {
  const hits = 3;
  return Math.min(3, Math.max(0.4, Math.sqrt((360 * elevations_deg * hits) / Math.max(1, points))));
}

/** The image as the daemon's coarse panorama tells it, made finer by the scan's points as far as they are there. */
export function rangeImage(panorama: Panorama, parts: readonly QuantisedPoints[]): RangeImage {
  const { low_deg, high_deg } = seenElevations(panorama);
  const count = parts.reduce((sum, part) => sum + part.count, 0);
  const wanted_deg = count === 0 ? panorama.cell_deg : cellFor(count, high_deg - low_deg);
  const width = Math.round(360 / wanted_deg);
  const cell_deg = 360 / width;
  const height = Math.ceil((high_deg - low_deg) / cell_deg);
  const image = { width, height, cell_deg, top_deg: high_deg, ranges_m: new Float32Array(width * height).fill(NaN) };
  for (const part of parts) addPoints(image, part);
  fillFrom(image, panorama);
  return image;
}

/** The nearest range of each cell that is hit. */
function addPoints(image: RangeImage, part: QuantisedPoints): void {
  for (let index = 0; index < part.count; ++index) {
    const place_m = placeOf(part, index);
    const range_m = length(place_m);
    if (!(range_m > 0)) continue;
    const { x, y } = cellOf(image, directionOf(place_m));
    const row = Math.floor(y);
    if (row < 0 || row >= image.height) continue;
    const at = row * image.width + Math.min(image.width - 1, Math.floor(x));
    const before_m = image.ranges_m[at] ?? NaN;
    if (!(before_m <= range_m)) image.ranges_m[at] = range_m;
  }
}

/** What no point hit is what the cell beside it, or else the coarse panorama, says. */
function fillFrom(image: RangeImage, panorama: Panorama): void {
  const hit = image.ranges_m.slice();
  for (let row = 0; row < image.height; ++row) {
    for (let column = 0; column < image.width; ++column) {
      const at = row * image.width + column;
      if (!Number.isNaN(hit[at])) continue;
      const near = [at - image.width, at + image.width, at - 1, at + 1]
        .map((other) => hit[other] ?? NaN)
        .filter((range_m) => !Number.isNaN(range_m));
      image.ranges_m[at] =
        near.length > 0 ? Math.min(...near) : coarse(panorama, directionAt(image, column + 0.5, row + 0.5));
    }
  }
}

function coarse(panorama: Panorama, { azimuth_deg, elevation_deg }: Direction): number {
  const row = Math.floor((elevation_deg - panorama.first_elevation_deg) / panorama.cell_deg);
  const column = Math.floor((azimuth_deg - panorama.first_azimuth_deg) / panorama.cell_deg) % panorama.columns;
  return panorama.farthest_m[row * panorama.columns + column] ?? NaN;
}

/** Cividis: even in brightness, and the same to those who do not see red or green. After Nuñez, Anderton, Renslow (2018). */
const kRamp = [
  [0, 34, 78],
  [35, 62, 108],
  [87, 93, 109],
  [124, 123, 120],
  [165, 156, 116],
  [210, 193, 95],
  [254, 232, 56],
] as const;

/** @param share from 0 (near) to 1 (far) */
export function rampColour(share: number): readonly [number, number, number] {
  const at = Math.min(1, Math.max(0, share)) * (kRamp.length - 1);
  const [low, high] = [kRamp[Math.floor(at)] ?? kRamp[0], kRamp[Math.ceil(at)] ?? kRamp[0]];
  const mix = (channel: 0 | 1 | 2): number => Math.round(low[channel] + (high[channel] - low[channel]) * (at % 1));
  return [mix(0), mix(1), mix(2)];
}

/** The ranges between which the ramp runs: nearly all that was seen. */
export function rangeSpan({ ranges_m }: RangeImage): readonly [number, number] {
  const sorted = ranges_m.filter((range_m) => !Number.isNaN(range_m)).sort();
  const at = (share: number): number => sorted[Math.floor(share * (sorted.length - 1))] ?? 1;
  return [at(0.02), Math.max(at(0.98), at(0.02) * 1.01)];
}

/** Four bytes a cell; near is bright, by the logarithm of the range. */
export function pixelsOf(
  image: RangeImage,
  [near_m, far_m]: readonly [number, number],
): Uint8ClampedArray<ArrayBuffer> {
  const pixels = new Uint8ClampedArray(image.ranges_m.length * 4);
  image.ranges_m.forEach((range_m, at) => {
    if (Number.isNaN(range_m)) return;
    const share = Math.log(range_m / near_m) / Math.log(far_m / near_m);
    pixels.set([...rampColour(1 - share), 255], at * 4);
  });
  return pixels;
}

/** The corner directions' rectangle in the image, in cells; over the seam it reaches beyond the left or right edge. */
export function outline(image: RangeImage, pose: Schema<'Pose'>, change: Pick<Schema<'Change'>, 'bounds_m'>) {
  const { min, max } = change.bounds_m;
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((corner): Vector3 => {
    const side = (axis: number): number => ((corner >> axis) & 1 ? (max[axis] ?? 0) : (min[axis] ?? 0));
    return [side(0), side(1), side(2)];
  });
  const cells = corners.map((corner) => cellOf(image, directionFrom(pose, corner)));
  const first = cells[0]?.x ?? 0;
  const unwrapped = cells.map(({ x }) => first + (((x - first + 1.5 * image.width) % image.width) - image.width / 2));
  const [left, right] = [Math.min(...unwrapped), Math.max(...unwrapped)];
  const [top, bottom] = [Math.min(...cells.map(({ y }) => y)), Math.max(...cells.map(({ y }) => y))];
  return { x: left, y: top, width: right - left, height: bottom - top };
}
