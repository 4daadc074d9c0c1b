import { type ComponentChildren } from 'preact';
import { viewAt } from '../app/views';

/** A link to a view, or plain words where this dashboard has no such view. */
export function ViewLink({ to, children }: { to: string; children: ComponentChildren }) {
  return viewAt(to.split('?')[0] ?? to).view ? <a href={to}>{children}</a> : <span>{children}</span>;
}
