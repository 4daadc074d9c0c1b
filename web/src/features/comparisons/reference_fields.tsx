// Which earlier scans stand for the state of the world.

import { useState } from 'preact/hooks';
import { TextField } from '../../ui/form';
import { type ComparePart } from './compare_form';
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

export function ReferenceFields(props: ComparePart & { site: string | undefined; zone: string }) {
  const { draft, error, set } = props;
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
              onChange={() => set({ kind })}
            />
            <span>
              {words} <span class="muted">– {help}</span>
            </span>
          </label>
          {kind === 'window' && draft.kind === kind && <Window {...props} />}
          {kind === 'scans' && draft.kind === kind && <Scans {...props} />}
        </div>
      ))}
      {error('reference') && <span class="field-bad">{error('reference')}</span>}
    </fieldset>
  );
}

function Window({ field, zone }: ComparePart & { zone: string }) {
  return (
    <div class="reference-more">
      {(['from', 'to'] as const).map((name) => (
        <TextField key={name} type="datetime-local" label={`${name} (${zone})`} {...field(name, `reference.${name}`)} />
      ))}
    </div>
  );
}

function Scans({ draft, set, field, site }: ComparePart & { site: string | undefined }) {
  const [picking, setPicking] = useState(false);
  const add = (id: number): void => {
    const known = scansIn(draft.scans) ?? [];
    if (!known.includes(id)) set({ scans: [...known, id].join(', ') });
    setPicking(false);
  };
  return (
    <div class="reference-more with-button">
      <TextField label="Numbers of scans" placeholder="3, 5" {...field('scans', 'reference.scans')} />
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
