import { describe, expect, it } from 'vitest';
import { type QuantisedPoints } from '../../lib/points/quantised';
import {
  cellFor,
  cellOf,
  directionAt,
  directionFrom,
  outline,
  pixelsOf,
  rampColour,
  rangeAt,
  rangeImage,
  rangeSpan,
} from './range_image';

/** Sees 10 m in the band of elevations from -30 to 0 degrees. */
const panorama = {
  rows: 60,
  columns: 120,
  first_elevation_deg: -90,
  first_azimuth_deg: -180,
  cell_deg: 3,
  farthest_m: Array.from({ length: 60 * 120 }, (_, cell) => (cell >= 20 * 120 && cell < 30 * 120 ? 10 : null)),
};

const pose = { position_m: [100, 50, 3], orientation_xyzw: [0, 0, Math.SQRT1_2, Math.SQRT1_2] };

describe('a range image', () => {
  it('shows the elevations that were seen, azimuth growing to the left', () => {
    const image = rangeImage(panorama, []);
    expect([image.width, image.height, image.top_deg]).toEqual([120, 12, 3]);
    expect(cellOf(image, { azimuth_deg: 90, elevation_deg: 0 })).toEqual({ x: 30, y: 1 });
    expect(directionAt(image, 30, 1)).toEqual({ azimuth_deg: 90, elevation_deg: 0 });
    expect(rangeAt(image, 60.5, 5.5)).toBe(10);
    expect(rangeAt(image, 60.5, 0.5)).toBeUndefined();
    expect(rangeAt(image, -1, 5)).toBeUndefined();
  });

  it('becomes finer with points, of which the nearest counts', () => {
    const records = Uint16Array.from([4000, 0, 0, 0, 2000, 0, 0, 0]); // ahead, a little below
    const part: QuantisedPoints = {
      ...{ count: 2, total: 2, first: 0, hasClasses: false, intensity: undefined, records },
      origin_m: [0, 0, -0.1],
      step_m: [0.001, 0.001, 0.001],
    };
    const image = rangeImage(panorama, [part]);
    const { x, y } = cellOf(image, { azimuth_deg: 0, elevation_deg: -2 });
    expect(rangeAt(image, x, y)).toBeCloseTo(2, 2);
    expect(cellFor(1_000_000, 40)).toBe(0.4);
    expect(cellFor(20_000, 40)).toBeCloseTo(1.47, 2);
  });

  it('outlines a change where the scanner saw it, also across the seam', () => {
    const image = rangeImage(panorama, []);
    // The scanner is turned a quarter to the left: what lies along y is ahead of it.
    expect(directionFrom(pose, [100, 60, 3])).toEqual({ azimuth_deg: expect.closeTo(0), elevation_deg: 0 });
    const ahead = outline(image, pose, { bounds_m: { min: [99.5, 60, 2], max: [100.5, 60.5, 3] } });
    expect(ahead.x + ahead.width / 2).toBeCloseTo(60, 0);
    expect(ahead.width).toBeLessThan(3);
    const behind = outline(image, pose, { bounds_m: { min: [99.5, 40, 2], max: [100.5, 40.5, 3] } });
    expect(behind.width).toBeLessThan(3);
  });

  it('is coloured from near to far, evenly brighter', () => {
    const brightness = (share: number): number => rampColour(share).reduce((sum, part) => sum + part, 0);
    const shares = [0, 0.25, 0.5, 0.75, 1].map(brightness);
    expect([...shares].sort((one, other) => one - other)).toEqual(shares);
    const image = rangeImage(panorama, []);
    expect(rangeSpan(image)[0]).toBe(10);
    const pixels = pixelsOf(image, [5, 20]);
    expect(pixels[3]).toBe(0); // nothing seen in the first row
    expect(pixels[(5 * image.width + 60) * 4 + 3]).toBe(255);
  });
});
