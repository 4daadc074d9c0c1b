// Who acts. Actions on alerts are kept with a name, which is asked for once.

import { useState } from 'preact/hooks';
import { Dialog } from '../ui/dialog';
import { Icon } from '../ui/icon';
import { store, useSelect } from './app';

let askAnywhere: ((then: (name: string) => void) => void) | undefined;

/** Calls `then` with the operator's name, which is asked for when it is not known yet. */
export function withOperator(then: (name: string) => void): void {
  const known = store.state().settings.operator;
  if (known !== '') then(known);
  else askAnywhere?.(then);
}

/** Shows who acts, and is where the name is asked for and changed. */
export function OperatorButton() {
  const operator = useSelect((state) => state.settings.operator);
  const [asking, setAsking] = useState<{ then: (name: string) => void } | undefined>();
  askAnywhere = (then) => setAsking({ then });
  return (
    <>
      <button type="button" class="quiet" onClick={() => setAsking({ then: () => undefined })}>
        <Icon name="person" />
        <span class="operator-name">{operator === '' ? 'Who are you?' : operator}</span>
      </button>
      {asking && (
        <OperatorDialog
          known={operator}
          onClose={() => setAsking(undefined)}
          onName={(name) => {
            store.dispatch({ type: 'settings/operator', operator: name });
            setAsking(undefined);
            asking.then(name);
          }}
        />
      )}
    </>
  );
}

function OperatorDialog({
  known,
  onName,
  onClose,
}: {
  known: string;
  onName: (name: string) => void;
  onClose: () => void;
}) {
  const [name, setName] = useState(known);
  return (
    <Dialog title="Who are you?" onClose={onClose}>
      <form
        onSubmit={(event) => {
          event.preventDefault();
          if (name.trim() !== '') onName(name.trim());
        }}
      >
        <label class="field">
          Your name
          <input
            data-first
            required
            maxLength={100}
            value={name}
            onInput={(event) => setName(event.currentTarget.value)}
          />
        </label>
        <p class="muted">
          What you do with alerts is kept with this name. It is asked for once and stays in this browser.
        </p>
        <div class="actions">
          <button type="submit" class="primary">
            That is me
          </button>
          <button type="button" onClick={onClose}>
            Cancel
          </button>
        </div>
      </form>
    </Dialog>
  );
}
