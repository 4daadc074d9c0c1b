import { describe, expect, it } from 'vitest';
import { type QuantisedPoints, type Vector3 } from '../../lib/points/quantised';
import {
  approach,
  axesOf,
  besideSight,
  type Camera,
  depthRange,
  eyeOf,
  frame,
  kFromAbove,
  lookFrom,
  metresPerPixel,
  orbit,
  pan,
  project,
  zoom,
} from './camera';
import { keyed, scaleBar } from './controls';
import { learn, partOf, share } from './detail';
import { chosen, kNotMeasuring, measureOf, toggled } from './measuring';
import { pick } from './picking';
import { usualBox } from './scene_spec';
import { dot, length, minus, rotated } from './vectors';

const viewport = { width: 800, height: 600 };
const camera: Camera = { target_m: [423000, 5462000, 200], distance_m: 10, azimuth_rad: 0.3, elevation_rad: 0.4 };
const near = (one: readonly number[], other: readonly number[], digits = 6): void =>
  other.forEach((value, axis) => expect(one[axis]).toBeCloseTo(value, digits));

describe('the camera', () => {
  it('has axes at right angles, also straight above', () => {
    for (const { right, up, back } of [axesOf(camera), axesOf({ ...camera, ...kFromAbove })]) {
      near([dot(right, up), dot(up, back), dot(right, back)], [0, 0, 0]);
      near([length(right), length(up), length(back)], [1, 1, 1]);
    }
    const above = axesOf({ ...camera, ...kFromAbove });
    near(above.up, [0, 1, 0]);
    near(above.right, [1, 0, 0]);
  });

  it('looks at its target in the middle of the picture', () => {
    expect(project(camera, viewport, camera.target_m)?.x).toBeCloseTo(400);
    expect(project(camera, viewport, camera.target_m)?.y).toBeCloseTo(300);
    const behind = minus(eyeOf(camera), minus(camera.target_m, eyeOf(camera)));
    expect(project(camera, viewport, behind)).toBeUndefined();
  });

  it('holds a whole box in a wide and in a narrow picture', () => {
    const box = { min: [-3, 2, 0] as Vector3, max: [4, 5, 2] as Vector3 };
    for (const size of [viewport, { width: 390, height: 844 }]) {
      const framed = frame(box, { azimuth_rad: 1, elevation_rad: 0.5 }, size);
      for (const x of [-3, 4])
        for (const y of [2, 5])
          for (const z of [0, 2]) {
            const at = project(framed, size, [x, y, z]);
            expect(at && at.x > 0 && at.x < size.width && at.y > 0 && at.y < size.height).toBe(true);
          }
    }
  });

  it('stands where it is said to look from', () => {
    const eye: Vector3 = [423015, 5462011, 203.8];
    near(eyeOf(lookFrom(eye, camera.target_m)), eye);
    const beside = besideSight(eye, camera.target_m);
    expect(Math.abs(beside.azimuth_rad - lookFrom(eye, camera.target_m).azimuth_rad)).toBeLessThan(Math.PI / 4);
  });

  it('moves what is seen with the pointer, and keeps what lies under it as it comes nearer', () => {
    const moved = pan(camera, viewport, 100, 50);
    const at = project(moved, viewport, camera.target_m);
    expect(at?.x).toBeCloseTo(500);
    expect(at?.y).toBeCloseTo(350);
    const { right } = axesOf(camera);
    const aside = camera.target_m.map((v, axis) => v + (right[axis] ?? 0) * 100 * metresPerPixel(camera, viewport));
    const nearer = zoom(camera, viewport, 0.5, { x: 500, y: 300 });
    expect(nearer.distance_m).toBe(5);
    expect(project(nearer, viewport, aside as unknown as Vector3)?.x).toBeCloseTo(500);
  });

  it('turns no farther than straight above and nearly straight below', () => {
    expect(orbit(camera, 0, 9).elevation_rad).toBe(Math.PI / 2);
    expect(orbit(camera, 0, -9).elevation_rad).toBeGreaterThan(-Math.PI / 2);
  });

  it('arrives: after a while it is where it shall be, and not only near', () => {
    const goal = { ...orbit(camera, 2 * Math.PI + 0.5, 0.2), distance_m: 30 };
    let shown = camera;
    let frames = 0;
    while (shown !== goal && frames < 200) {
      shown = approach(shown, goal, 1 / 60);
      ++frames;
    }
    expect(shown).toBe(goal);
    expect(frames).toBeGreaterThan(5);
    expect(frames).toBeLessThan(60);
  });

  it('sees what lies between a hand and behind everything', () => {
    const { near, far } = depthRange(camera, 100);
    expect(far).toBeGreaterThan(110);
    expect(near).toBeLessThan(0.5);
  });

  it('obeys keys, and leaves others alone', () => {
    const viewer = { camera, size: viewport };
    const key = (name: string, shiftKey = false) =>
      keyed({ ...viewer, look: () => undefined }, { key: name, shiftKey });
    expect(key('ArrowLeft')?.azimuth_rad).toBeLessThan(camera.azimuth_rad);
    expect(key('ArrowUp', true)?.target_m).not.toEqual(camera.target_m);
    expect(key('+')?.distance_m).toBeLessThan(10);
    expect(key('Tab')).toBeUndefined();
  });

  it('has a scale of a round length', () => {
    const { length_m, width_px } = scaleBar(camera, viewport, 120);
    expect([1, 2, 5]).toContain(Number((length_m / 10 ** Math.floor(Math.log10(length_m))).toFixed(6)));
    expect(width_px).toBeLessThanOrEqual(120);
    expect(width_px).toBeGreaterThan(45);
  });
});

