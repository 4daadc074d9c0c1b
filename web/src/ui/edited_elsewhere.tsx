// Who edits does so from one version. When somebody else was faster, both stand beside each other, and nobody's work is
// lost unasked.

import { useState } from 'preact/hooks';
import { type Resource } from '../lib/resources';
import { Icon } from './icon';

export interface Version<T> {
  readonly data: T;
  readonly etag: string | undefined;
}

/** The version that an edit began with, and a newer one when there is one. `adopt` goes on from another. */
export function useVersion<T>(resource: Resource<T> & { readonly data: T }) {
  const [base, setBase] = useState<Version<T>>({ data: resource.data, etag: resource.etag });
  const newer: Version<T> | undefined =
    resource.etag !== base.etag ? { data: resource.data, etag: resource.etag } : undefined;
  return { base, newer, adopt: setBase };
}

/** One property in both versions, in words. */
export interface Difference {
  readonly name: string;
  readonly mine: string;
  readonly theirs: string;
}

export function EditedElsewhere({
  differences,
  onTake,
  onKeep,
}: {
  differences: readonly Difference[];
  onTake: () => void;
  onKeep: () => void;
}) {
  const differing = differences.filter(({ mine, theirs }) => mine !== theirs);
  return (
    <div class="notice notice-busy" role="alert">
      <Icon name="alert" />
      <div>
        <p>
          <b>Somebody else has changed this meanwhile.</b> Nothing of yours is saved yet.
        </p>
        {differing.length === 0 ? (
          <p>What is there now is the same as what you have here.</p>
        ) : (
          <table>
            <thead>
              <tr>
                <th scope="col">What differs</th>
                <th scope="col">There now</th>
                <th scope="col">Yours</th>
              </tr>
            </thead>
            <tbody>
              {differing.map(({ name, mine, theirs }) => (
                <tr key={name}>
                  <th scope="row">{name}</th>
                  <td>{theirs}</td>
                  <td>{mine}</td>
                </tr>
              ))}
            </tbody>
          </table>
        )}
        <div class="actions">
          <button type="button" onClick={onTake}>
            Take what is there now
          </button>
          <button type="button" onClick={onKeep}>
            Save mine over it
          </button>
        </div>
      </div>
    </div>
  );
}
