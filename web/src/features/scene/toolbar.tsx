// What can be done in a 3D view, and what its colours mean.

import { KeyHint } from '../../ui/key_hint';
import { count, counted } from '../../lib/format';
import { type Loading } from './use_layers';
import { type Look } from './scene_spec';

export interface ToolbarProps {
  onLook: (look: Look) => void;
  /** The looks that this scene has. */
  looks: readonly Look[];
  /** Undefined: there is nothing of the kind here. */
  swiped: boolean | undefined;
  rays: boolean | undefined;
  measures: boolean;
  onSwipe: () => void;
  onRays: () => void;
  onMeasure: () => void;
}

const kLookWords: Readonly<Record<Look, { words: string; key: string }>> = {
  frame: { words: 'Frame', key: 'f' },
  top: { words: 'Top', key: 't' },
  sensor: { words: 'Sensor', key: 'e' },
};
export const keyOfLook = (look: Look): string => kLookWords[look].key;

export function Toolbar(props: ToolbarProps) {
  const switches = [
    { words: 'Before / after', key: 'b', on: props.swiped, press: props.onSwipe },
    { words: 'Rays', key: 'y', on: props.rays, press: props.onRays },
    { words: 'Measure', key: 'm', on: props.measures, press: props.onMeasure },
  ];
  return (
    <div class="scene-toolbar" role="toolbar" aria-label="3D view">
      {props.looks.map((look) => (
        <button key={look} type="button" onClick={() => props.onLook(look)}>
          {kLookWords[look].words} <KeyHint keys={kLookWords[look].key} />
        </button>
      ))}
      <span class="scene-toolbar-gap" />
      {switches.map(
        ({ words, key, on, press }) =>
          on !== undefined && (
            <button key={key} type="button" aria-pressed={on} onClick={press}>
              {words} <KeyHint keys={key} />
            </button>
          ),
      )}
    </div>
  );
}

const kSigns = [
  { kind: 'added', words: 'added' },
  { kind: 'removed', words: 'removed' },
  { kind: 'discrepancy', words: 'discrepancy' },
  { kind: 'unchanged', words: 'as before' },
  { kind: 'unseen', words: 'not judged' },
] as const;

/** The colours and shapes of what is there. */
export function Legend({ kinds }: { kinds: readonly (typeof kSigns)[number]['kind'][] }) {
  return (
    <ul class="scene-legend" aria-label="Legend">
      {kSigns
        .filter(({ kind }) => kinds.includes(kind))
        .map(({ kind, words }) => (
          <li key={kind}>
            <span class={`scene-sign scene-sign-${kind}`} aria-hidden="true" /> {words}
          </li>
        ))}
    </ul>
  );
}

const kBudgets = [250_000, 1_000_000, 10_000_000] as const;

/** How many points are there, and how many shall be. */
export function Points({
  loading,
  budget,
  onBudget,
}: {
  loading: Loading;
  budget: number;
  onBudget: (budget: number) => void;
}) {
  const { loaded, total, waiting } = loading;
  return (
    <label class="scene-points">
      {waiting && loaded === 0
        ? 'Loading points …'
        : loaded < total
          ? `${count(loaded)} of ${counted(total, 'point')}`
          : counted(loaded, 'point')}
      <select value={budget} onChange={(event) => onBudget(Number(event.currentTarget.value))}>
        {kBudgets.map((choice) => (
          <option key={choice} value={choice}>
            {choice === kBudgets[2] ? 'all' : `up to ${count(choice)}`}
          </option>
        ))}
      </select>
    </label>
  );
}
