// The levels of a schedule's figures, which raise alerts.

import { type Problem } from '../../lib/problem';
import { NumberField, SelectField } from '../../ui/form';
import { type Zone } from './data';
import { newThreshold, type ScheduleDraft, type ThresholdDraft } from './schedule_draft';
import { kFigureNames, kFigures, unitOf } from './words';

/** What is said about a field, by the daemon's name of it. */
export type Errors = (field: string) => string | undefined;

/** What each part of the form is given. */
export interface PartProps {
  site: string;
  draft: ScheduleDraft;
  set: (change: Partial<ScheduleDraft>) => void;
  error: Errors;
}

export function Levels(part: PartProps & { zones: readonly Zone[]; problem: Problem | undefined }) {
  const { draft, set, error, problem } = part;
  const change = (index: number, next: ThresholdDraft | undefined): void =>
    set({ thresholds: draft.thresholds.flatMap((each, at) => (at !== index ? [each] : next ? [next] : [])) });
  return (
    <fieldset class="form-part">
      <legend>Levels that raise an alert</legend>
      <p class="muted">
        By the size of a figure: yellow is an advisory, orange a warning, red critical. Rising raises the alert, falling
        lowers it, green resolves it.
      </p>
      {draft.thresholds.map((threshold, index) => {
        const field = `survey.thresholds.${index}`;
        const said = problem?.fields.filter((each) => each.field.startsWith(`${field}.`));
        const wrong = error(field) ?? said?.map((each) => `${each.field.slice(field.length + 1)} ${each.message}`)[0];
        return (
          <OneThreshold
            key={index}
            number={index + 1}
            threshold={threshold}
            zones={part.zones}
            wrong={wrong}
            onChange={(next) => change(index, next)}
          />
        );
      })}
      <div class="actions">
        <button type="button" onClick={() => set({ thresholds: [...draft.thresholds, newThreshold] })}>
          Add levels
        </button>
      </div>
    </fieldset>
  );
}

function OneThreshold({
  number,
  threshold,
  zones,
  wrong,
  onChange,
}: {
  number: number;
  threshold: ThresholdDraft;
  zones: readonly Zone[];
  wrong: string | undefined;
  onChange: (next: ThresholdDraft | undefined) => void;
}) {
  const set = (change: Partial<ThresholdDraft>): void => onChange({ ...threshold, ...change });
  const unit = unitOf(threshold.figure) === '%' ? '(0 to 1)' : unitOf(threshold.figure);
  return (
    <div class="schedule-threshold" role="group" aria-label={`Levels ${number}`}>
      <SelectField
        label="Figure"
        value={threshold.figure}
        options={kFigureNames.map((figure) => ({ value: figure, words: kFigures[figure] }))}
        onValue={(figure) => set({ figure })}
      />
      <SelectField
        label="Of"
        value={threshold.zone}
        options={[
          { value: '', words: 'the total' },
          ...zones.map(({ id, name }) => ({ value: String(id), words: name })),
        ]}
        onValue={(zone) => set({ zone })}
      />
      {(['yellow', 'orange', 'red'] as const).map((level) => (
        <NumberField
          key={level}
          label={`${level[0]!.toUpperCase()}${level.slice(1)} from`}
          unit={unit}
          min={0}
          placeholder="never"
          value={threshold[level]}
          onValue={(value) => set({ [level]: value })}
        />
      ))}
      <NumberField
        label="Rises after"
        unit="nights"
        min={1}
        step={1}
        value={threshold.raise_after}
        onValue={(raise_after) => set({ raise_after })}
      />
      <NumberField
        label="Falls after"
        unit="nights"
        min={1}
        step={1}
        value={threshold.clear_after}
        onValue={(clear_after) => set({ clear_after })}
      />
      <button type="button" aria-label={`Remove levels ${number}`} onClick={() => onChange(undefined)}>
        Remove
      </button>
      {wrong && (
        <span class="field-bad" role="alert">
          {wrong}
        </span>
      )}
    </div>
  );
}
