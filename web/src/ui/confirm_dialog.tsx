// A question with a note: what is about to be done, and the word that does it.

import { useState } from 'preact/hooks';
import { Dialog } from './dialog';
import { NoteField } from './form';

export function ConfirmDialog({
  title,
  draft,
  words,
  about,
  doIt,
  doNot,
  onClose,
  onConfirm,
}: {
  title: string;
  draft: string;
  words: string;
  /** What the note is kept with. */
  about?: string;
  doIt: string;
  doNot?: string;
  onClose: () => void;
  onConfirm: (note: string) => void;
}) {
  const [note, setNote] = useState(draft);
  return (
    <Dialog title={title} onClose={onClose}>
      <form
        onSubmit={(event) => {
          event.preventDefault();
          onConfirm(note);
        }}
      >
        <p>{words}</p>
        <NoteField label={noteLabel(about)} value={note} onValue={setNote} />
        <Buttons doIt={doIt} doNot={doNot} first onClose={onClose} />
      </form>
    </Dialog>
  );
}

export const noteLabel = (about = 'the alert'): string => `Note (kept with ${about}; may be left empty)`;

export function Buttons({
  doIt,
  doNot = 'Cancel',
  first,
  onClose,
}: {
  doIt: string;
  doNot?: string | undefined;
  first?: boolean;
  onClose: () => void;
}) {
  return (
    <div class="actions">
      <button type="submit" class="primary" data-first={first}>
        {doIt}
      </button>
      <button type="button" onClick={onClose}>
        {doNot}
      </button>
    </div>
  );
}
