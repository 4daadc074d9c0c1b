// What a 3D view is made of: small layers that come, change and go by themselves.

import { type Object3D, type Vector2 } from 'three';
import { type Vector3 } from '../../lib/points/quantised';
import { type Camera, type Viewport } from './camera';
import { type Pickable } from './picking';

/** What a layer is told before each frame. */
export interface Frame {
  readonly camera: Camera;
  readonly viewport: Viewport;
  /** Of the screen's own pixels, how many make one of the page's. */
  readonly pixelRatio: number;
}

export interface Layer {
  readonly object: Object3D;
  /** The points that can be picked, if it has any. */
  pickable?(): readonly Pickable[];
  /** How many points it has, and how many of them to draw. */
  readonly points?: { loaded: number; important: boolean; draw(count: number): void };
  beforeFrame?(frame: Frame): void;
  dispose(): void;
}

/** Which of two pictures a layer belongs to when they are swiped: 'both' is in the one and the other. */
export type Side = 'before' | 'after' | 'both';
export const kSides: Readonly<Record<Side, number>> = { before: -1, both: 0, after: 1 };

/** Numbers that all layers of a view share. */
export interface Shared {
  /** Where the picture before ends and that after begins, in normalised device coordinates; off: `swiping` is 0. */
  readonly swipe: { value: Vector2 };
  /** What coordinates on the graphics card are relative to: near the view, so that float32 is exact enough. */
  readonly anchor_m: Vector3;
}
