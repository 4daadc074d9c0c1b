// Points as far as they are loaded. The daemon sends them from coarse to fine, so that each part only adds to those before:
// a view draws what is there, and nothing is fetched twice.

import { fetchBytes } from '../api';
import { decodeQuantised, fitTogether, type QuantisedPoints } from './quantised';

/** Parts that follow each other; the beginning of them is an even thinning of all, wherever it ends. */
export interface LoadedPoints {
  readonly parts: readonly QuantisedPoints[];
  readonly loaded: number;
  /** Of the whole set; nothing before the first part. */
  readonly total: number | undefined;
}

const kNone: LoadedPoints = { parts: [], loaded: 0, total: undefined };

/** The first part is small, so that something is seen at once; each later one makes it several times as many. */
const kFirstPart = 150_000;
const kGrowth = 6;

/** How many points the next part has. @param wanted how many the view wants in all */
export function nextPart(loaded: number, wanted: number): number {
  return Math.min(wanted, loaded === 0 ? kFirstPart : loaded * kGrowth) - loaded;
}

interface Entry {
  points: LoadedPoints;
  pending: Promise<void> | undefined;
}

const kMostBytes = 256e6;

export class PointStore {
  /** The latest used last. */
  private readonly entries = new Map<string, Entry>();

  constructor(private readonly fetch: (from: string) => Promise<ArrayBuffer> = fetchBytes) {}

  /**
   * Loads points until there are as many as wanted, or all.
   * @param from an address of points with `format=q16`, and without `budget` and `skip`
   * @param onMore hears of what is there already, and of each part that arrives
   * @throws Problem
   */
  async load(
    from: string,
    wanted: number,
    onMore: (points: LoadedPoints) => void,
    signal?: AbortSignal,
  ): Promise<void> {
    const entry = this.use(from);
    if (entry.points.loaded > 0) onMore(entry.points);
    for (;;) {
      const { loaded, total } = entry.points;
      if (signal?.aborted || loaded >= Math.min(wanted, total ?? Infinity)) return;
      // Two views of the same points share what is on its way.
      entry.pending ??= this.more(from, entry, wanted).finally(() => (entry.pending = undefined));
      await entry.pending;
      if (signal?.aborted) return;
      onMore(entry.points);
    }
  }

  private async more(from: string, entry: Entry, wanted: number): Promise<void> {
    const { loaded } = entry.points;
    const part = decodeQuantised(await this.fetch(`${from}&skip=${loaded}&budget=${nextPart(loaded, wanted)}`));
    const before = entry.points.parts[0];
    // The pose was refined meanwhile: these are other places. It begins anew with the next part.
    if (before && !fitTogether(before, part)) entry.points = kNone;
    else {
      entry.points = { parts: [...entry.points.parts, part], loaded: loaded + part.count, total: part.total };
    }
    this.dropOldest(from);
  }

  private use(from: string): Entry {
    const entry = this.entries.get(from) ?? { points: kNone, pending: undefined };
    this.entries.delete(from);
    this.entries.set(from, entry);
    return entry;
  }

  private dropOldest(current: string): void {
    const bytes = (): number => [...this.entries.values()].reduce((sum, { points }) => sum + points.loaded * 8, 0);
    for (const [key, entry] of this.entries) {
      if (bytes() <= kMostBytes) return;
      if (key !== current && !entry.pending) this.entries.delete(key);
    }
  }
}

/** The points that this page has. */
export const pointStore = new PointStore();
