// Lines: boxes, rays, what was measured.

import { BufferAttribute, BufferGeometry, type Color, Group, LineBasicMaterial, LineSegments } from 'three';
import { type Vector3 } from '../../lib/points/quantised';
import { type Layer } from './layer';
import { type TurnedBox } from './points_layer';
import { add, minus, rotated, times } from './vectors';

export type Segment = readonly [Vector3, Vector3];

export interface LineStyle {
  readonly colour: Color;
  readonly opacity?: number;
  /** Seen through everything. */
  readonly above?: boolean;
}

export class LinesLayer implements Layer {
  readonly object = new Group();
  private readonly geometry = new BufferGeometry();
  private readonly material: LineBasicMaterial;

  constructor(anchor_m: Vector3, segments: readonly Segment[], { colour, opacity = 1, above = false }: LineStyle) {
    const ends = new Float32Array(segments.flat().flatMap((end) => minus(end, anchor_m)));
    this.geometry.setAttribute('position', new BufferAttribute(ends, 3));
    this.material = new LineBasicMaterial({ color: colour, opacity, transparent: opacity < 1, depthTest: !above });
    this.material.toneMapped = false;
    const lines = new LineSegments(this.geometry, this.material);
    lines.frustumCulled = false;
    this.object.add(lines);
    if (above) lines.renderOrder = 1;
  }

  dispose(): void {
    this.geometry.dispose();
    this.material.dispose();
  }
}

const kPieces = 24;

/** A long line in pieces: software renderers drop lines of which one end is behind the camera. */
export function pieces(from: Vector3, to: Vector3): Segment[] {
  const at = (piece: number): Vector3 => add(from, times(minus(to, from), piece / kPieces));
  return Array.from({ length: kPieces }, (_, piece) => [at(piece), at(piece + 1)]);
}

/** The twelve edges of a box. */
export function edgesOf({ position_m, orientation_xyzw, size_m }: TurnedBox): Segment[] {
  const corner = (signs: readonly number[]): Vector3 =>
    add(
      position_m,
      rotated(orientation_xyzw, size_m.map((side, axis) => (side / 2) * (signs[axis] ?? 1)) as unknown as Vector3),
    );
  const pairs = [
    [-1, -1],
    [-1, 1],
    [1, 1],
    [1, -1],
  ] as const;
  return [0, 1, 2].flatMap((axis) =>
    pairs.map(([a, b]): Segment => {
      const ends = [-1, 1].map((end) => {
        const signs: number[] = [a, b];
        signs.splice(axis, 0, end);
        return corner(signs);
      });
      return [ends[0] as Vector3, ends[1] as Vector3];
    }),
  );
}
