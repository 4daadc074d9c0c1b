import { describe, expect, it } from 'vitest';
import { type Cloud, extentOf, HeightMap, heightsOf } from './clouds';
import { cloudOf } from './load_cloud';
import { footprint } from './overlays';
import { paintPoints } from './paint';

/** A plain of 20 by 20 m at 100 m above the sea, with a block 2 m high in its middle, far from the origin of the country. */
function plain(): Cloud {
  const points: number[] = [];
  for (let x = 0; x < 20; x += 0.25) {
    for (let y = 0; y < 20; y += 0.25) {
      points.push(x, y, 0);
      if (Math.abs(x - 10) <= 1 && Math.abs(y - 10) <= 1) points.push(x, y, 2);
    }
  }
  return { scan: 1, origin_m: [500_000, 5_800_000, 100], xyz_m: Float32Array.from(points), spacing_m: 0.25 };
}

describe('the points of a site', () => {
  it('tell how high the ground and the top are, also beside a return', () => {
    const extent = extentOf([plain()])!;
    const ground = new HeightMap([plain()], extent);
    expect(ground.at([500_010, 5_800_010])).toEqual({ ground_m: 100, top_m: 102 });
    expect(ground.at([500_003.1, 5_800_003.1])).toEqual({ ground_m: 100, top_m: 100 });
    expect(ground.at([500_100, 5_800_010])).toBeUndefined();
  });

  it('lie in an extent that one far return does not widen', () => {
    const far = { ...plain(), xyz_m: Float32Array.of(9000, 9000, 50) };
    const { min, max } = extentOf([plain(), far])!;
    expect(min[0]).toBeGreaterThan(499_999);
    expect(max[0]).toBeLessThan(500_020);
    expect(heightsOf([plain(), far])).toEqual([100, 102]);
    expect(extentOf([])).toBeUndefined();
  });

  it('are made of the parts in which they come', () => {
    const part = (first: number, ...numbers: number[]) => ({
      count: numbers.length / 4,
      total: 2,
      first,
      origin_m: [1.5, -2, 3] as const,
      step_m: [0.5, 0.25, 2] as const,
      hasClasses: false,
      intensity: undefined,
      records: Uint16Array.from(numbers),
    });
    const cloud = cloudOf([part(0, 2, 4, 1, 0), part(1, 6, 8, 0, 0)], 7, 0.1);
    expect([...cloud.xyz_m]).toEqual([1, 1, 2, 3, 2, 0]);
    expect(cloud.origin_m).toEqual([1.5, -2, 3]);
  });
});

describe('painting', () => {
  const frame = { centre_m: [0, 0] as const, metres_per_pixel: 1, width_px: 12, height_px: 12 };
  const cloud = (...xyz: number[]): Cloud => ({
    scan: 1,
    origin_m: [0, 0, 0],
    xyz_m: Float32Array.from(xyz),
    spacing_m: 0.1,
  });
  /** Three points, two of them one above the other, each two pixels wide. */
  const paint = (cut_m: number, marks?: Uint8Array[]) => {
    const pixels = new Uint32Array(144);
    paintPoints(pixels, frame, 1, [cloud(0, 0, 1, 0, 0, 5, 4, 4, 1)], { heights_m: [0, 10], cut_m, marks });
    return {
      painted: pixels.filter((pixel) => pixel !== 0).length,
      both: pixels[6 * 12 + 6],
      other: pixels[2 * 12 + 10],
    };
  };

  it('puts the highest in front, and leaves out what is cut off', () => {
    const [all, low] = [paint(Infinity), paint(2)];
    expect(all.painted).toBe(8);
    expect(all.both).not.toBe(all.other);
    expect(low.both).toBe(low.other); // of the same height
    expect(paint(0).painted).toBe(0);
  });

  it('gives what is marked a colour of its own', () => {
    const marked = paint(2, [Uint8Array.of(1, 0, 0)]);
    expect(marked.both).not.toBe(marked.other);
  });

  it('knows the corners of a turned box', () => {
    const half = Math.SQRT1_2;
    const box = { position_m: [1, 2, 3], orientation_xyzw: [0, 0, half, half], size_m: [4, 2, 1] };
    const corners = footprint(box as never);
    expect(Math.max(...corners.map(([x]) => x))).toBeCloseTo(2);
    expect(Math.max(...corners.map(([, y]) => y))).toBeCloseTo(4);
  });
});
