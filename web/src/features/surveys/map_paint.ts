// The colours of the maps of a survey: the difference in fixed steps over shaded ground, or the heights of an epoch.

import { type Frame } from '../../ui/top_view/frame';
import { type Grid, isChanged } from './grid';

export type Rgb = readonly [red: number, green: number, blue: number];

/** As in the report: reds fall, blues rise (ColorBrewer's RdBu, which colour-blind people can tell apart), in fixed steps,
    so that maps of different nights can be compared. `to_m` is the upper end of a step. */
export const kSteps: readonly { readonly to_m: number; readonly colour: Rgb; readonly words: string }[] = [
  { to_m: -5, colour: [103, 0, 31], words: 'falls by more than 5 m' },
  { to_m: -2, colour: [165, 15, 32], words: '2 to 5 m' },
  { to_m: -1, colour: [203, 73, 66], words: '1 to 2 m' },
  { to_m: -0.5, colour: [230, 134, 106], words: '0.5 to 1 m' },
  { to_m: -0.2, colour: [247, 182, 153], words: '0.2 to 0.5 m' },
  { to_m: 0, colour: [252, 219, 200], words: 'less than 0.2 m' },
  { to_m: 0.2, colour: [209, 229, 240], words: 'rises by less than 0.2 m' },
  { to_m: 0.5, colour: [157, 203, 225], words: '0.2 to 0.5 m' },
  { to_m: 1, colour: [103, 169, 207], words: '0.5 to 1 m' },
  { to_m: 2, colour: [58, 131, 187], words: '1 to 2 m' },
  { to_m: 5, colour: [33, 95, 157], words: '2 to 5 m' },
  { to_m: Infinity, colour: [5, 48, 97], words: 'more than 5 m' },
];
export const kUnchanged: Rgb = [222, 222, 218];
export const kUnseen: Rgb = [52, 61, 70];
const kHatch: Rgb = [78, 89, 100];
/** From lowlands to heights; brighter the higher it is, so that it reads without colours, too. */
const kHeights: readonly Rgb[] = [
  [70, 98, 108],
  [112, 140, 122],
  [186, 178, 134],
  [240, 232, 216],
];

export type MapKind = 'difference' | 'before' | 'after';

export const stepOf = (rise_m: number): (typeof kSteps)[number] => kSteps.find(({ to_m }) => rise_m <= to_m)!;

/** How bright a cell is in a light from the north-west, 45 degrees high: 1 on level ground. */
export function shadeAt(heights_m: Float32Array, { columns, rows, cell_m }: Grid, cell: number): number {
  const column = cell % columns;
  const slope = (step: number, hasLess: boolean, hasMore: boolean): number => {
    const here = heights_m[cell] ?? NaN;
    const less = hasLess ? (heights_m[cell - step] ?? NaN) : NaN;
    const more = hasMore ? (heights_m[cell + step] ?? NaN) : NaN;
    if (!Number.isNaN(less) && !Number.isNaN(more)) return (more - less) / (2 * cell_m);
    if (!Number.isNaN(less)) return (here - less) / cell_m;
    return Number.isNaN(more) ? 0 : (more - here) / cell_m;
  };
  const east = slope(1, column > 0, column < columns - 1);
  const north = slope(columns, cell >= columns, cell < (rows - 1) * columns);
  const up = Math.SQRT1_2;
  const lit = Math.max(0, (0.5 * east - 0.5 * north + up) / Math.hypot(east, north, 1));
  return 0.35 + (0.65 * lit) / up;
}

const packed = ([red, green, blue]: Rgb, light = 1): number => {
  const part = (value: number): number => Math.min(255, Math.max(0, Math.round(value * light)));
  return ((255 << 24) | (part(blue) << 16) | (part(green) << 8) | part(red)) >>> 0;
};

/** The least and the greatest height of both epochs, so that their maps can be compared. */
export function heightRange(grid: Grid): readonly [number, number] {
  let [low, high] = [Infinity, -Infinity];
  for (const plane of [grid.before_m, grid.after_m]) {
    for (const height of plane) {
      if (height < low) low = height;
      if (height > high) high = height;
    }
  }
  return [low, high];
}

function heightColour(share: number): Rgb {
  const place = Math.min(1, Math.max(0, share)) * (kHeights.length - 1);
  const below = Math.min(kHeights.length - 2, Math.floor(place));
  const [low, high] = [kHeights[below]!, kHeights[below + 1]!];
  return [0, 1, 2].map((part) => low[part]! + (high[part]! - low[part]!) * (place - below)) as unknown as Rgb;
}

export const heightsAsCss = (): string =>
  `linear-gradient(to right, ${kHeights.map((rgb) => `rgb(${rgb.join(' ')})`).join(', ')})`;

/** The colour of each cell as an image's memory holds it; 0 where the map has nothing to show. */
export function cellColours(grid: Grid, kind: MapKind): Uint32Array {
  const colours = new Uint32Array(grid.columns * grid.rows);
  const [low, high] = heightRange(grid);
  for (let cell = 0; cell < colours.length; ++cell) {
    if (kind === 'difference') {
      if (Number.isNaN(grid.rise_m[cell])) continue;
      // Half of the shade, so that the colour can still be found in the legend.
      const light = 0.5 + 0.5 * Math.min(1.2, shadeAt(grid.after_m, grid, cell));
      colours[cell] = packed(isChanged(grid, cell) ? stepOf(grid.rise_m[cell]!).colour : kUnchanged, light);
      continue;
    }
    const heights = kind === 'before' ? grid.before_m : grid.after_m;
    if (Number.isNaN(heights[cell])) continue;
    const share = high > low ? (heights[cell]! - low) / (high - low) : 0.5;
    colours[cell] = packed(heightColour(share), shadeAt(heights, grid, cell));
  }
  return colours;
}

/** Paints the cells into `pixels` (one u32 a pixel, `scale` device pixels per CSS pixel); what was not seen is hatched. */
export function paintCells(pixels: Uint32Array, frame: Frame, scale: number, grid: Grid, colours: Uint32Array): void {
  const width = Math.round(frame.width_px * scale);
  const height = Math.round(frame.height_px * scale);
  const [plain, hatch] = [packed(kUnseen), packed(kHatch)];
  const perPixel = frame.metres_per_pixel / scale / grid.cell_m; // cells
  const left = (frame.centre_m[0] - grid.corner_m[0]) / grid.cell_m - (width / 2) * perPixel;
  const top = (frame.centre_m[1] - grid.corner_m[1]) / grid.cell_m + (height / 2) * perPixel;
  const period = Math.round(8 * scale);
  for (let y = 0; y < height; ++y) {
    const row = Math.floor(top - (y + 0.5) * perPixel);
    if (row < 0 || row >= grid.rows) continue;
    for (let x = 0; x < width; ++x) {
      const column = Math.floor(left + (x + 0.5) * perPixel);
      if (column < 0 || column >= grid.columns) continue;
      const colour = colours[row * grid.columns + column]!;
      pixels[y * width + x] = colour !== 0 ? colour : (x + y) % period < scale * 1.5 ? hatch : plain;
    }
  }
}
