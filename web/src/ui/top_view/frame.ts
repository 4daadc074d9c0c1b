// What part of a site a picture from above shows, and where each place lies in it. North (+y) is up. All of it is pure.

/** x to the east and y to the north in metres, in the site's frame. */
export type Place = readonly [x_m: number, y_m: number];

/** From the corner at the top left, in CSS pixels. */
export type Pixel = readonly [x_px: number, y_px: number];

export interface Bounds {
  readonly min: Place;
  readonly max: Place;
}

export interface Frame {
  readonly centre_m: Place;
  readonly metres_per_pixel: number;
  readonly width_px: number;
  readonly height_px: number;
}

const kFinest_m = 0.0005;
const kCoarsest_m = 1000;

export const toPixel = (frame: Frame, [x, y]: Place): Pixel => [
  frame.width_px / 2 + (x - frame.centre_m[0]) / frame.metres_per_pixel,
  frame.height_px / 2 - (y - frame.centre_m[1]) / frame.metres_per_pixel,
];

export const toPlace = (frame: Frame, [x, y]: Pixel): Place => [
  frame.centre_m[0] + (x - frame.width_px / 2) * frame.metres_per_pixel,
  frame.centre_m[1] - (y - frame.height_px / 2) * frame.metres_per_pixel,
];

/** The frame after the picture was dragged by so many pixels to the right and down. */
export const panned = (frame: Frame, [right, down]: Pixel): Frame => ({
  ...frame,
  centre_m: [frame.centre_m[0] - right * frame.metres_per_pixel, frame.centre_m[1] + down * frame.metres_per_pixel],
});

/** Nearer by `factor`; what lies at `about` stays there. */
export function zoomed(frame: Frame, factor: number, about: Pixel): Frame {
  const metres_per_pixel = Math.min(kCoarsest_m, Math.max(kFinest_m, frame.metres_per_pixel / factor));
  const fixed = toPlace(frame, about);
  const moved = toPlace({ ...frame, metres_per_pixel }, about);
  const centre_m: Place = [frame.centre_m[0] + fixed[0] - moved[0], frame.centre_m[1] + fixed[1] - moved[1]];
  return { ...frame, metres_per_pixel, centre_m };
}

const kMargin = 1.12;

/** All of the bounds, as near as they fit. */
export function fitted({ min, max }: Bounds, width_px: number, height_px: number): Frame {
  const across = Math.max(max[0] - min[0], 0.5) / Math.max(1, width_px);
  const along = Math.max(max[1] - min[1], 0.5) / Math.max(1, height_px);
  return {
    centre_m: [(min[0] + max[0]) / 2, (min[1] + max[1]) / 2],
    metres_per_pixel: Math.max(across, along) * kMargin,
    width_px,
    height_px,
  };
}

export function boundsOf(places: readonly Place[]): Bounds | undefined {
  if (places.length === 0) return undefined;
  const x = places.map((place) => place[0]);
  const y = places.map((place) => place[1]);
  return { min: [Math.min(...x), Math.min(...y)], max: [Math.max(...x), Math.max(...y)] };
}

/** With so much more on each side, for some of what is around. */
export const widened = ({ min, max }: Bounds, by_m: number): Bounds => ({
  min: [min[0] - by_m, min[1] - by_m],
  max: [max[0] + by_m, max[1] + by_m],
});

/** The longest of 1, 2 or 5 times a power of ten that is at most so long. */
export function roundLength(most_m: number): number {
  const power = 10 ** Math.floor(Math.log10(most_m));
  return (most_m / power >= 5 ? 5 : most_m / power >= 2 ? 2 : 1) * power;
}

const kBar_px = 120;

/** A bar that shows how long so many metres are: "20 m", "5 cm". */
export function scaleBar(frame: Frame): { length_px: number; words: string } {
  const length_m = roundLength(kBar_px * frame.metres_per_pixel);
  const words =
    length_m >= 1000
      ? `${length_m / 1000}\u00a0km`
      : length_m >= 1
        ? `${length_m}\u00a0m`
        : `${Math.round(length_m * 1000) / 10}\u00a0cm`;
  return { length_px: length_m / frame.metres_per_pixel, words };
}
