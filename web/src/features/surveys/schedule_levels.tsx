// The levels of a schedule's figures, which raise alerts.

import { type Errors, type PartProps, partOf } from '../../ui/edit_form';
import { FormPart, NumberField, SelectField } from '../../ui/form';
import { useVolumeZones, type Zone } from './data';
import { newThreshold, type ScheduleDraft, type ThresholdDraft } from './schedule_draft';
import { kFigureNames, kFigures, unitOf } from './words';

export function Levels({ site, draft, set, error }: PartProps<ScheduleDraft> & { site: string }) {
  const zones = useVolumeZones(site);
  const change = (index: number, next: ThresholdDraft | undefined): void =>
    set({ thresholds: draft.thresholds.flatMap((each, at) => (at !== index ? [each] : next ? [next] : [])) });
  return (
    <FormPart title="Levels that raise an alert">
      <p class="muted">
        By the size of a figure: yellow is an advisory, orange a warning, red critical. Rising raises the alert, falling
        lowers it, green resolves it.
      </p>
      {draft.thresholds.map((threshold, index) => (
        <OneThreshold
          key={index}
          number={index + 1}
          threshold={threshold}
          zones={zones}
          wrong={error(`survey.thresholds.${index}`)}
          error={(field) => error(`survey.thresholds.${index}.${field}`)}
          onChange={(next) => change(index, next)}
        />
      ))}
      <div class="actions">
        <button type="button" onClick={() => set({ thresholds: [...draft.thresholds, newThreshold] })}>
          Add levels
        </button>
      </div>
    </FormPart>
  );
}

function OneThreshold({
  number,
  threshold,
  zones,
  wrong,
  error,
  onChange,
}: {
  number: number;
  threshold: ThresholdDraft;
  zones: readonly Zone[];
  /** With all of it, rather than with one field. */
  wrong: string | undefined;
  error: Errors;
  onChange: (next: ThresholdDraft | undefined) => void;
}) {
  const { field } = partOf(threshold, error, (change) => onChange({ ...threshold, ...change }));
  const unit = unitOf(threshold.figure) === '%' ? '(0 to 1)' : unitOf(threshold.figure);
  return (
    <div class="schedule-threshold" role="group" aria-label={`Levels ${number}`}>
      <SelectField
        label="Figure"
        options={kFigureNames.map((figure) => ({ value: figure, words: kFigures[figure] }))}
        {...field('figure')}
      />
      <SelectField
        label="Of"
        options={[
          { value: '', words: 'the total' },
          ...zones.map(({ id, name }) => ({ value: String(id), words: name })),
        ]}
        {...field('zone')}
      />
      {(['yellow', 'orange', 'red'] as const).map((level) => (
        <NumberField
          key={level}
          label={`${level[0]!.toUpperCase()}${level.slice(1)} from`}
          unit={unit}
          min={0}
          placeholder="never"
          {...field(level)}
        />
      ))}
      <NumberField label="Rises after" unit="nights" min={1} step={1} {...field('raise_after')} />
      <NumberField label="Falls after" unit="nights" min={1} step={1} {...field('clear_after')} />
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
