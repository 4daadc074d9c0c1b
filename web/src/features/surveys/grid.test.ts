import { describe, expect, it } from 'vitest';
import { boundsOfGrid, cellAt, type Grid, isChanged, parseGrid, sightOf } from './grid';
import { cellColours, kSteps, paintCells, shadeAt, stepOf } from './map_paint';

/** Two columns, one row, cells of 2 m: the first fell by 3 m, the second was seen before only. */
function bytesOfGrid(): ArrayBuffer {
  const bytes = new ArrayBuffer(48 + 4 * 4 * 2);
  const view = new DataView(bytes);
  view.setUint32(0, 0x52574447);
  [1, 2, 1].forEach((value, index) => view.setUint32(4 + 4 * index, value, true));
  [10, 20, 500, 2].forEach((value, index) => view.setFloat64(16 + 8 * index, value, true));
  [-3, NaN, 0.1, NaN, 5, 6, 2, NaN].forEach((value, index) => view.setFloat32(48 + 4 * index, value, true));
  return bytes;
}

describe('the grid of a survey', () => {
  const grid = parseGrid(bytesOfGrid());

  it('is read from its bytes, and nothing else is taken for one', () => {
    expect(boundsOfGrid(grid)).toEqual({ min: [10, 20], max: [14, 22] });
    expect(grid.zero_m).toBe(500);
    expect([...grid.after_m]).toEqual([2, NaN]);
    expect(() => parseGrid(new ArrayBuffer(80))).toThrow(RangeError);
  });

  it('knows the cell of a place, and what was seen of it', () => {
    expect(cellAt(grid, [11, 21])).toBe(0);
    expect(cellAt(grid, [13.9, 20])).toBe(1);
    expect(cellAt(grid, [14, 21])).toBeUndefined();
    expect([0, 1].map((cell) => sightOf(grid, cell))).toEqual(['both', 'before']);
    expect([0, 1].map((cell) => isChanged(grid, cell))).toEqual([true, false]);
  });
});

describe('the map', () => {
  it('has a colour for every rise, reds for falls and blues for rises', () => {
    expect(stepOf(-3).words).toBe('2 to 5 m');
    expect(stepOf(99)).toBe(kSteps.at(-1));
    for (const { to_m, colour } of kSteps) {
      const isFall = to_m <= 0;
      expect(colour[0] > colour[2]).toBe(isFall);
    }
  });

  it('is brighter where the ground looks to the north-west', () => {
    const slope = (east: number): Grid => ({
      ...parseGrid(bytesOfGrid()),
      columns: 3,
      rows: 1,
      after_m: Float32Array.from([0, 2 * east, 4 * east]),
    });
    const level = slope(0);
    expect(shadeAt(level.after_m, level, 1)).toBeCloseTo(1);
    const [rising, falling] = [slope(0.5), slope(-0.5)];
    expect(shadeAt(rising.after_m, rising, 1)).toBeGreaterThan(shadeAt(falling.after_m, falling, 1));
  });

  it('paints the cells where they lie, and hatches what was not seen', () => {
    const grid = parseGrid(bytesOfGrid());
    const colours = cellColours(grid, 'difference');
    expect(colours[1]).toBe(0);
    const frame = { centre_m: [12, 21] as const, metres_per_pixel: 0.1, width_px: 60, height_px: 20 };
    const pixels = new Uint32Array(60 * 20);
    paintCells(pixels, frame, 1, grid, colours);
    const row = [...pixels.subarray(10 * 60, 11 * 60)];
    expect(row.slice(0, 10).every((pixel) => pixel === 0)).toBe(true);
    expect(row.slice(10, 30).every((pixel) => pixel === colours[0])).toBe(true);
    expect(new Set(row.slice(30, 50)).size).toBe(2);
    expect(row.slice(50).every((pixel) => pixel === 0)).toBe(true);
  });
});
