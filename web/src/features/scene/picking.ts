// Which point lies under the pointer.

import { type QuantisedPoints, kNumbersPerPoint, placeOf, type Vector3 } from '../../lib/points/quantised';
import { axesOf, type Camera, eyeOf, kFieldOfView_rad, type Viewport } from './camera';
import { dot, minus } from './vectors';

export interface Picked {
  readonly place_m: Vector3;
  readonly part: QuantisedPoints;
  readonly index: number;
}

export interface Pickable {
  readonly part: QuantisedPoints;
  /** How many of them are drawn. */
  readonly drawn: number;
  readonly shows: (pointClass: number) => boolean;
}

interface Best {
  cost: number;
  part: QuantisedPoints | undefined;
  index: number;
}

/**
 * The point nearest to a pixel, within `radius_px`; of those about as near the one in front.
 * @param at in pixels from the upper left corner
 */
export function pick(
  camera: Camera,
  viewport: Viewport,
  at: { x: number; y: number },
  among: readonly Pickable[],
  radius_px = 9,
): Picked | undefined {
  const best: Best = { cost: Infinity, part: undefined, index: 0 };
  for (const pickable of among) search(best, camera, viewport, at, pickable, radius_px);
  return best.part && { place_m: placeOf(best.part, best.index), part: best.part, index: best.index };
}

/** The linear function of a point's numbers that is its coordinate along an axis of the camera. */
function along(axis: Vector3, eye_m: Vector3, part: QuantisedPoints): readonly [number, number, number, number] {
  const { step_m, origin_m } = part;
  return [axis[0] * step_m[0], axis[1] * step_m[1], axis[2] * step_m[2], dot(axis, minus(origin_m, eye_m))];
}

function search(
  best: Best,
  camera: Camera,
  viewport: Viewport,
  at: { x: number; y: number },
  { part, drawn, shows }: Pickable,
  radius_px: number,
): void {
  const { right, up, back } = axesOf(camera);
  const eye_m = eyeOf(camera);
  const focal_px = viewport.height / 2 / Math.tan(kFieldOfView_rad / 2);
  const wanted = { x: (at.x - viewport.width / 2) / focal_px, y: (viewport.height / 2 - at.y) / focal_px };
  const radius = radius_px / focal_px;
  const [rx, ry, rz, r0] = along(right, eye_m, part);
  const [ux, uy, uz, u0] = along(up, eye_m, part);
  const [bx, by, bz, b0] = along(back, eye_m, part);
  const { records } = part;
  for (let i = 0; i < drawn; ++i) {
    const k = i * kNumbersPerPoint;
    const [x, y, z] = [records[k]!, records[k + 1]!, records[k + 2]!];
    const depth_m = -(bx * x + by * y + bz * z + b0);
    if (depth_m <= 0) continue;
    const dx = (rx * x + ry * y + rz * z + r0) / depth_m - wanted.x;
    const dy = (ux * x + uy * y + uz * z + u0) / depth_m - wanted.y;
    const off2 = (dx * dx + dy * dy) / (radius * radius);
    if (off2 > 1 || !shows(records[k + 3]! & 255)) continue;
    // A pixel aside costs as much as a twentieth of the way farther.
    const cost = depth_m * (1 + Math.sqrt(off2) * radius_px * 0.05);
    if (cost < best.cost) Object.assign(best, { cost, part, index: i });
  }
}
