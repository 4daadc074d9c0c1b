import { describe, expect, it } from 'vitest';
import type { Cloud } from '../../ui/top_view/clouds';
import type { Place } from '../../ui/top_view/frame';
import { pointsBetween, pointsOver } from './inside';
import { area, crossing, isInside, perimeter } from './polygon';

const square: readonly Place[] = [
  [0, 0],
  [6, 0],
  [6, 4],
  [0, 4],
];
/** The square far from the origin of its country's coordinates. */
const far = square.map(([x, y]): Place => [x + 500_000, y + 5_800_000]);

describe('an outline', () => {
  it('has an area and a length, whichever way around it goes and wherever it lies', () => {
    expect(area(square)).toBe(24);
    expect(area([...square].reverse())).toBe(24);
    expect(area(far)).toBe(24);
    expect(perimeter(far)).toBe(20);
    expect(area([])).toBe(0);
  });

  it('is told when its sides cross or touch', () => {
    expect(crossing(square)).toBeUndefined();
    expect(crossing([square[0]!, square[2]!, square[1]!, square[3]!])).toEqual([0, 2]);
    // A corner that lies on another side.
    expect(crossing([...square, [3, 0]])).toEqual([0, 3]);
    expect(crossing(square.slice(0, 3))).toBeUndefined();
  });

  it('has an inside, with notches', () => {
    const notched: Place[] = [...square.slice(0, 3), [3, 1], [0, 4]];
    expect(isInside(notched, [1, 1])).toBe(true);
    expect(isInside(notched, [3, 3])).toBe(false);
    expect(isInside(notched, [7, 1])).toBe(false);
  });
});

describe('the points of a zone', () => {
  const cloud: Cloud = {
    scan: 1,
    origin_m: [500_000, 5_800_000, 100],
    xyz_m: Float32Array.of(1, 1, 0, 5, 3, 2, 7, 1, 0, 3, 2, 9),
    spacing_m: 0.1,
  };

  it('lie over its outline and between its heights', () => {
    const inside = pointsOver([cloud], far)!;
    expect([...inside.over[0]!]).toEqual([1, 1, 0, 1]);
    expect([...inside.z_m]).toEqual([100, 102, 109]);
    expect(inside.goesEast).toBe(true);
    const { marks, count } = pointsBetween([cloud], inside, [99, 103]);
    expect(count).toBe(2);
    expect([...marks[0]!]).toEqual([1, 1, 0, 0]);
    expect(pointsBetween([cloud], inside, [NaN, NaN]).count).toBe(0);
  });

  it('are none as long as there is no outline', () => {
    expect(pointsOver([cloud], far.slice(0, 2))).toBeUndefined();
  });
});
