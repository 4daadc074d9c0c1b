// What was asked from the daemon, by address: kept once, asked again only when an event says that it may have changed,
// and then with its version, so that nothing that is still the same is sent twice.

import { type Address, type Answer, ask } from './api';
import { Problem } from './problem';

/** One address as it is known. Before the first answer neither `data` nor `problem` is there. */
export interface Resource<T = unknown> {
  readonly data?: T;
  readonly problem?: Problem;
  readonly etag?: string | undefined;
  readonly loading: boolean;
  /** Something happened since that may have changed it. */
  readonly stale: boolean;
}

export type Resources = Readonly<Record<string, Resource>>;

export type ResourceAction =
  | { type: 'resource/asked'; key: string }
  | { type: 'resource/arrived'; key: string; data: unknown; etag: string | undefined }
  | { type: 'resource/unchanged'; key: string }
  | { type: 'resource/failed'; key: string; problem: Problem }
  | { type: 'resource/stale'; keys: readonly string[] }
  | { type: 'resource/dropped'; keys: readonly string[] };

const kUnknown: Resource = { loading: false, stale: false };

export function reduceResources(resources: Resources, action: ResourceAction): Resources {
  switch (action.type) {
    case 'resource/asked':
      return with_(resources, action.key, { loading: true, stale: false });
    case 'resource/arrived':
      return {
        ...resources,
        [action.key]: {
          data: action.data,
          etag: action.etag,
          loading: false,
          stale: resources[action.key]?.stale ?? false,
        },
      };
    case 'resource/unchanged': {
      const { problem: _, ...known } = resources[action.key] ?? kUnknown;
      return { ...resources, [action.key]: { ...known, loading: false } };
    }
    case 'resource/failed':
      return with_(resources, action.key, { loading: false, problem: action.problem });
    case 'resource/stale':
      return action.keys.reduce((all, key) => (all[key] ? with_(all, key, { stale: true }) : all), resources);
    case 'resource/dropped': {
      const dropped = new Set(action.keys);
      return Object.fromEntries(Object.entries(resources).filter(([key]) => !dropped.has(key)));
    }
  }
}

function with_(resources: Resources, key: string, change: Partial<Resource>): Resources {
  return { ...resources, [key]: { ...(resources[key] ?? kUnknown), ...change } };
}

/** Events may come many times a second; an address is asked again at most so often. */
const kLeastMsBetween = 500;
/** Addresses that nobody looks at any more are kept up to this number, for the way back. */
const kMostUnused = 60;

export interface ResourceLoaderOptions {
  resources: () => Resources;
  dispatch: (action: ResourceAction) => void;
  fetch?: <T>(from: Address<T>, options: { etag?: string | undefined }) => Promise<Answer<T> | undefined>;
  /** Waited for before the first question, so that nothing happens unheard between an answer and the first event. */
  ready?: Promise<unknown>;
  now?: () => number;
}

/** Asks for the addresses that are in use, and again for those that become stale. */
export class ResourceLoader {
  private readonly users = new Map<string, number>();
  private readonly askedAt = new Map<string, number>();
  private readonly timers = new Map<string, ReturnType<typeof setTimeout>>();
  private readonly options: Required<ResourceLoaderOptions>;

  constructor(options: ResourceLoaderOptions) {
    this.options = { fetch: ask, ready: Promise.resolve(), now: () => performance.now(), ...options };
  }

  /** Holds an address as long as somebody looks at it. @returns what ends that. */
  use(key: string): () => void {
    this.users.set(key, (this.users.get(key) ?? 0) + 1);
    this.ensure(key);
    return () => {
      const left = (this.users.get(key) ?? 1) - 1;
      if (left > 0) this.users.set(key, left);
      else this.users.delete(key);
      this.dropUnused();
    };
  }

  /** Asks again for what failed or may have changed, of the given addresses. */
  invalidate(matches: (key: string) => boolean): void {
    const keys = Object.keys(this.options.resources()).filter(matches);
    if (keys.length === 0) return;
    this.options.dispatch({ type: 'resource/stale', keys });
    for (const key of keys) if (this.users.has(key)) this.ensure(key);
  }

  /** Drops what must not be shown again, not even until it is asked anew: what lists a thing that is gone. */
  forget(matches: (key: string) => boolean): void {
    const keys = Object.keys(this.options.resources()).filter(matches);
    if (keys.length > 0) this.options.dispatch({ type: 'resource/dropped', keys });
  }

  /** Puts an answer in place that came another way, such as that of an edit. */
  put<T>(key: Address<T>, answer: Answer<T>): void {
    this.options.dispatch({ type: 'resource/arrived', key, data: answer.data, etag: answer.etag });
  }

  private ensure(key: string): void {
    const known = this.options.resources()[key];
    if (known?.loading || this.timers.has(key)) return;
    const wanted = known === undefined || known.stale || known.problem !== undefined || known.data === undefined;
    if (!wanted) return;
    const wait = (this.askedAt.get(key) ?? -Infinity) + kLeastMsBetween - this.options.now();
    if (wait <= 0) return void this.load(key);
    this.timers.set(
      key,
      setTimeout(() => {
        this.timers.delete(key);
        if (this.users.has(key)) void this.load(key);
      }, wait),
    );
  }

  private async load(key: string): Promise<void> {
    const { dispatch, fetch, ready, resources, now } = this.options;
    dispatch({ type: 'resource/asked', key });
    await ready;
    this.askedAt.set(key, now());
    try {
      const answer = await fetch(key, { etag: resources()[key]?.etag });
      dispatch(answer ? { type: 'resource/arrived', key, ...answer } : { type: 'resource/unchanged', key });
    } catch (failure) {
      if (!(failure instanceof Problem)) throw failure;
      dispatch({ type: 'resource/failed', key, problem: failure });
      return;
    }
    if (resources()[key]?.stale && this.users.has(key)) this.ensure(key);
  }

  private dropUnused(): void {
    const unused = Object.keys(this.options.resources()).filter((key) => !this.users.has(key));
    const surplus = unused.slice(0, Math.max(0, unused.length - kMostUnused));
    if (surplus.length === 0) return;
    for (const key of surplus) this.askedAt.delete(key);
    this.options.dispatch({ type: 'resource/dropped', keys: surplus });
  }
}
