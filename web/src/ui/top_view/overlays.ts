// What is drawn over the points: outlines, boxes of changes, and marks.

import type { Schema } from '../../lib/api';
import { type Frame, type Pixel, type Place, scaleBar, toPixel } from './frame';
import type { ShownSensor } from './scene';

export type Tone = 'accent' | 'added' | 'removed' | 'alert' | 'ignore' | 'control' | 'volume' | 'plain';

export type Overlay =
  | {
      readonly kind: 'outline';
      readonly corners_m: readonly Place[];
      readonly tone: Tone;
      readonly closed?: boolean;
      readonly label?: string;
      /** Drawn stronger than the others. */
      readonly chosen?: boolean;
      /** Corners that can be taken hold of, with places between them; the number of the one that is. */
      readonly handles?: { readonly held: number | undefined };
    }
  | { readonly kind: 'box'; readonly box: Schema<'Box'>; readonly tone: Tone; readonly label?: string }
  | { readonly kind: 'mark'; readonly at_m: Place; readonly tone: Tone; readonly label?: string };

/** On the dark ground of the points in both themes; told apart by dashes, too. */
const kLook: Readonly<Record<Tone, { colour: string; dash: readonly number[] }>> = {
  accent: { colour: '#ffc857', dash: [] },
  added: { colour: '#2bd3a0', dash: [] },
  removed: { colour: '#ff8b3d', dash: [] },
  alert: { colour: '#ff93ac', dash: [] },
  ignore: { colour: '#b9c4ce', dash: [2, 4] },
  control: { colour: '#8cc4f5', dash: [8, 4] },
  volume: { colour: '#e3c27a', dash: [10, 3, 2, 3] },
  plain: { colour: '#e8eef3', dash: [] },
};

const kFont = '12px system-ui, "DejaVu Sans", sans-serif';
const kGround = '#0c1117';

/** The four corners of a box from above. */
export function footprint({ position_m, orientation_xyzw, size_m }: Schema<'Box'>): Place[] {
  const [x = 0, y = 0, z = 0, w = 1] = orientation_xyzw;
  const yaw_rad = Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
  const [cos, sin] = [Math.cos(yaw_rad), Math.sin(yaw_rad)];
  const [centreX = 0, centreY = 0] = position_m;
  const [length = 0, width = 0] = size_m;
  return [
    [-1, -1],
    [1, -1],
    [1, 1],
    [-1, 1],
  ].map(([right = 0, up = 0]) => {
    const [a, b] = [(right * length) / 2, (up * width) / 2];
    return [centreX + cos * a - sin * b, centreY + sin * a + cos * b];
  });
}

/** @param overColours the picture's own colours mean something: nothing is filled, and lines stand out from light and dark */
export function drawOverlays(
  canvas: CanvasRenderingContext2D,
  frame: Frame,
  overlays: readonly Overlay[],
  overColours = false,
): void {
  for (const overlay of overlays) {
    const { colour, dash } = kLook[overlay.tone];
    canvas.strokeStyle = canvas.fillStyle = colour;
    if (overlay.kind === 'mark') {
      drawMark(canvas, toPixel(frame, overlay.at_m), overlay.label);
      continue;
    }
    const corners = (overlay.kind === 'box' ? footprint(overlay.box) : overlay.corners_m).map((corner) =>
      toPixel(frame, corner),
    );
    const isOutline = overlay.kind === 'outline';
    canvas.setLineDash([...dash]);
    canvas.lineWidth = isOutline && overlay.chosen ? 2.5 : 1.5;
    trace(canvas, corners, !isOutline || overlay.closed !== false);
    if (overColours) {
      canvas.setLineDash([]);
      canvas.strokeStyle = kGround;
      canvas.lineWidth += 2.5;
      canvas.stroke();
      canvas.setLineDash([...dash]);
      canvas.strokeStyle = colour;
      canvas.lineWidth -= 2.5;
    } else if (!isOutline || overlay.closed !== false) {
      canvas.globalAlpha = isOutline && overlay.chosen ? 0.2 : 0.12;
      canvas.fill();
      canvas.globalAlpha = 1;
    }
    canvas.stroke();
    canvas.setLineDash([]);
    if (overlay.label) drawLabel(canvas, middleOf(corners), overlay.label, colour);
    if (isOutline && overlay.handles) drawHandles(canvas, corners, overlay.closed !== false, overlay.handles.held);
  }
}

function trace(canvas: CanvasRenderingContext2D, corners: readonly Pixel[], closed: boolean): void {
  canvas.beginPath();
  for (const [index, [x, y]] of corners.entries()) {
    if (index === 0) canvas.moveTo(x, y);
    else canvas.lineTo(x, y);
  }
  if (closed) canvas.closePath();
}

const middleOf = (corners: readonly Pixel[]): Pixel => [
  corners.reduce((sum, [x]) => sum + x, 0) / Math.max(1, corners.length),
  corners.reduce((sum, [, y]) => sum + y, 0) / Math.max(1, corners.length),
];

