// The grids of a survey as GET /surveys/{id}/dod?format=bin sends them: row by row from the corner of least x and y.

import { type Bounds, type Place } from '../../ui/top_view/frame';

export interface Grid {
  readonly corner_m: Place;
  readonly cell_m: number;
  readonly columns: number;
  readonly rows: number;
  /** NaN in these four where nothing was seen. */
  readonly rise_m: Float32Array;
  /** A rise that is greater is surely one (95 %). */
  readonly lod95_m: Float32Array;
  /** Heights relative to `zero_m`. */
  readonly before_m: Float32Array;
  readonly after_m: Float32Array;
  readonly zero_m: number;
}

const kHeader_bytes = 48;

/** @throws RangeError when the bytes are no such grid. */
export function parseGrid(bytes: ArrayBuffer): Grid {
  const view = new DataView(bytes);
  if (view.getUint32(0) !== 0x52574447 || view.getUint32(4, true) !== 1) throw new RangeError('no grid of a survey');
  const [columns, rows] = [view.getUint32(8, true), view.getUint32(12, true)];
  const plane = (index: number): Float32Array =>
    new Float32Array(bytes, kHeader_bytes + index * 4 * columns * rows, columns * rows);
  return {
    corner_m: [view.getFloat64(16, true), view.getFloat64(24, true)],
    zero_m: view.getFloat64(32, true),
    cell_m: view.getFloat64(40, true),
    columns,
    rows,
    rise_m: plane(0),
    lod95_m: plane(1),
    before_m: plane(2),
    after_m: plane(3),
  };
}

/** The cell in which a place lies; nothing outside of the grid. */
export function cellAt({ corner_m, cell_m, columns, rows }: Grid, [x, y]: Place): number | undefined {
  const column = Math.floor((x - corner_m[0]) / cell_m);
  const row = Math.floor((y - corner_m[1]) / cell_m);
  return column >= 0 && row >= 0 && column < columns && row < rows ? row * columns + column : undefined;
}

export const boundsOfGrid = ({ corner_m: [x, y], cell_m, columns, rows }: Grid): Bounds => ({
  min: [x, y],
  max: [x + columns * cell_m, y + rows * cell_m],
});

/** What was seen of a cell. */
export function sightOf(grid: Grid, cell: number): 'both' | 'before' | 'after' | 'neither' {
  const [before, after] = [!Number.isNaN(grid.before_m[cell]), !Number.isNaN(grid.after_m[cell])];
  return before ? (after ? 'both' : 'before') : after ? 'after' : 'neither';
}

/** Whether a rise is greater than what noise, roughness and poses may feign. */
export const isChanged = (grid: Grid, cell: number): boolean =>
  Math.abs(grid.rise_m[cell] ?? NaN) > (grid.lod95_m[cell] ?? NaN);
