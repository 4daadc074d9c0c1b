// What a 3D view shows, told as values; scene_stage.tsx makes layers of it.

import { type Schema } from '../../lib/api';
import { type Box, type QuantisedPoints, placeOf, type Vector3 } from '../../lib/points/quantised';
import { type Camera, type Viewport } from './camera';
import { type Side } from './layer';
import { type TurnedBox } from './points_layer';

export interface Cloud {
  /** An address of points with `format=q16`. */
  readonly from: string;
  /** What it is, in words: "the scan". */
  readonly what: string;
  readonly side: Side;
  readonly important: boolean;
  /** Shown only while before and after are swiped. */
  readonly onlySwiped?: boolean;
}

export interface SceneBox {
  readonly key: string;
  readonly box: TurnedBox;
  readonly kind: Schema<'ChangeKind'>;
  readonly label?: string;
  readonly href?: string;
}

/** A place with a name: where a sensor stood. */
export interface Mark {
  readonly key: string;
  readonly place_m: Vector3;
  readonly text: string;
}

export interface RayBundle {
  readonly from_m: Vector3;
  readonly to_m: readonly Vector3[];
}

export interface SceneSpec {
  readonly site: string;
  readonly anchor_m: Vector3;
  readonly radius_m: number;
  readonly clouds: readonly Cloud[];
  readonly boxes: readonly SceneBox[];
  readonly marks: readonly Mark[];
  /** What changed outside of this box is dimmed. */
  readonly focus?: TurnedBox;
  /** What stands above the two pictures when they are swiped. */
  readonly before?: string;
  readonly after?: string;
}

export const kLooks = ['frame', 'top', 'sensor'] as const;
export type Look = (typeof kLooks)[number];

/** Where the camera stands for each look. @param around nearly all of what is seen, as soon as it is known */
export type Looks = (look: Look, viewport: Viewport, around: Box | undefined) => Camera;

/** The box around all points but a few at each end of each axis, so that a bird far away does not make the place small. */
export function usualBox(points: QuantisedPoints, beyond = 0.1): Box | undefined {
  const few = Math.min(points.count, 5000);
  if (few === 0) return undefined;
  const places = Array.from({ length: few }, (_, index) => placeOf(points, index));
  const ends = ([0, 1, 2] as const).map((axis) => {
    const sorted = places.map((place) => place[axis]).sort((one, other) => one - other);
    const at = (share: number): number => sorted[Math.round(share * (few - 1))] ?? 0;
    return [at(beyond), at(1 - beyond)] as const;
  });
  const side = (end: 0 | 1): Vector3 => ends.map((pair) => pair[end]) as unknown as Vector3;
  return { min: side(0), max: side(1) };
}