describe('levels of detail', () => {
  it('draw what matters in full, and of the rest what is left', () => {
    const layers = [
      { loaded: 900_000, important: false },
      { loaded: 5_000, important: true },
      { loaded: 100_000, important: false },
    ];
    expect(share(layers, Infinity)).toEqual([900_000, 5_000, 100_000]);
    const drawn = share(layers, 205_000);
    expect(drawn[1]).toBe(5_000);
    expect((drawn[0] ?? 0) / (drawn[2] ?? 1)).toBeCloseTo(9);
    expect(drawn.reduce((sum, count) => sum + count, 0)).toBeLessThanOrEqual(205_002);
  });

  it('learn from slow frames and from fast ones', () => {
    expect(learn({ moving: 400_000 }, 60).moving).toBe(280_000);
    expect(learn({ moving: 400_000 }, 8).moving).toBe(460_000);
    expect(learn({ moving: 400_000 }, 20).moving).toBe(400_000);
    expect(learn({ moving: 40_000 }, 500).moving).toBe(40_000);
  });

  it('are a beginning of the parts', () => {
    expect([0, 150_000, 900_000].map((first) => partOf(200_000, first, 150_000))).toEqual([150_000, 50_000, 0]);
  });
});

/** Points at whole numbers, an millimetre a step. */
function points(places: readonly Vector3[], origin_m: Vector3 = [0, 0, 0]): QuantisedPoints {
  const records = Uint16Array.from(places.flatMap(([x, y, z]) => [x * 1000, y * 1000, z * 1000, 1]));
  const step: Vector3 = [0.001, 0.001, 0.001];
  const count = places.length;
  return { count, total: count, first: 0, origin_m, step_m: step, hasClasses: true, intensity: undefined, records };
}

describe('picking', () => {
  const eye = lookFrom([5, -10, 1], [5, 5, 1]);
  const among = (part: QuantisedPoints, drawn = part.count) => [{ part, drawn, shows: () => true }];

  it('takes the point under the pointer, of several the one in front', () => {
    const part = points([
      [5, 9, 1],
      [5, 5, 1],
      [8, 5, 1],
    ]);
    expect(pick(eye, viewport, { x: 400, y: 300 }, among(part))?.index).toBe(1);
    const aside = project(eye, viewport, [8, 5, 1]);
    expect(pick(eye, viewport, { x: (aside?.x ?? 0) + 3, y: aside?.y ?? 0 }, among(part))?.place_m).toEqual([8, 5, 1]);
  });

  it('takes none beside, behind, or not drawn', () => {
    const part = points([[5, 5, 1]]);
    expect(pick(eye, viewport, { x: 300, y: 300 }, among(part))).toBeUndefined();
    expect(pick(eye, viewport, { x: 400, y: 300 }, among(part, 0))).toBeUndefined();
    expect(pick(lookFrom([5, 20, 1], [5, 30, 1]), viewport, { x: 400, y: 300 }, among(part))).toBeUndefined();
  });

  it('is as exact far from the origin', () => {
    const part = points([[5, 5, 1]], [423000, 5462000, 200]);
    const far = lookFrom([423005, 5461990, 201], [423005, 5462005, 201]);
    expect(pick(far, viewport, { x: 400, y: 300 }, among(part))?.place_m).toEqual([423005, 5462005, 201]);
  });
});

describe('measuring', () => {
  it('goes from a first point to a second, and begins anew with a third', () => {
    let measuring = toggled(kNotMeasuring);
    measuring = chosen(measuring, [0, 0, 0]);
    measuring = chosen(measuring, [3, 4, -12]);
    expect(measuring).toEqual({ step: 'done', from_m: [0, 0, 0], to_m: [3, 4, -12] });
    expect(measureOf({ from_m: [0, 0, 0], to_m: [3, 4, -12] })).toEqual({ length_m: 13, level_m: 5, rise_m: -12 });
    expect(chosen(measuring, [1, 1, 1]).step).toBe('second');
    expect(toggled(measuring).step).toBe('off');
    expect(chosen(kNotMeasuring, [1, 1, 1]).step).toBe('off');
  });
});

describe('what a scene needs to know', () => {
  it('leaves the few points far away out of the usual box', () => {
    const places = Array.from({ length: 100 }, (_, index): Vector3 => [index === 7 ? 60 : (index % 10) / 10, 1, 2]);
    const box = usualBox(points(places));
    expect(box?.max[0]).toBeLessThan(1);
    expect(usualBox(points([]))).toBeUndefined();
  });

  it('turns vectors as the daemon means it', () => {
    near(rotated([0, 0, Math.SQRT1_2, Math.SQRT1_2], [1, 0, 0]), [0, 1, 0]);
  });
});
