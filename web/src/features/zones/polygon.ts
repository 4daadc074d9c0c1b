// The geometry of outlines: area, sides that cross, which points lie inside. All of it is pure.

import { type Place } from '../../ui/top_view/frame';

/** In square metres, whichever way around it goes. */
export function area(corners: readonly Place[]): number {
  return Math.abs(signedArea(corners));
}

function signedArea(corners: readonly Place[]): number {
  const [origin] = corners;
  if (!origin) return 0;
  // Relative to a corner: products of a country's coordinates would lose digits.
  return corners.reduce((sum, corner, index) => {
    const next = corners[(index + 1) % corners.length] ?? corner;
    const [x, y] = [corner[0] - origin[0], corner[1] - origin[1]];
    return sum + (x * (next[1] - origin[1]) - (next[0] - origin[0]) * y) / 2;
  }, 0);
}

/** In metres, with the way back to the first corner. */
export function perimeter(corners: readonly Place[]): number {
  return corners.reduce((sum, corner, index) => {
    const next = corners[(index + 1) % corners.length] ?? corner;
    return sum + Math.hypot(next[0] - corner[0], next[1] - corner[1]);
  }, 0);
}

/** On which side of the line from a to b lies c: positive on its left, 0 on it. */
const sideOf = (a: Place, b: Place, c: Place): number =>
  Math.sign((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));

const isBetween = (a: Place, b: Place, c: Place): boolean =>
  Math.min(a[0], b[0]) <= c[0] &&
  c[0] <= Math.max(a[0], b[0]) &&
  Math.min(a[1], b[1]) <= c[1] &&
  c[1] <= Math.max(a[1], b[1]);

function touches(a: Place, b: Place, c: Place, d: Place): boolean {
  const [c1, d1, a1, b1] = [sideOf(a, b, c), sideOf(a, b, d), sideOf(c, d, a), sideOf(c, d, b)];
  if (c1 !== d1 && a1 !== b1) return true;
  return (
    (c1 === 0 && isBetween(a, b, c)) ||
    (d1 === 0 && isBetween(a, b, d)) ||
    (a1 === 0 && isBetween(c, d, a)) ||
    (b1 === 0 && isBetween(c, d, b))
  );
}

/** Two sides that cross or touch, by the numbers of their first corners; undefined when there are none. */
export function crossing(corners: readonly Place[]): readonly [number, number] | undefined {
  const count = corners.length;
  for (let one = 0; one < count; ++one) {
    for (let other = one + 2; other < count; ++other) {
      if (one === 0 && other === count - 1) continue; // neighbours
      const [a, b] = [corners[one]!, corners[one + 1]!];
      const [c, d] = [corners[other]!, corners[(other + 1) % count]!];
      if (touches(a, b, c, d)) return [one, other];
    }
  }
  return undefined;
}

/** Whether a place lies inside; on the edge, either. */
export function isInside(corners: readonly Place[], [x, y]: Place): boolean {
  let inside = false;
  for (let at = 0, before = corners.length - 1; at < corners.length; before = at++) {
    const [a, b] = [corners[at]!, corners[before]!];
    if (a[1] > y !== b[1] > y && x < ((b[0] - a[0]) * (y - a[1])) / (b[1] - a[1]) + a[0]) inside = !inside;
  }
  return inside;
}

/** How far a place is from the side from a to b. */
export function distanceToSide([x, y]: Place, a: Place, b: Place): number {
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const length2 = dx * dx + dy * dy;
  const along = length2 === 0 ? 0 : Math.min(1, Math.max(0, ((x - a[0]) * dx + (y - a[1]) * dy) / length2));
  return Math.hypot(x - a[0] - along * dx, y - a[1] - along * dy);
}
