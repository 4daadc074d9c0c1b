// The canvas of a picture from above. It is drawn when something changed, once a frame at most, and otherwise not at all.

import { type Bounds, fitted, type Frame } from './frame';
import { drawCrosshair, drawScale } from './overlays';

/** What a picture shows. Another one is another object. */
export interface Drawing {
  /** Shown first, and again on request; nothing while it is not known. */
  readonly bounds_m: Bounds | undefined;
  /** Fills the pixels, of which a CSS pixel has `scale` along a side. */
  paint(pixels: Uint32Array, frame: Frame, scale: number): void;
  /** Draws lines over them, in CSS pixels. */
  drawOver(context: CanvasRenderingContext2D, frame: Frame): void;
}

const kAnywhere: Bounds = { min: [-10, -10], max: [10, 10] };
const kGround = 0xff17110c; // --scene-ground, #0c1117

export class Picture {
  private current: Frame | undefined;
  private shown: Drawing | undefined;
  /** Whether the middle is marked, for the keyboard. */
  private crosshair = false;
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

  show(shown: Drawing, crosshair: boolean): void {
    this.shown = shown;
    this.crosshair = crosshair;
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
    return fitted(this.shown?.bounds_m ?? kAnywhere, this.canvas.clientWidth, this.canvas.clientHeight);
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
    this.shown.paint(pixels, frame, scale);
    context.putImageData(this.image, 0, 0);
    context.setTransform(scale, 0, 0, scale, 0, 0);
    this.shown.drawOver(context, frame);
    drawScale(context, frame);
    if (this.crosshair) drawCrosshair(context, frame);
    context.setTransform(1, 0, 0, 1, 0, 0);
  }
}
