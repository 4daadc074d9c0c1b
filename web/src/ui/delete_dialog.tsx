// Asks before something is deleted for good.

import { type ComponentChildren } from 'preact';
import { Dialog } from './dialog';

export function DeleteDialog({
  what,
  onClose,
  onDelete,
  children,
}: {
  what: string;
  onClose: () => void;
  /** Undefined where it cannot be deleted; the children say why. */
  onDelete: (() => void) | undefined;
  children: ComponentChildren;
}) {
  return (
    <Dialog title={`Delete ${what}?`} onClose={onClose}>
      {children}
      <div class="actions">
        {onDelete && (
          <button type="button" class="primary" onClick={onDelete}>
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
