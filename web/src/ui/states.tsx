// What stands where there is nothing to show: still loading, nothing there, or something went wrong.

import { type ComponentChildren } from 'preact';
import { type Problem } from '../lib/problem';
import { type Resource } from '../lib/resources';
import { Icon } from './icon';

export function Loading({ what }: { what: string }) {
  return (
    <div class="placeholder" role="status">
      <span class="spinner" aria-hidden="true" />
      <p>Loading the {what} …</p>
    </div>
  );
}

export function EmptyState({ title, children }: { title: string; children?: ComponentChildren }) {
  return (
    <div class="placeholder">
      <p class="placeholder-title">{title}</p>
      {children}
    </div>
  );
}

/** The same as a panel of its own. */
export const EmptyPanel = (props: { title: string; children?: ComponentChildren }) => (
  <div class="panel">
    <EmptyState {...props} />
  </div>
);

/** What is said where a list has nothing, because of its filters or at all. */
export const noneOf = (what: string, filters: readonly (string | undefined)[]): string =>
  filters.some((filter) => filter !== undefined) ? `No ${what} is like this.` : `There is no ${what} yet.`;

export function ErrorState({ problem, retry }: { problem: Problem; retry?: () => void }) {
  return (
    <div class="placeholder placeholder-bad" role="alert">
      <Icon name="alert" />
      <p class="placeholder-title">{problem.title}</p>
      <p>{problem.message}</p>
      {problem.fields.length > 0 && (
        <ul>
          {problem.fields.map((entry) => (
            <li key={entry.field}>
              <code>{entry.field}</code> {entry.message}
            </li>
          ))}
        </ul>
      )}
      {retry && (
        <button type="button" onClick={retry}>
          Try again
        </button>
      )}
    </div>
  );
}

/** Shows what a resource holds; what was there stays while it is asked again, also when that fails. */
export function Loaded<T>({
  of,
  what,
  children,
}: {
  of: Resource<T>;
  what: string;
  children: (data: T) => ComponentChildren;
}) {
  if (of.data !== undefined) return <>{children(of.data)}</>;
  return of.problem ? <ErrorState problem={of.problem} /> : <Loading what={what} />;
}
