import { describe, expect, it } from 'vitest';
import { type LoadedPoints, nextPart, PointStore } from './point_store';
import { boxOf, classOf, decodeQuantised, placeOf } from './quantised';

/** "q16" as the daemon writes it: points along x, one step apart. */
function quantised(given: { first?: number; count: number; total?: number; step_m?: number }): ArrayBuffer {
  const bytes = new ArrayBuffer(96 + given.count * 8);
  const view = new DataView(bytes);
  view.setUint32(0, 0x52575051);
  view.setUint32(4, 1, true);
  view.setBigUint64(8, BigInt(given.count), true);
  view.setBigUint64(16, BigInt(given.total ?? given.count), true);
  view.setBigUint64(24, BigInt(given.first ?? 0), true);
  [423000, 5462000, 200].forEach((value, axis) => view.setFloat64(32 + 8 * axis, value, true));
  [given.step_m ?? 0.5, 0.001, 0].forEach((value, axis) => view.setFloat64(56 + 8 * axis, value, true));
  view.setUint32(88, 1, true);
  for (let i = 0; i < given.count; ++i) {
    view.setUint16(96 + 8 * i, (given.first ?? 0) + i, true);
    view.setUint16(96 + 8 * i + 2, 65535, true);
    view.setUint8(96 + 8 * i + 6, i % 7);
    view.setUint8(96 + 8 * i + 7, 255);
  }
  return bytes;
}

describe('quantised points', () => {
  it('are decoded where they lie, as places and classes', () => {
    const points = decodeQuantised(quantised({ count: 3 }));
    expect(points.count).toBe(3);
    expect(points.hasClasses).toBe(true);
    expect(points.intensity).toBeUndefined();
    expect(placeOf(points, 2)).toEqual([423001, 5462065.535, 200]);
    expect([0, 1, 2].map((index) => classOf(points, index))).toEqual(['unchanged', 'added', 'removed']);
    expect(boxOf(points).max).toEqual([423000 + 0.5 * 65535, 5462065.535, 200]);
  });

  it('that were cut off, or are something else, are refused in words', () => {
    expect(() => decodeQuantised(quantised({ count: 3 }).slice(0, 110))).toThrow('cut off');
    expect(() => decodeQuantised(new ArrayBuffer(20))).toThrow('another format');
    const later = quantised({ count: 1 });
    new DataView(later).setUint32(4, 2, true);
    expect(() => decodeQuantised(later)).toThrow('version 2');
  });
});

describe('the store of points', () => {
  const total = 2_000_000;
  /** Answers as the daemon would, and keeps what was asked. */
  function daemon(step_m = (): number => 0.5) {
    const asked: string[] = [];
    const fetch = (from: string): Promise<ArrayBuffer> => {
      asked.push(from);
      const query = new URLSearchParams(from.split('?')[1]);
      const first = Number(query.get('skip'));
      // The counts are true, the points a few: nobody looks at them here.
      const answer = quantised({ count: 0, total, first, step_m: step_m() });
      const count = Math.max(0, Math.min(Number(query.get('budget')), total - first));
      const bytes = new ArrayBuffer(96 + count * 8);
      new Uint8Array(bytes).set(new Uint8Array(answer));
      new DataView(bytes).setBigUint64(8, BigInt(count), true);
      return Promise.resolve(bytes);
    };
    return { asked, fetch };
  }

  it('begins with few, goes on until enough are there, and asks for none twice', async () => {
    const { asked, fetch } = daemon();
    const store = new PointStore(fetch);
    const heard: number[] = [];
    const hear = ({ loaded }: LoadedPoints): void => void heard.push(loaded);
    await store.load('/points?format=q16', 1_000_000, hear);
    expect(heard).toEqual([150_000, 900_000, 1_000_000]);
    await store.load('/points?format=q16', 500_000, hear);
    expect(heard.slice(3)).toEqual([1_000_000]);
    await store.load('/points?format=q16', 9_000_000, hear);
    expect(heard.slice(4)).toEqual([1_000_000, 2_000_000]);
    expect(asked.map((from) => from.split('skip=')[1])).toEqual([
      '0&budget=150000',
      '150000&budget=750000',
      '900000&budget=100000',
      '1000000&budget=5000000',
    ]);
  });

  it('asks once for what two views want at the same time', async () => {
    const { asked, fetch } = daemon();
    const store = new PointStore(fetch);
    await Promise.all([1, 2].map(() => store.load('/points?format=q16', 150_000, () => undefined)));
    expect(asked.length).toBe(1);
  });

  it('begins anew when the places have moved meanwhile', async () => {
    const steps = [0.5, 0.25, 0.25, 0.25, 0.25];
    const { fetch } = daemon(() => steps.shift() ?? 0.25);
    let last: LoadedPoints | undefined;
    await new PointStore(fetch).load('/points?format=q16', 500_000, (points) => (last = points));
    expect(last?.parts.map((part) => part.step_m[0])).toEqual([0.25, 0.25]);
    expect(last?.loaded).toBe(500_000);
  });

  it('makes each part several times as large, but no larger than is wanted', () => {
    expect(nextPart(0, 5_000_000)).toBe(150_000);
    expect(nextPart(150_000, 5_000_000)).toBe(750_000);
    expect(nextPart(150_000, 200_000)).toBe(50_000);
    expect(nextPart(0, 1_000)).toBe(1_000);
  });
});
