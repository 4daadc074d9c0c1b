// Asks before something is deleted for good.

import { type ComponentChildren } from 'preact';
import { attempt } from '../app/attempt';
import { Dialog } from './dialog';

/** Beside the button that saves. */
export const DeleteButton = ({ onAsk }: { onAsk: () => void }) => (
  <button type="button" onClick={onAsk}>
    Delete …
  </button>
);

export function DeleteDialog({
  what,
  onClose,
  onDelete,
  children,
}: {
  what: string;
  onClose: () => void;
  /** Undefined where it cannot be deleted; the children say why. */
  onDelete: (() => Promise<void>) | undefined;
  children: ComponentChildren;
}) {
  const remove = async (): Promise<void> => {
    if (onDelete && !(await attempt(onDelete))) onClose();
  };
  return (
    <Dialog title={`Delete ${what}?`} onClose={onClose}>
      {children}
      <div class="actions">
        {onDelete && (
          <button type="button" class="primary" onClick={() => void remove()}>
            Delete it
          </button>
        )}
        <button type="button" data-first onClick={onClose}>
          {onDelete ? 'Keep it' : 'Close'}
        </button>
      </div>
    </Dialog>
  );
}
