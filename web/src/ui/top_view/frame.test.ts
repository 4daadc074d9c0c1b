import { describe, expect, it } from 'vitest';
import { boundsOf, fitted, panned, scaleBar, toPixel, toPlace, zoomed } from './frame';

const frame = fitted({ min: [500_000, 5_800_000], max: [500_040, 5_800_020] }, 800, 600);

describe('a frame', () => {
  it('shows all of what it is fitted to, with north up', () => {
    const [left, top] = toPixel(frame, [500_000, 5_800_020]);
    const [right, bottom] = toPixel(frame, [500_040, 5_800_000]);
    expect(left).toBeGreaterThan(0);
    expect(right).toBeLessThan(800);
    expect(top).toBeGreaterThan(0);
    expect(bottom).toBeLessThan(600);
    expect(bottom).toBeGreaterThan(top);
  });

  it('leads from places to pixels and back', () => {
    const place = toPlace(frame, toPixel(frame, [500_012.25, 5_800_003.5]));
    expect(place[0]).toBeCloseTo(500_012.25, 6);
    expect(place[1]).toBeCloseTo(5_800_003.5, 6);
  });

  it('keeps what lies under the pointer where it is when it zooms', () => {
    const under = toPlace(frame, [200, 450]);
    const nearer = zoomed(frame, 3, [200, 450]);
    expect(nearer.metres_per_pixel).toBeCloseTo(frame.metres_per_pixel / 3);
    expect(toPixel(nearer, under)[0]).toBeCloseTo(200, 5);
    expect(toPixel(nearer, under)[1]).toBeCloseTo(450, 5);
    expect(zoomed(frame, 1e9, [0, 0]).metres_per_pixel).toBe(0.0005);
  });

  it('follows the hand that drags it', () => {
    const under = toPlace(frame, [100, 100]);
    const [x, y] = toPixel(panned(frame, [30, -20]), under);
    expect(x).toBeCloseTo(130, 5);
    expect(y).toBeCloseTo(80, 5);
  });

  it('has a scale of a round length', () => {
    expect(scaleBar({ ...frame, metres_per_pixel: 0.05 })).toEqual({ length_px: 100, words: '5\u00a0m' });
    expect(scaleBar({ ...frame, metres_per_pixel: 0.001 })).toEqual({ length_px: 100, words: '10\u00a0cm' });
    expect(scaleBar({ ...frame, metres_per_pixel: 20 })).toEqual({ length_px: 100, words: '2\u00a0km' });
  });

  it('is bounded by places', () => {
    expect(boundsOf([])).toBeUndefined();
    expect(
      boundsOf([
        [1, 5],
        [-2, 3],
      ]),
    ).toEqual({ min: [-2, 3], max: [1, 5] });
  });
});
