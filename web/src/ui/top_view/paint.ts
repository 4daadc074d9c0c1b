// Points into pixels: the highest in front, brighter the higher it is, and what is marked in a colour of its own.

import { type Cloud } from './clouds';
import { type Frame } from './frame';

export interface PointLook {
  /** Between these heights the colours run. */
  readonly heights_m: readonly [number, number];
  /** What lies higher is left out, such as a ceiling. */
  readonly cut_m: number;
  /** For each cloud which of its points are marked (not 0). */
  readonly marks?: readonly Uint8Array[] | undefined;
}

/** From low to high: darker to brighter, so that it reads without colours, too. */
const kRamp: readonly (readonly [number, number, number])[] = [
  [58, 84, 112],
  [84, 118, 148],
  [124, 153, 174],
  [178, 192, 197],
  [242, 236, 216],
];
/** Points are so many device pixels wide, with the gaps between them filled in between. */
const kSmallest_px = 2;
const kLargest_px = 5;
const kMarked: readonly [number, number, number] = [255, 200, 87];

/** 256 colours as an image's memory holds them (little endian: alpha, blue, green, red). */
const kShades = Uint32Array.from({ length: 256 }, (_, index) => {
  const place = (index / 255) * (kRamp.length - 1);
  const below = Math.min(kRamp.length - 2, Math.floor(place));
  const mixed = [0, 1, 2].map((part) => {
    const [low, high] = [kRamp[below]?.[part] ?? 0, kRamp[below + 1]?.[part] ?? 0];
    return Math.round(low + (high - low) * (place - below));
  });
  return packed(mixed as [number, number, number]);
});

function packed([red, green, blue]: readonly [number, number, number]): number {
  return ((255 << 24) | (blue << 16) | (green << 8) | red) >>> 0;
}

/** The colours of heights as CSS takes them, for a legend. */
export const rampAsCss = (): string =>
  `linear-gradient(to right, ${kRamp.map((rgb) => `rgb(${rgb.join(' ')})`).join(', ')})`;

/** Paints the clouds into `pixels` (one u32 a pixel, `scale` device pixels per CSS pixel), over what is there. */
export function paintPoints(
  pixels: Uint32Array,
  frame: Frame,
  scale: number,
  clouds: readonly Cloud[],
  look: PointLook,
): void {
  const columns = Math.round(frame.width_px * scale);
  const rows = Math.round(frame.height_px * scale);
  const heights = new Float32Array(columns * rows).fill(-Infinity);
  const [low, high] = look.heights_m;
  const perMetre = 255 / Math.max(0.01, high - low);
  const pixelsPerMetre = scale / frame.metres_per_pixel;
  const marked = packed(kMarked);
  for (const [index, { origin_m, xyz_m, spacing_m }] of clouds.entries()) {
    const marks = look.marks?.[index];
    // Relative to the picture's centre in double precision first.
    const [east, north] = [origin_m[0] - frame.centre_m[0], origin_m[1] - frame.centre_m[1]];
    const size = Math.min(kLargest_px, Math.max(kSmallest_px, Math.round(spacing_m * pixelsPerMetre * 0.8)));
    const half = size >> 1;
    for (let at = 0, point = 0; at < xyz_m.length; at += 3, ++point) {
      const z = xyz_m[at + 2]! + origin_m[2];
      if (z > look.cut_m) continue;
      const left = Math.round(columns / 2 + (xyz_m[at]! + east) * pixelsPerMetre) - half;
      const top = Math.round(rows / 2 - (xyz_m[at + 1]! + north) * pixelsPerMetre) - half;
      if (left < 0 || top < 0 || left + size > columns || top + size > rows) continue;
      const shade = Math.min(255, Math.max(0, ((z - low) * perMetre) | 0));
      const colour = marks?.[point] ? marked : kShades[shade]!;
      for (let row = top; row < top + size; ++row) {
        for (let cell = row * columns + left, end = cell + size; cell < end; ++cell) {
          if (z <= heights[cell]!) continue;
          heights[cell] = z;
          pixels[cell] = colour;
        }
      }
    }
  }
}
