// The table of views. To add a page: a component in src/features/NAME/, and one line here. A view that is heavy, or
// rarely opened, is loaded when it is first shown: `lazy(() => import(...))`. Where the link goes to another line with the
// same component, that component stays and gets other properties.

import { type ComponentType } from 'preact';
import { AlertsView } from '../features/alerts/alerts_view';
import { OverviewView } from '../features/overview/overview_view';
import { type IconName } from '../ui/icon';
import { matchPath } from './router';

/** What the placeholders of the view's pattern stand for: `/alerts/:id` gives `{id}`. */
export type ViewProps = Readonly<Record<string, string>>;

export interface View {
  readonly pattern: string;
  readonly title: string;
  readonly component: ComponentType<ViewProps>;
  /** Views without it are reached from others. */
  readonly menu?: { readonly icon: IconName; readonly key: string };
}

const view = (pattern: string, title: string, component: ComponentType<never>, menu?: View['menu']): View => ({
  pattern,
  title,
  component: component as ComponentType<ViewProps>,
  ...(menu ? { menu } : {}),
});

export const kViews: readonly View[] = [
  view('/', 'Overview', OverviewView, { icon: 'overview', key: 'o' }),
  view('/alerts', 'Alerts', AlertsView, { icon: 'alert', key: 'a' }),
  view('/alerts/:id', 'Alert', AlertsView),
];

/** The view that a path shows, with what its placeholders stand for. */
export function viewAt(path: string): { view: View | undefined; values: Record<string, string> } {
  for (const view of kViews) {
    const values = matchPath(view.pattern, path);
    if (values) return { view, values };
  }
  return { view: undefined, values: {} };
}
