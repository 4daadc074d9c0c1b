// How long an alert is put off.

import { useState } from 'preact/hooks';
import { useSelect } from '../../app/app';
import { useZone } from '../../app/sites';
import { counted, dateTime } from '../../lib/format';
import { localOf, momentOf, nextTimeOfDay } from '../../lib/zone';
import { Buttons, noteLabel } from '../../ui/confirm_dialog';
import { Dialog } from '../../ui/dialog';
import { NoteField } from '../../ui/form';

interface AskProps {
  /** How many alerts it is about, and their site when it is one. */
  number: number;
  site: string | undefined;
  /** What was typed already. */
  draft: string;
  onClose: () => void;
}

export function SnoozeDialog({
  number,
  site,
  draft,
  onClose,
  onSnooze,
}: AskProps & { onSnooze: (until: string, note: string) => void }) {
  const zone = useZone(site);
  const now_ms = useSelect((state) => state.now_ms);
  const [choice, setChoice] = useState(0);
  const [chosenEnd, setOwn] = useState<string | undefined>();
  const own = chosenEnd ?? localOf(new Date(now_ms + 3_600_000), zone);
  const [note, setNote] = useState(draft);
  const choices = [
    { words: 'for one hour', until: new Date(now_ms + 3_600_000) },
    { words: 'for eight hours', until: new Date(now_ms + 8 * 3_600_000) },
    { words: 'until the next morning', until: nextTimeOfDay('06:00', zone, now_ms) },
    { words: 'until', until: momentOf(own, zone) },
  ];
  return (
    <Dialog title={`Snooze ${counted(number, 'alert')}`} onClose={onClose}>
      <form
        onSubmit={(event) => {
          event.preventDefault();
          const until = choices[choice]?.until;
          if (until) onSnooze(until.toISOString(), note);
        }}
      >
        <fieldset class="choices">
          <legend class="visually-hidden">How long</legend>
          {choices.map(({ words, until }, index) => (
            <label key={words}>
              <input
                type="radio"
                data-first={index === 0 ? true : undefined}
                name="until"
                checked={choice === index}
                onChange={() => setChoice(index)}
              />
              {words}
              {index < choices.length - 1 ? (
                <span class="muted">{dateTime(until.toISOString(), zone)}</span>
              ) : (
                <>
                  <input
                    type="datetime-local"
                    aria-label={`Until, in ${zone}`}
                    value={own}
                    onFocus={() => setChoice(index)}
                    onInput={(event) => setOwn(event.currentTarget.value)}
                  />
                  <span class="muted">{zone}</span>
                </>
              )}
            </label>
          ))}
        </fieldset>
        <NoteField label={noteLabel()} value={note} onValue={setNote} />
        <Buttons doIt="Snooze" onClose={onClose} />
      </form>
    </Dialog>
  );
}
