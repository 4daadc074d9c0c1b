// The camera of a 3D view: it turns about a target. Pure: values in, values out; z is up.

import { type Box, type Vector3 } from '../../lib/points/quantised';
import { add, cross, dot, length, minus, times } from './vectors';

export interface Camera {
  readonly target_m: Vector3;
  readonly distance_m: number;
  /** The direction from the target to the camera, counter-clockwise from x. */
  readonly azimuth_rad: number;
  /** Above the horizon. */
  readonly elevation_rad: number;
}

export interface Viewport {
  readonly width: number;
  readonly height: number;
}

export const kFieldOfView_rad = (50 * Math.PI) / 180; // from the lower to the upper edge
const kLowest_rad = (-89 * Math.PI) / 180;
const kHighest_rad = Math.PI / 2;
const kNearest_m = 0.05;
const kFarthest_m = 20_000;

/** The camera's own axes in the world; `back` leads from the target to it. Defined straight above, too. */
export interface Axes {
  readonly right: Vector3;
  readonly up: Vector3;
  readonly back: Vector3;
}

export function axesOf({ azimuth_rad, elevation_rad }: Camera): Axes {
  const [ca, sa, ce, se] = [
    Math.cos(azimuth_rad),
    Math.sin(azimuth_rad),
    Math.cos(elevation_rad),
    Math.sin(elevation_rad),
  ];
  const back: Vector3 = [ce * ca, ce * sa, se];
  const right: Vector3 = [-sa, ca, 0];
  return { right, up: cross(back, right), back };
}

export const eyeOf = (camera: Camera): Vector3 => add(camera.target_m, times(axesOf(camera).back, camera.distance_m));

/** How long a pixel is at the target. */
export const metresPerPixel = (camera: Camera, { height }: Viewport): number =>
  (2 * camera.distance_m * Math.tan(kFieldOfView_rad / 2)) / Math.max(1, height);

const clamp = (value: number, low: number, high: number): number => Math.min(high, Math.max(low, value));

export const orbit = (camera: Camera, azimuth_rad: number, elevation_rad: number): Camera => ({
  ...camera,
  azimuth_rad: camera.azimuth_rad + azimuth_rad,
  elevation_rad: clamp(camera.elevation_rad + elevation_rad, kLowest_rad, kHighest_rad),
});

/** Moves what is seen by pixels to the right and down. */
export function pan(camera: Camera, viewport: Viewport, right_px: number, down_px: number): Camera {
  const { right, up } = axesOf(camera);
  const scale = metresPerPixel(camera, viewport);
  const target_m = add(camera.target_m, add(times(right, -right_px * scale), times(up, down_px * scale)));
  return { ...camera, target_m };
}

/** Changes the distance by a factor; what lies under a pixel at the target's distance stays there. */
export function zoom(camera: Camera, viewport: Viewport, factor: number, at?: { x: number; y: number }): Camera {
  const distance_m = clamp(camera.distance_m * factor, kNearest_m, kFarthest_m);
  const done = 1 - distance_m / camera.distance_m;
  const nearer = { ...camera, distance_m };
  if (!at) return nearer;
  const offset = { x: at.x - viewport.width / 2, y: at.y - viewport.height / 2 };
  const moved = pan(camera, viewport, -offset.x * done, -offset.y * done);
  return { ...nearer, target_m: moved.target_m };
}

/** Looks at a whole box, with room around it: a `room` of 1 just holds the ball around the box. */
export function frame(
  box: Box,
  from: Pick<Camera, 'azimuth_rad' | 'elevation_rad'>,
  viewport: Viewport,
  room = 1.1,
): Camera {
  const radius_m = Math.max(0.1, length(minus(box.max, box.min)) / 2);
  const aspect = viewport.width / Math.max(1, viewport.height);
  const half_rad = Math.min(kFieldOfView_rad / 2, Math.atan(Math.tan(kFieldOfView_rad / 2) * aspect));
  return {
    target_m: times(add(box.min, box.max), 0.5),
    distance_m: clamp((radius_m * room) / Math.sin(half_rad), kNearest_m, kFarthest_m),
    azimuth_rad: from.azimuth_rad,
    elevation_rad: clamp(from.elevation_rad, kLowest_rad, kHighest_rad),
  };
}

