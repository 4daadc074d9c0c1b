import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { Problem, unreachable } from './problem';
import { reduceResources, ResourceLoader, type Resources } from './resources';

/** A daemon with one thing, which counts how often it was asked and sent. */
class Daemon {
  version = 1;
  asked = 0;
  sent = 0;
  failing = false;
  resources: Resources = {};
  readonly loader = new ResourceLoader({
    resources: () => this.resources,
    dispatch: (action) => (this.resources = reduceResources(this.resources, action)),
    now: () => Date.now(),
    fetch: async <T>(_: string, { etag }: { etag?: string | undefined }) => {
      this.asked += 1;
      if (this.failing) throw unreachable();
      if (etag === `"${this.version}"`) return undefined;
      this.sent += 1;
      return { data: this.version as T, etag: `"${this.version}"` };
    },
  });
}

describe('resources', () => {
  beforeEach(() => void vi.useFakeTimers());
  afterEach(() => void vi.useRealTimers());
  const settle = (ms = 0): Promise<unknown> => vi.advanceTimersByTimeAsync(ms);

  it('are asked once, however many look at them, and stay for the way back', async () => {
    const daemon = new Daemon();
    const ends = [daemon.loader.use('/a'), daemon.loader.use('/a')];
    await settle();
    expect(daemon.resources['/a']).toEqual({ data: 1, etag: '"1"', loading: false, stale: false });
    for (const end of ends) end();
    daemon.loader.use('/a');
    await settle(10_000);
    expect(daemon.asked).toBe(1);
  });

  it('are asked again when they may have changed, and sent again only when they did', async () => {
    const daemon = new Daemon();
    daemon.loader.use('/a');
    await settle(2000);
    daemon.loader.invalidate((key) => key === '/a');
    await settle(2000);
    expect([daemon.asked, daemon.sent]).toEqual([2, 1]);
    daemon.version = 2;
    daemon.loader.invalidate((key) => key === '/a');
    await settle(2000);
    expect([daemon.asked, daemon.sent]).toEqual([3, 2]);
    expect(daemon.resources['/a']).toMatchObject({ data: 2, stale: false, loading: false });
  });

  it('are asked at once for the first of many events, and for all the others together a moment later', async () => {
    const daemon = new Daemon();
    daemon.loader.use('/a');
    await settle(2000);
    for (let event = 0; event < 40; ++event) {
      daemon.loader.invalidate(() => true);
      await settle(10);
    }
    await settle(3000);
    expect(daemon.asked).toBe(3);
    expect(daemon.resources['/a']?.stale).toBe(false);
  });

  it('that are forgotten are not shown again until they are asked anew', async () => {
    const daemon = new Daemon();
    const end = daemon.loader.use('/a');
    await settle(2000);
    daemon.version = 2;
    daemon.loader.forget((key) => key === '/a');
    expect(daemon.resources['/a']).toBeUndefined();
    daemon.loader.use('/a');
    end();
    await settle(2000);
    expect(daemon.resources['/a']).toEqual({ data: 2, etag: '"2"', loading: false, stale: false });
  });

  it('that nobody looks at are asked when somebody does again', async () => {
    const daemon = new Daemon();
    daemon.loader.use('/a')();
    await settle(2000);
    daemon.loader.invalidate(() => true);
    await settle(2000);
    expect(daemon.asked).toBe(1);
    daemon.loader.use('/a');
    await settle();
    expect(daemon.asked).toBe(2);
  });

  it('keep what they showed when the daemon cannot be reached, and recover', async () => {
    const daemon = new Daemon();
    daemon.loader.use('/a');
    await settle(2000);
    daemon.failing = true;
    daemon.loader.invalidate(() => true);
    await settle(2000);
    expect(daemon.resources['/a']).toMatchObject({ data: 1, problem: expect.any(Problem) as Problem });
    daemon.failing = false;
    daemon.loader.invalidate((key) => daemon.resources[key]?.problem !== undefined);
    await settle(2000);
    expect(daemon.resources['/a']).toEqual({ data: 1, etag: '"1"', loading: false, stale: false });
  });
});
