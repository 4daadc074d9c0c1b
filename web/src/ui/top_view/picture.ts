// The canvas of a picture from above. It is drawn when something changed, once a frame at most, and otherwise not at all.

import { type Bounds, fitted, type Frame } from './frame';
import { drawCrosshair, drawOverlays, drawScale, drawSensors, type Overlay } from './overlays';
import { paintPoints } from './paint';
import { type Scene } from './scene';

export interface Shown {
  readonly scene: Scene;
  readonly overlays: readonly Overlay[];
  /** Shown first, and again on request; all of the scene when it is not given. */
  readonly focus_m: Bounds | undefined;
  readonly cut_m: number;
  readonly marks: readonly Uint8Array[] | undefined;
  /** Whether the middle is marked, for the keyboard. */
  readonly crosshair: boolean;
}

const kAnywhere: Bounds = { min: [-10, -10], max: [10, 10] };
const kGround = 0xff17110c; // --scene-ground, #0c1117

export class Picture {
  private current: Frame | undefined;
  private shown: Shown | undefined;
  private image: ImageData | undefined;
  private request = 0;
  /** Whoever looks has moved: what is shown stays where it is when more arrives. */
  private moved = false;

  constructor(private readonly canvas: HTMLCanvasElement) {}

  frame(): Frame {
    return (this.current ??= this.whole());
  }

  setFrame(frame: Frame): void {
    this.moved = true;
    this.current = frame;
    this.draw();
  }

  show(shown: Shown): void {
    this.shown = shown;
    if (!this.moved) this.current = undefined;
    this.draw();
  }

  showAll(): void {
    this.moved = false;
    this.current = undefined;
    this.draw();
  }

  /** The canvas has another size on the page. */
  resized(): void {
    const { clientWidth: width_px, clientHeight: height_px } = this.canvas;
    if (this.current && this.moved) this.current = { ...this.current, width_px, height_px };
    else this.current = undefined;
    this.draw();
  }

  end(): void {
    cancelAnimationFrame(this.request);
  }

  private whole(): Frame {
    const bounds = this.shown?.focus_m ?? this.shown?.scene.extent_m ?? kAnywhere;
    return fitted(bounds, this.canvas.clientWidth, this.canvas.clientHeight);
  }

  private draw(): void {
    this.request ||= requestAnimationFrame(() => {
      this.request = 0;
      this.drawNow();
    });
  }

  private drawNow(): void {
    const context = this.canvas.getContext('2d');
    const frame = this.frame();
    if (!context || !this.shown || frame.width_px === 0) return;
    const scale = Math.min(2, window.devicePixelRatio || 1);
    const [columns, rows] = [Math.round(frame.width_px * scale), Math.round(frame.height_px * scale)];
    if (this.canvas.width !== columns || this.canvas.height !== rows) {
      this.canvas.width = columns;
      this.canvas.height = rows;
    }
    if (this.image?.width !== columns || this.image.height !== rows)
      this.image = context.createImageData(columns, rows);
    const pixels = new Uint32Array(this.image.data.buffer);
    pixels.fill(kGround);
    const { scene, overlays, cut_m, marks, crosshair } = this.shown;
    paintPoints(pixels, frame, scale, scene.clouds, { heights_m: scene.heights_m, cut_m, marks });
    context.putImageData(this.image, 0, 0);
    context.setTransform(scale, 0, 0, scale, 0, 0);
    drawSensors(context, frame, scene.sensors);
    drawOverlays(context, frame, overlays);
    drawScale(context, frame);
    if (crosshair) drawCrosshair(context, frame);
    context.setTransform(1, 0, 0, 1, 0, 0);
  }
}
