// What surrounds every view: the way to the others, whether the page is live, who acts, and light or dark.

import { useEffect, useRef, useState } from 'preact/hooks';
import { currentKeys } from '../lib/keys';
import { Dialog } from '../ui/dialog';
import { Icon } from '../ui/icon';
import { EmptyState } from '../ui/states';
import { navigate, store, useKeys, useResource, useSelect } from './app';
import { kOpenAlerts } from './alert_count';
import icon from './icon.svg';
import { LiveIndicator } from './live_indicator';
import { kMenu } from './menu';
import { OperatorButton } from './operator';
import { type Theme } from './settings';
import { type View, viewAt } from './views';

export function Shell() {
  const path = useSelect((state) => state.location.path);
  const [menuOpen, setMenuOpen] = useState(false);
  const [helpOpen, setHelpOpen] = useState(false);
  const { view, values } = viewAt(path);
  useFocusOnNewView(path);
  useTitle(view);
  useEffect(() => setMenuOpen(false), [path]);
  useKeys([
    { key: '?', does: 'show these keys', run: () => setHelpOpen(true) },
    ...kMenu
      .flatMap(({ entries }) => entries)
      .flatMap((entry, index) =>
        index < 9 ? [{ key: String(index + 1), does: `go to ${entry.title}`, run: () => navigate(entry.pattern) }] : [],
      ),
  ]);
  const Component = view?.component;
  return (
    <>
      <a class="skip-link" href="#content">
        Skip to the content
      </a>
      <div class="shell">
        <header class="topbar">
          <button
            type="button"
            class="quiet menu-button"
            aria-expanded={menuOpen}
            aria-controls="menu"
            onClick={() => setMenuOpen(!menuOpen)}
          >
            <Icon name="menu" />
            <span class="visually-hidden">Menu</span>
          </button>
          <a class="brand" href="/">
            <img src={icon} alt="" width="24" height="24" /> raywatch
          </a>
          <LiveIndicator />
          <span class="spacer" />
          <OperatorButton />
          <ThemeSwitch />
          <button type="button" class="quiet not-narrow" onClick={() => setHelpOpen(true)} aria-label="Keys">
            <Icon name="help" />
          </button>
        </header>
        <Menu path={path} open={menuOpen} />
        <main id="content" tabIndex={-1}>
          {Component ? (
            <Component {...values} />
          ) : (
            <EmptyState title="There is no such view.">
              <a href="/">Go to the overview</a>
            </EmptyState>
          )}
        </main>
      </div>
      <Toasts />
      {helpOpen && <KeyHelp onClose={() => setHelpOpen(false)} />}
    </>
  );
}

/** Whoever hears the page is told of the new view by its heading's place; the first view leaves the focus where it is. */
function useFocusOnNewView(path: string): void {
  const first = useRef(true);
  useEffect(() => {
    if (!first.current) document.getElementById('content')?.focus({ preventScroll: true });
    first.current = false;
  }, [path]);
}

/** How many alerts are open, in words: "12", or "200+" where the first page of them is not all. */
function useOpenAlerts(): string {
  const page = useResource(kOpenAlerts).data;
  return page && page.items.length > 0 ? `${page.items.length}${page.next === null ? '' : '+'}` : '';
}

function useTitle(view: View | undefined): void {
  const open = useOpenAlerts();
  useEffect(() => {
    document.title = `${open !== '' ? `(${open}) ` : ''}${view?.title ?? 'Not found'} – raywatch`;
  }, [open, view]);
}

function Menu({ path, open }: { path: string; open: boolean }) {
  return (
    <nav id="menu" class={open ? 'menu menu-open' : 'menu'} aria-label="Views">
      <div class="menu-groups">
        {kMenu.map(({ title, entries }) => (
          <section key={title} class="menu-group" aria-label={title}>
            <p aria-hidden="true">{title}</p>
            <ul>
              {entries.map((entry) => (
                <MenuEntry key={entry.pattern} entry={entry} path={path} />
              ))}
            </ul>
          </section>
        ))}
      </div>
    </nav>
  );
}

function MenuEntry({ entry, path }: { entry: View; path: string }) {
  const alerts = useOpenAlerts();
  const isHere = entry.pattern === '/' ? path === '/' : path === entry.pattern || path.startsWith(`${entry.pattern}/`);
  return (
    <li>
      <a href={entry.pattern} aria-current={isHere ? 'page' : undefined}>
        <Icon name={entry.menu?.icon ?? 'next'} />
        {entry.title}
        {entry.pattern === '/alerts' && alerts !== '' && (
          <span class="count" title={`${alerts} open`}>
            {alerts}
            <span class="visually-hidden"> open</span>
          </span>
        )}
      </a>
    </li>
  );
}

const kNextTheme: Record<Theme, Theme> = { auto: 'dark', dark: 'light', light: 'auto' };

function ThemeSwitch() {
  const theme = useSelect((state) => state.settings.theme);
  const words = { auto: 'as the system', dark: 'dark', light: 'light' }[theme];
  return (
    <button
      type="button"
      class="quiet"
      title={`Colours: ${words}`}
      aria-label={`Colours: ${theme} (${words})`}
      onClick={() => store.dispatch({ type: 'settings/theme', theme: kNextTheme[theme] })}
    >
      <Icon name="theme" />
      <span class="not-narrow theme-word">{theme}</span>
    </button>
  );
}

function Toasts() {
  const toasts = useSelect((state) => state.toasts);
  return (
    <div class="toasts" role="status" aria-live="polite">
      {toasts.map((toast) => (
        <div key={toast.id} class={`toast toast-${toast.tone}`}>
          <Icon name={toast.tone === 'bad' ? 'alert' : 'check'} />
          <span>{toast.text}</span>
          <button
            type="button"
            class="quiet"
            aria-label="Close"
            onClick={() => store.dispatch({ type: 'toast/closed', id: toast.id })}
          >
            <Icon name="close" />
          </button>
        </div>
      ))}
    </div>
  );
}

function KeyHelp({ onClose }: { onClose: () => void }) {
  return (
    <Dialog title="Keys" onClose={onClose}>
      <dl class="key-help">
        {currentKeys().map((binding) => (
          <div key={binding.key}>
            <dt>
              <kbd class="key">{binding.key}</kbd>
            </dt>
            <dd>{binding.does}</dd>
          </div>
        ))}
      </dl>
    </Dialog>
  );
}