/** The camera stands at a place and looks at another. */
export function lookFrom(eye_m: Vector3, target_m: Vector3): Camera {
  const away = minus(eye_m, target_m);
  const distance_m = Math.max(kNearest_m, length(away));
  return {
    target_m,
    distance_m,
    azimuth_rad: Math.atan2(away[1], away[0]),
    elevation_rad: Math.asin(clamp(away[2] / distance_m, -1, 1)),
  };
}

/** From straight above, with y up. */
export const kFromAbove = { azimuth_rad: -Math.PI / 2, elevation_rad: Math.PI / 2 };

/** The way to a change: half turned from where it was seen, so that its seen sides and its depth show. */
export function besideSight(eye_m: Vector3, target_m: Vector3): Pick<Camera, 'azimuth_rad' | 'elevation_rad'> {
  const aside_rad = 0.45;
  const { azimuth_rad, elevation_rad } = lookFrom(eye_m, target_m);
  return { azimuth_rad: azimuth_rad + aside_rad, elevation_rad: clamp(elevation_rad + 0.1, 0.45, 1) };
}

const shortestTurn = (angle_rad: number): number => Math.atan2(Math.sin(angle_rad), Math.cos(angle_rad));

const kRate_per_s = 14;

/** The camera on its way to where it shall be. @returns `goal` itself when it is there. */
export function approach(shown: Camera, goal: Camera, seconds: number): Camera {
  const share = 1 - Math.exp(-kRate_per_s * seconds);
  const between = (from: number, to: number): number => from + (to - from) * share;
  const turn_rad = shortestTurn(goal.azimuth_rad - shown.azimuth_rad);
  const next: Camera = {
    target_m: shown.target_m.map((value, axis) => between(value, goal.target_m[axis] ?? 0)) as unknown as Vector3,
    distance_m: shown.distance_m * (goal.distance_m / shown.distance_m) ** share,
    azimuth_rad: shown.azimuth_rad + turn_rad * share,
    elevation_rad: between(shown.elevation_rad, goal.elevation_rad),
  };
  return isNear(next, goal) ? goal : next;
}

/** Nobody sees the difference: less than a part in a thousand of what is seen. */
function isNear(one: Camera, other: Camera): boolean {
  const least = 0.0005;
  return (
    length(minus(one.target_m, other.target_m)) < other.distance_m * least &&
    Math.abs(one.distance_m / other.distance_m - 1) < least &&
    Math.abs(Math.sin((one.azimuth_rad - other.azimuth_rad) / 2)) < least &&
    Math.abs(one.elevation_rad - other.elevation_rad) < least
  );
}

/** Where a place stands on the screen, in pixels; nothing when it is behind the camera. */
export function project(camera: Camera, viewport: Viewport, place_m: Vector3): { x: number; y: number } | undefined {
  const { right, up, back } = axesOf(camera);
  const offset = minus(place_m, eyeOf(camera));
  const depth_m = -dot(offset, back);
  if (depth_m <= 0) return undefined;
  const scale = viewport.height / 2 / Math.tan(kFieldOfView_rad / 2) / depth_m;
  return { x: viewport.width / 2 + dot(offset, right) * scale, y: viewport.height / 2 - dot(offset, up) * scale };
}

/** How far the camera must see: from a part of its distance to behind everything. */
export function depthRange(camera: Camera, radius_m: number): { near: number; far: number } {
  const far = camera.distance_m + 2 * radius_m;
  return { near: Math.max(0.02, Math.min(camera.distance_m * 0.02, far / 200)), far };
}