function drawLabel(canvas: CanvasRenderingContext2D, [x, y]: Pixel, words: string, colour: string): void {
  canvas.font = kFont;
  canvas.textAlign = 'center';
  canvas.textBaseline = 'middle';
  canvas.lineJoin = 'round';
  canvas.lineWidth = 4;
  canvas.strokeStyle = kGround;
  canvas.strokeText(words, x, y);
  canvas.fillStyle = colour;
  canvas.fillText(words, x, y);
}

function drawMark(canvas: CanvasRenderingContext2D, [x, y]: Pixel, label: string | undefined): void {
  const colour = String(canvas.strokeStyle);
  for (const [style, width] of [
    [kGround, 5],
    [colour, 2],
  ] as const) {
    canvas.strokeStyle = style;
    canvas.lineWidth = width;
    canvas.beginPath();
    canvas.arc(x, y, 7, 0, 2 * Math.PI);
    for (const [dx, dy] of [
      [1, 0],
      [-1, 0],
      [0, 1],
      [0, -1],
    ] as const) {
      canvas.moveTo(x + 4 * dx, y + 4 * dy);
      canvas.lineTo(x + 12 * dx, y + 12 * dy);
    }
    canvas.stroke();
  }
  if (label) drawLabel(canvas, [x, y + 22], label, colour);
}

function drawHandles(
  canvas: CanvasRenderingContext2D,
  corners: readonly Pixel[],
  closed: boolean,
  held: number | undefined,
): void {
  const { colour } = kLook.accent;
  canvas.strokeStyle = kGround;
  canvas.lineWidth = 1.5;
  for (const [index, corner] of corners.entries()) {
    const next = corners[(index + 1) % corners.length];
    if (!next || (!closed && index === corners.length - 1)) continue;
    canvas.fillStyle = '#8797a5';
    drawDot(canvas, [(corner[0] + next[0]) / 2, (corner[1] + next[1]) / 2], 4);
  }
  for (const [index, corner] of corners.entries()) {
    canvas.fillStyle = index === held ? '#ffffff' : colour;
    drawDot(canvas, corner, index === held ? 8 : 6);
  }
}

function drawDot(canvas: CanvasRenderingContext2D, [x, y]: Pixel, radius_px: number): void {
  canvas.beginPath();
  canvas.arc(x, y, radius_px, 0, 2 * Math.PI);
  canvas.fill();
  canvas.stroke();
}

export function drawSensors(canvas: CanvasRenderingContext2D, frame: Frame, sensors: readonly ShownSensor[]): void {
  for (const { name, at_m } of sensors) {
    const [x, y] = toPixel(frame, [at_m[0], at_m[1]]);
    canvas.fillStyle = '#ffffff';
    canvas.strokeStyle = kGround;
    canvas.lineWidth = 2;
    trace(
      canvas,
      [
        [x, y - 8],
        [x + 7, y + 5],
        [x - 7, y + 5],
      ],
      true,
    );
    canvas.fill();
    canvas.stroke();
    drawLabel(canvas, [x, y + 16], name, '#ffffff');
  }
}

/** How long a metre is, and where north and east lie. */
export function drawScale(canvas: CanvasRenderingContext2D, frame: Frame): void {
  const { length_px, words } = scaleBar(frame);
  const [left, bottom] = [16, frame.height_px - 16];
  for (const [style, width] of [
    [kGround, 5],
    ['#ffffff', 2],
  ] as const) {
    canvas.strokeStyle = style;
    canvas.lineWidth = width;
    canvas.beginPath();
    canvas.moveTo(left, bottom - 6);
    canvas.lineTo(left, bottom);
    canvas.lineTo(left + length_px, bottom);
    canvas.lineTo(left + length_px, bottom - 6);
    canvas.stroke();
  }
  drawLabel(canvas, [left + length_px / 2, bottom - 12], words, '#ffffff');
  drawAxes(canvas, [24, 48]);
}

function drawAxes(canvas: CanvasRenderingContext2D, [x, y]: Pixel): void {
  for (const [style, width] of [
    [kGround, 5],
    ['#ffffff', 2],
  ] as const) {
    canvas.strokeStyle = style;
    canvas.lineWidth = width;
    canvas.beginPath();
    canvas.moveTo(x, y - 24);
    canvas.lineTo(x, y);
    canvas.lineTo(x + 24, y);
    canvas.stroke();
  }
  drawLabel(canvas, [x, y - 32], 'N\u2009(y)', '#ffffff');
  drawLabel(canvas, [x + 40, y], 'E\u2009(x)', '#ffffff');
}

/** Where the keyboard points: the middle of the picture. */
export function drawCrosshair(canvas: CanvasRenderingContext2D, frame: Frame): void {
  canvas.strokeStyle = '#ffffff';
  drawMark(canvas, [frame.width_px / 2, frame.height_px / 2], undefined);
}
