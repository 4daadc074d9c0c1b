// Which earlier scans stand for the state of the world.

import { useState } from 'preact/hooks';
import { FieldError, type PartProps } from './compare_form';
import { scansIn } from './parameters';
import { type ReferenceKind } from './request';
import { ScanPicker } from './scan_picker';

const kKinds: readonly { kind: ReferenceKind; words: string; help: string }[] = [
  {
    kind: 'previous',
    words: 'What was before',
    help: 'the latest earlier scan of each place that scans are taken from',
  },
  { kind: 'baseline', words: 'What is normal', help: 'the baseline of the site as it is now' },
  { kind: 'window', words: 'A time range', help: 'the latest scan of each such place within it' },
  { kind: 'scans', words: 'Named scans', help: 'exactly these, up to 255; they may be later ones, too' },
];

export function ReferenceFields(props: PartProps & { site: string | undefined; zone: string }) {
  const { draft, errors, onChange } = props;
  return (
    <fieldset class="panel-body compare-part">
      <legend class="visually-hidden">Reference</legend>
      {kKinds.map(({ kind, words, help }) => (
        <div key={kind} class="reference">
          <label>
            <input
              type="radio"
              name="reference"
              value={kind}
              checked={draft.kind === kind}
              onChange={() => onChange({ kind })}
            />
            <span>
              {words} <span class="muted">– {help}</span>
            </span>
          </label>
          {kind === 'window' && draft.kind === kind && <Window {...props} />}
          {kind === 'scans' && draft.kind === kind && <Scans {...props} />}
        </div>
      ))}
      <FieldError message={errors.get('reference')} />
    </fieldset>
  );
}

function Window({ draft, errors, onChange, zone }: PartProps & { zone: string }) {
  return (
    <div class="reference-more">
      {(['from', 'to'] as const).map((name) => {
        const error = errors.get(`reference.${name}`);
        return (
          <label key={name} class="field">
            {name} ({zone})
            <input
              type="datetime-local"
              value={draft[name]}
              aria-invalid={error !== undefined}
              onInput={(event) => onChange({ [name]: event.currentTarget.value })}
            />
            <FieldError message={error} />
          </label>
        );
      })}
    </div>
  );
}

function Scans({ draft, errors, onChange, site }: PartProps & { site: string | undefined }) {
  const [picking, setPicking] = useState(false);
  const error = errors.get('reference.scans');
  const add = (id: number): void => {
    const known = scansIn(draft.scans) ?? [];
    if (!known.includes(id)) onChange({ scans: [...known, id].join(', ') });
    setPicking(false);
  };
  return (
    <div class="reference-more with-button">
      <label class="field">
        Numbers of scans
        <input
          value={draft.scans}
          placeholder="3, 5"
          aria-invalid={error !== undefined}
          onInput={(event) => onChange({ scans: event.currentTarget.value })}
        />
        <FieldError message={error} />
      </label>
      <button type="button" onClick={() => setPicking(true)}>
        Add …
      </button>
      {picking && (
        <ScanPicker
          title="Compare with this scan, too"
          site={site}
          onClose={() => setPicking(false)}
          onPick={({ id }) => add(id)}
        />
      )}
    </div>
  );
}
