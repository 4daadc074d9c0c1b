// Points of a scan as they are drawn, and what is read from them: how high the ground is at a place.

import { type Bounds, type Place } from './frame';

/** Points relative to an origin, three numbers each, so that single precision does for coordinates of a country. */
export interface Cloud {
  readonly scan: number;
  readonly origin_m: readonly [number, number, number];
  /** x, y, z of each point in metres, relative to the origin. */
  readonly xyz_m: Float32Array;
  /** How far points lie apart at least. */
  readonly spacing_m: number;
}

export const sizeOf = (cloud: Cloud): number => cloud.xyz_m.length / 3;

/** A number below which the given share of the values lies; of many values from a sample, evenly taken. */
function quantile(sorted: Float64Array, share: number): number {
  return sorted[Math.min(sorted.length - 1, Math.max(0, Math.round(share * (sorted.length - 1))))] ?? 0;
}

const kSample = 20_000;

function sampleOf(clouds: readonly Cloud[], axis: 0 | 1 | 2): Float64Array {
  const total = clouds.reduce((sum, cloud) => sum + sizeOf(cloud), 0);
  const step = Math.max(1, Math.floor(total / kSample));
  const values: number[] = [];
  for (const { xyz_m, origin_m } of clouds) {
    for (let at = axis; at < xyz_m.length; at += 3 * step) values.push((xyz_m[at] ?? 0) + origin_m[axis]);
  }
  return Float64Array.from(values).sort();
}

/** Where most points lie: few far ones do not make the rest small. Undefined without points. */
export function extentOf(clouds: readonly Cloud[]): Bounds | undefined {
  const [x, y] = [sampleOf(clouds, 0), sampleOf(clouds, 1)];
  if (x.length === 0) return undefined;
  return { min: [quantile(x, 0.04), quantile(y, 0.04)], max: [quantile(x, 0.96), quantile(y, 0.96)] };
}

/** The heights between which nearly all points lie. */
export function heightsOf(clouds: readonly Cloud[]): readonly [number, number] {
  const z = sampleOf(clouds, 2);
  return [quantile(z, 0.005), quantile(z, 0.995)];
}

const kCellsAcross = 384;
const kReach_cells = 3;

/** The lowest and the highest return in each cell of a grid over the site. */
export class HeightMap {
  private readonly across: number;
  private readonly along: number;
  private readonly cell_m: number;
  private readonly low: Float64Array;
  private readonly high: Float64Array;

  constructor(
    clouds: readonly Cloud[],
    private readonly bounds: Bounds,
  ) {
    const { min, max } = bounds;
    const widest_m = Math.max(max[0] - min[0], max[1] - min[1], 1);
    const spacing_m = Math.max(0, ...clouds.map((cloud) => cloud.spacing_m));
    this.cell_m = Math.max(widest_m / kCellsAcross, spacing_m * 1.5);
    this.across = Math.ceil((max[0] - min[0]) / this.cell_m) + 1;
    this.along = Math.ceil((max[1] - min[1]) / this.cell_m) + 1;
    this.low = new Float64Array(this.across * this.along).fill(Infinity);
    this.high = new Float64Array(this.across * this.along).fill(-Infinity);
    for (const cloud of clouds) this.add(cloud);
  }

  private add({ xyz_m, origin_m }: Cloud): void {
    for (let at = 0; at + 2 < xyz_m.length; at += 3) {
      const cell = this.cellAt([(xyz_m[at] ?? 0) + origin_m[0], (xyz_m[at + 1] ?? 0) + origin_m[1]]);
      if (cell === undefined) continue;
      const z = (xyz_m[at + 2] ?? 0) + origin_m[2];
      if (z < (this.low[cell] ?? 0)) this.low[cell] = z;
      if (z > (this.high[cell] ?? 0)) this.high[cell] = z;
    }
  }

  private cellAt([x, y]: Place): number | undefined {
    const column = Math.floor((x - this.bounds.min[0]) / this.cell_m);
    const row = Math.floor((y - this.bounds.min[1]) / this.cell_m);
    return this.cell(column, row);
  }

  private cell(column: number, row: number): number | undefined {
    if (column < 0 || row < 0 || column >= this.across || row >= this.along) return undefined;
    return row * this.across + column;
  }

  /** The lowest and highest return at a place or, where there is none, beside it; undefined where nothing was seen. */
  at([x, y]: Place): { ground_m: number; top_m: number } | undefined {
    const column = Math.floor((x - this.bounds.min[0]) / this.cell_m);
    const row = Math.floor((y - this.bounds.min[1]) / this.cell_m);
    for (let reach = 0; reach <= kReach_cells; ++reach) {
      let [ground_m, top_m] = [Infinity, -Infinity];
      for (let down = row - reach; down <= row + reach; ++down) {
        for (let right = column - reach; right <= column + reach; ++right) {
          const cell = this.cell(right, down);
          if (cell === undefined) continue;
          ground_m = Math.min(ground_m, this.low[cell] ?? Infinity);
          top_m = Math.max(top_m, this.high[cell] ?? -Infinity);
        }
      }
      if (ground_m !== Infinity) return { ground_m, top_m };
    }
    return undefined;
  }
}
