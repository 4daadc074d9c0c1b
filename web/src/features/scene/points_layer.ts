// The points of one address: each part that is loaded is one buffer on the graphics card, as it came.

import {
  BufferAttribute,
  BufferGeometry,
  Group,
  Matrix4,
  Points,
  Quaternion,
  type RawShaderMaterial,
  Vector3 as ThreeVector,
} from 'three';
import { type LoadedPoints } from '../../lib/points/point_store';
import { kNumbersPerPoint, placeOf, type QuantisedPoints, type Vector3 } from '../../lib/points/quantised';
import { kFieldOfView_rad } from './camera';
import { partOf } from './detail';
import { type Frame, kSides, type Layer, type Shared, type Side } from './layer';
import { type Palette } from './palette';
import { type Pickable } from './picking';
import { pointsMaterial, type PointUniforms } from './points_material';
import { minus } from './vectors';

/** A box with its own axes, as the daemon tells it. */
export interface TurnedBox {
  readonly position_m: Vector3;
  readonly orientation_xyzw: readonly [number, number, number, number];
  readonly size_m: Vector3;
}

export interface PointsStyle {
  readonly side: Side;
  /** What the view is about: drawn in full also while it moves. */
  readonly important: boolean;
  /** What changed outside of this box is dimmed. */
  readonly focus?: TurnedBox | undefined;
}

export class PointsLayer implements Layer {
  readonly object = new Group();
  readonly points;
  private readonly material: RawShaderMaterial;
  private readonly uniforms: PointUniforms;
  private readonly parts: { part: QuantisedPoints; object: Points }[] = [];
  private drawn = 0;

  constructor(
    private readonly shared: Shared,
    palette: Palette,
    style: PointsStyle,
  ) {
    ({ material: this.material, uniforms: this.uniforms } = pointsMaterial(palette, shared.swipe));
    this.uniforms.side.value = kSides[style.side];
    if (style.focus) this.focusOn(style.focus);
    this.points = {
      loaded: 0,
      important: style.important,
      draw: (count: number): void => this.draw(count),
    };
  }

  /** Shows what is loaded now. */
  update(loaded: LoadedPoints): void {
    const begunAnew = this.parts.some(({ part }, index) => loaded.parts[index] !== part);
    if (begunAnew) this.clear();
    for (const part of loaded.parts.slice(this.parts.length)) this.append(part);
    this.points.loaded = loaded.loaded;
    this.draw(this.drawn);
  }

  pickable(): readonly Pickable[] {
    return this.parts.map(({ part }) => ({
      part,
      drawn: partOf(this.drawn, part.first, part.count),
      shows: () => true,
    }));
  }

  beforeFrame({ camera, viewport, pixelRatio }: Frame): void {
    this.uniforms.focal_px.value = viewport.height / 2 / Math.tan(kFieldOfView_rad / 2);
    this.uniforms.pixelRatio.value = pixelRatio;
    this.uniforms.farFade_m.value = camera.distance_m * 3;
  }

  dispose(): void {
    this.clear();
    this.material.dispose();
  }

  private append(part: QuantisedPoints): void {
    const geometry = new BufferGeometry();
    geometry.setAttribute('record', new BufferAttribute(part.records, kNumbersPerPoint));
    const object = new Points(geometry, this.material);
    object.frustumCulled = false;
    object.matrixAutoUpdate = false;
    const [x, y, z] = minus(part.origin_m, this.shared.anchor_m);
    const [sx, sy, sz] = part.step_m;
    object.matrix.set(sx, 0, 0, x, 0, sy, 0, y, 0, 0, sz, z, 0, 0, 0, 1);
    object.matrixWorldNeedsUpdate = true;
    if (this.parts.length === 0) this.shadeHeights(part);
    this.parts.push({ part, object });
    this.object.add(object);
  }

  /** Between the lowest and the highest places but a few, so that a bird does not darken the yard. */
  private shadeHeights(part: QuantisedPoints): void {
    const few = Math.min(part.count, 2000);
    const heights = Float64Array.from({ length: few }, (_, index) => placeOf(part, index)[2]).sort();
    const at = (share: number): number => (heights[Math.floor(share * (few - 1))] ?? 0) - this.shared.anchor_m[2];
    this.uniforms.heights_m.value.set(at(0.02), at(0.98));
  }

  private draw(count: number): void {
    this.drawn = count;
    for (const { part, object } of this.parts) {
      const own = partOf(count, part.first, part.count);
      object.visible = own > 0;
      object.geometry.setDrawRange(0, own);
    }
  }

  private focusOn(box: TurnedBox): void {
    this.uniforms.boxFromScene.value = boxFromScene(box, this.shared.anchor_m);
    this.uniforms.focused.value = 1;
  }

  private clear(): void {
    for (const { object } of this.parts) {
      object.geometry.dispose();
      this.object.remove(object);
    }
    this.parts.length = 0;
  }
}

/** What takes the box to the cube from -1 to 1. */
function boxFromScene({ position_m, orientation_xyzw, size_m }: TurnedBox, anchor_m: Vector3): Matrix4 {
  const beyond_m = 0.05; // points on the box's sides belong to it
  const sceneFromBox = new Matrix4().compose(
    new ThreeVector(...minus(position_m, anchor_m)),
    new Quaternion(...orientation_xyzw),
    new ThreeVector(...size_m.map((side) => side / 2 + beyond_m)),
  );
  return sceneFromBox.invert();
}
