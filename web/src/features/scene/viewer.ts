// The 3D view: a canvas, a camera, and layers. It draws when something has changed, and only then: while nothing moves
// there is no frame. It knows nothing of the framework; scene_stage.tsx brings it to life.

import { ColorManagement, LinearSRGBColorSpace, PerspectiveCamera, Scene, Vector2, WebGLRenderer } from 'three';
import { type Vector3 } from '../../lib/points/quantised';
import { approach, axesOf, type Camera, depthRange, eyeOf, kFieldOfView_rad, type Viewport } from './camera';
import { type Detail, kFirstDetail, learn, share } from './detail';
import { type Frame, type Layer, type Shared } from './layer';
import { type Palette } from './palette';
import { pick, type Picked } from './picking';
import { length, minus } from './vectors';

export interface ViewerOptions {
  readonly canvas: HTMLCanvasElement;
  /** Made for the canvas by whoever could say so when there is none. */
  readonly context: WebGL2RenderingContext;
  readonly palette: Palette;
  readonly anchor_m: Vector3;
  readonly camera: Camera;
  /** How far from the anchor there is something to see. */
  readonly radius_m: number;
}

// The styles' colours go to the screen as they are.
ColorManagement.enabled = false;

const kMostPixelRatio = 2;
const kLongestStep_s = 0.05;

/** What stands over the picture follows it: called after each frame. */
export type Follower = (camera: Camera, viewport: Viewport, drawn: number) => void;

export class Viewer {
  readonly shared: Shared;
  readonly palette: Palette;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly eye = new PerspectiveCamera((kFieldOfView_rad * 180) / Math.PI);
  private readonly layers = new Set<Layer>();
  private readonly followers = new Set<Follower>();
  private shown: Camera;
  private goal: Camera;
  private viewport: Viewport = { width: 1, height: 1 };
  private detail: Detail = kFirstDetail;
  private frame: number | undefined;
  private before_ms: number | undefined;

  constructor(private readonly options: ViewerOptions) {
    const { canvas, context, palette, anchor_m, camera } = options;
    this.palette = palette;
    this.shared = { swipe: { value: new Vector2(0, 0) }, anchor_m };
    this.renderer = new WebGLRenderer({ canvas, context, antialias: false });
    this.renderer.outputColorSpace = LinearSRGBColorSpace;
    this.scene.background = palette.ground;
    this.eye.matrixAutoUpdate = false;
    this.shown = this.goal = camera;
  }

  add(layer: Layer): void {
    this.layers.add(layer);
    this.scene.add(layer.object);
    this.invalidate();
  }

  remove(layer: Layer): void {
    if (!this.layers.delete(layer)) return;
    this.scene.remove(layer.object);
    layer.dispose();
    this.invalidate();
  }

  /** @returns what ends it */
  follow(follower: Follower): () => void {
    this.followers.add(follower);
    this.invalidate();
    return () => this.followers.delete(follower);
  }

  /** Where the camera is going. */
  get camera(): Camera {
    return this.goal;
  }

  /** The camera moves there; at once when it jumps. */
  look(camera: Camera, jump = false): void {
    this.goal = camera;
    if (jump) this.shown = camera;
    this.invalidate();
  }

  /** @param at from -1 (left edge) to 1; nothing: both pictures are seen as one */
  swipe(at: number | undefined): void {
    this.shared.swipe.value.set(at ?? 0, at === undefined ? 0 : 1);
    this.invalidate();
  }

  resize(viewport: Viewport): void {
    if (viewport.width < 1 || viewport.height < 1) return;
    this.viewport = viewport;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, kMostPixelRatio));
    this.renderer.setSize(viewport.width, viewport.height, false);
    this.invalidate();
  }

  pick(at: { x: number; y: number }): Picked | undefined {
    const among = [...this.layers].filter(({ object }) => object.visible).flatMap((layer) => layer.pickable?.() ?? []);
    return pick(this.shown, this.viewport, at, among);
  }

  get size(): Viewport {
    return this.viewport;
  }

  /** One frame soon, however often it is asked for. */
  invalidate(): void {
    this.frame ??= requestAnimationFrame((now_ms) => this.draw(now_ms));
  }

  dispose(): void {
    if (this.frame !== undefined) cancelAnimationFrame(this.frame);
    for (const layer of this.layers) layer.dispose();
    this.layers.clear();
    this.renderer.dispose();
  }

  private draw(now_ms: number): void {
    this.frame = undefined;
    const wasMoving = this.before_ms !== undefined;
    const passed_ms = now_ms - (this.before_ms ?? now_ms - 16);
    if (this.shown !== this.goal)
      this.shown = approach(this.shown, this.goal, Math.min(passed_ms / 1000, kLongestStep_s));
    const moving = this.shown !== this.goal;
    if (moving && wasMoving) this.detail = learn(this.detail, passed_ms);
    this.before_ms = moving ? now_ms : undefined;
    const drawn = this.chooseDetail(moving || wasMoving ? this.detail.moving : Infinity);
    this.placeEye();
    const frame: Frame = {
      camera: this.shown,
      viewport: this.viewport,
      pixelRatio: this.renderer.getPixelRatio(),
    };
    for (const layer of this.layers) layer.beforeFrame?.(frame);
    this.renderer.render(this.scene, this.eye);
    for (const follow of this.followers) follow(this.shown, this.viewport, drawn);
    // While it moves there is a next frame; after it, one with everything.
    if (moving || wasMoving) this.invalidate();
  }

  /** @returns how many points are drawn */
  private chooseDetail(budget: number): number {
    const points = [...this.layers].flatMap((layer) => (layer.points && layer.object.visible ? [layer.points] : []));
    const counts = share(points, budget);
    points.forEach((layer, index) => layer.draw(counts[index] ?? 0));
    return counts.reduce((sum, count) => sum + count, 0);
  }

  private placeEye(): void {
    const { right, up, back } = axesOf(this.shown);
    const [x, y, z] = minus(eyeOf(this.shown), this.shared.anchor_m);
    this.eye.matrixWorld.set(
      ...([right[0], up[0], back[0], x] as const),
      ...([right[1], up[1], back[1], y] as const),
      ...([right[2], up[2], back[2], z] as const),
      ...([0, 0, 0, 1] as const),
    );
    this.eye.matrix.copy(this.eye.matrixWorld);
    const away_m = length(minus(this.shown.target_m, this.shared.anchor_m));
    Object.assign(this.eye, depthRange(this.shown, this.options.radius_m + away_m));
    this.eye.aspect = this.viewport.width / this.viewport.height;
    this.eye.updateProjectionMatrix();
  }
}
