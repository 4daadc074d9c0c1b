// A place of a site as links and the API write it: a point "x,y,z" or a box "x0,y0,z0,x1,y1,z1", in metres.

export type Vector3 = readonly [x: number, y: number, z: number];

export interface Place {
  readonly min_m: Vector3;
  /** The same as `min_m` for a point. */
  readonly max_m: Vector3;
}

export const pointPlace = (point_m: readonly number[]): Place => {
  const point = point_m as unknown as Vector3;
  return { min_m: point, max_m: point };
};

export const isPoint = ({ min_m, max_m }: Place): boolean => min_m.every((part, axis) => part === max_m[axis]);

/** Centimetres are finer than any question about a place. */
const written = (parts: readonly number[]): string => parts.map((part) => String(Number(part.toFixed(3)))).join(',');

/** As the parameters of `GET /history`, of which one is there. */
export function placeQuery(place: Place): { point?: string; box?: string } {
  return isPoint(place) ? { point: written(place.min_m) } : { box: `${written(place.min_m)},${written(place.max_m)}` };
}

/** What the parameters of a link say; nothing when they are missing or broken. */
export function placeOf(query: Readonly<Record<string, string | undefined>>): Place | undefined {
  const numbers = (text: string | undefined, count: number): number[] | undefined => {
    const parts = text?.split(',').map((part) => (part.trim() === '' ? NaN : Number(part)));
    return parts?.length === count && parts.every(Number.isFinite) ? parts : undefined;
  };
  const point = numbers(query['point'], 3);
  if (point) return pointPlace(point);
  const box = numbers(query['box'], 6);
  if (!box) return undefined;
  return { min_m: box.slice(0, 3) as unknown as Vector3, max_m: box.slice(3) as unknown as Vector3 };
}

/** A link to what was at a place through time. */
export function historyLink(site: string, place: Place): string {
  return `/history?${new URLSearchParams({ site, ...placeQuery(place) })}`;
}
