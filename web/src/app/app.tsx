// The running dashboard: state, what keeps it up to date, and the hooks by which views use it.

import { useEffect, useLayoutEffect, useReducer, useRef } from 'preact/hooks';
import { type Address } from '../lib/api';
import { EventStream } from '../lib/event_stream';
import { addKeys, type KeyBinding, listenToKeys } from '../lib/keys';
import { type Problem } from '../lib/problem';
import { type Resource, ResourceLoader } from '../lib/resources';
import { createStore } from '../lib/store';
import { type LiveEvent, touches } from './live';
import { linkTo, parseLocation } from './router';
import { loadSettings, saveSettings, type Settings } from './settings';
import { type Action, initialState, reduce, type State } from './state';
import { type Toast } from './toasts';

export const store = createStore<State, Action>(
  initialState(parseLocation(window.location.href), loadSettings(), Date.now()),
  reduce,
);

/** How long answers wait for the stream of events at most; see ResourceLoaderOptions.ready. */
const kStreamPatienceMs = 400;
let streamOpened: () => void = () => undefined;
const opened = new Promise<void>((resolve) => (streamOpened = resolve));
const patience = new Promise<void>((resolve) => setTimeout(resolve, kStreamPatienceMs));

export const loader = new ResourceLoader({
  resources: () => store.state().resources,
  dispatch: (action) => {
    // What arrives is shown as of now, not as of the last tick.
    if (action.type === 'resource/arrived') tick();
    store.dispatch(action);
  },
  ready: Promise.race([opened, patience]),
});

/** Starts what runs as long as the page does. */
export function startApp(): void {
  listenToKeys();
  listenToLinks();
  startStream();
  setInterval(() => {
    if (!document.hidden) tick();
  }, kTickMs);
  let saved = store.state().settings;
  applyTheme(saved);
  store.subscribe(() => {
    const { settings } = store.state();
    if (settings === saved) return;
    saved = settings;
    saveSettings(settings);
    applyTheme(settings);
  });
}

/** What is shown as so long ago is drawn anew this often, and at most each second when events come. */
const kTickMs = 10_000;

function tick(): void {
  const now_ms = Date.now();
  if (now_ms - store.state().now_ms >= 1000) store.dispatch({ type: 'clock/ticked', now_ms });
}

function applyTheme(settings: Settings): void {
  if (settings.theme === 'auto') delete document.documentElement.dataset['theme'];
  else document.documentElement.dataset['theme'] = settings.theme;
}

function startStream(): void {
  const startedLate = (): boolean =>
    Object.values(store.state().resources).some((resource) => resource.data !== undefined);
  const stream = new EventStream({
    url: '/api/v1/events',
    onState: (live) => store.dispatch({ type: 'live/changed', live }),
    onOpen: (resumed) => {
      // What was answered before the stream stood may have changed unheard; what failed can be asked again.
      const all = !resumed && startedLate();
      loader.invalidate((key) => {
        const known = store.state().resources[key];
        return all || known?.problem !== undefined || (key === '/metrics' && known?.data !== undefined);
      });
      streamOpened();
    },
    onMessage: (message) => {
      const event = JSON.parse(message.data) as LiveEvent;
      tick();
      loader.invalidate((key) => touches(event, key));
    },
  });
  stream.start();
  window.addEventListener('online', () => stream.retryNow());
}

/** Links inside the dashboard change the view, not the page. */
function listenToLinks(): void {
  window.addEventListener('popstate', () => setLocation(window.location.href));
  document.addEventListener('click', (event) => {
    if (
      event.defaultPrevented ||
      event.button !== 0 ||
      event.ctrlKey ||
      event.metaKey ||
      event.shiftKey ||
      event.altKey
    )
      return;
    const link = (event.target as Element | null)?.closest('a');
    if (!link || link.target !== '' || link.hasAttribute('download') || link.origin !== window.location.origin) return;
    if (link.hash !== '' && link.pathname === window.location.pathname) return;
    if (isOutside(link.pathname)) return;
    event.preventDefault();
    navigate(link.pathname + link.search);
  });
}

const isOutside = (path: string): boolean => /^\/(api\/|openapi\.json|metrics|healthz|readyz)/.test(path);

export function navigate(href: string, options: { replace?: boolean } = {}): void {
  const samePath = parseLocation(href).path === store.state().location.path;
  if (options.replace) history.replaceState(null, '', href);
  else history.pushState(null, '', href);
  setLocation(href);
  if (!samePath) window.scrollTo(0, 0);
}

/** Changes parameters of the view's link; undefined takes one away. */
export function setQuery(
  change: Readonly<Record<string, string | undefined>>,
  options: { replace?: boolean } = {},
): void {
  const { path, query } = store.state().location;
  navigate(linkTo(path, { ...query, ...change }), options);
}

function setLocation(href: string): void {
  store.dispatch({ type: 'location/changed', location: parseLocation(href) });
}

let toastId = 0;
const kToastMs = 6_000;

export function showToast(tone: Toast['tone'], text: string): void {
  const id = ++toastId;
  store.dispatch({ type: 'toast/shown', toast: { id, tone, text } });
  setTimeout(() => store.dispatch({ type: 'toast/closed', id }), kToastMs);
}

export const showProblem = (problem: Problem): void => showToast('bad', `${problem.title}. ${problem.message}`);

/** A part of the state; the component is drawn again when that part is another one. */
export function useSelect<T>(select: (state: State) => T): T {
  const [, redraw] = useReducer((turn: number) => turn + 1, 0);
  const value = select(store.state());
  const shown = useRef({ select, value });
  shown.current = { select, value };
  useLayoutEffect(() => {
    const compare = (): void => {
      if (!Object.is(shown.current.select(store.state()), shown.current.value)) redraw(undefined);
    };
    compare();
    return store.subscribe(compare);
  }, []);
  return value;
}

const kNothing: Resource = { loading: true, stale: false };

/** What is found at an address, kept up to date as long as the component is there. Without an address nothing is asked. */
export function useResource<T>(from: Address<T> | undefined): Resource<T> {
  useEffect(() => (from === undefined ? undefined : loader.use(from)), [from]);
  return useSelect((state) => (from === undefined ? kNothing : (state.resources[from] ?? kNothing))) as Resource<T>;
}

/** The same for several addresses, whose number may change. */
export function useResources<T>(from: readonly Address<T>[]): readonly Resource<T>[] {
  useEffect(() => {
    const ends = from.map((each) => loader.use(each));
    return () => ends.forEach((end) => end());
  }, [from.join('\n')]);
  const known = useSelect((state) => state.resources);
  return from.map((each) => (known[each] ?? kNothing) as Resource<T>);
}

/** The keys that a view understands while it is there: from the moment it can be seen, not from the next frame on. */
export function useKeys(bindings: readonly KeyBinding[]): void {
  const current = useRef(bindings);
  current.current = bindings;
  useLayoutEffect(() => addKeys(() => current.current), []);
}
