// Every field of a schedule: when, what to compare with, where, how exact, and which levels raise an alert.

import { type ComponentChildren } from 'preact';
import { useState } from 'preact/hooks';
import { useResource } from '../../app/app';
import { linkTo } from '../../app/router';
import { useZone } from '../../app/sites';
import { address } from '../../lib/api';
import { shortTime } from '../../lib/format';
import { type Problem } from '../../lib/problem';
import { CheckField, FormProblem, NumberField, SelectField, TextField } from '../../ui/form';
import { cronInWords } from './cron_words';
import { type Schedule, useVolumeZones, type Zone } from './data';
import { faultsOf, type ScheduleDraft } from './schedule_draft';
import { type Errors, Levels, type PartProps } from './schedule_levels';

export interface ScheduleFormProps {
  site: string;
  draft: ScheduleDraft;
  onDraft: (draft: ScheduleDraft) => void;
  problem: Problem | undefined;
  saving: boolean;
  onSave: () => void;
  actions?: ComponentChildren;
  notice?: ComponentChildren;
}

const kShown = [
  'name',
  'cron',
  'time_zone',
  'window_s',
  'grace_s',
  'required_sensors',
  'catch_up',
  'survey.zones',
  'survey.cell_m',
  'survey.core_spacing_m',
  'survey.density_t_per_m3',
  'survey.greatest_slope_deg',
  'survey.reference.epoch',
  'survey.reference.days',
  'survey.tolerance.residual_m',
  'survey.tolerance.position_m',
  'survey.tolerance.angle_deg',
];

export function ScheduleForm(props: ScheduleFormProps) {
  const { draft, site } = props;
  const [tried, setTried] = useState(false);
  const zones = useVolumeZones(site);
  const faults = faultsOf(draft);
  const error: Errors = (field) => (tried ? faults[field] : undefined) ?? props.problem?.about(field);
  const part: PartProps = { site, draft, error, set: (change) => props.onDraft({ ...draft, ...change }) };
  const ofThresholds =
    props.problem?.fields.map(({ field }) => field).filter((field) => /thresholds/.test(field)) ?? [];
  return (
    <form
      class="panel panel-body schedule-form"
      noValidate
      onSubmit={(event) => {
        event.preventDefault();
        setTried(true);
        if (Object.keys(faults).length === 0) props.onSave();
      }}
    >
      {props.notice}
      <When {...part} />
      <CompareWith {...part} />
      <Where {...part} zones={zones} />
      <Exactness {...part} />
      <Levels {...part} zones={zones} problem={props.problem} />
      <FormProblem problem={props.problem} shown={[...kShown, ...ofThresholds]} />
      <div class="actions">
        <button type="submit" class="primary" disabled={props.saving}>
          Save
        </button>
        {props.actions}
      </div>
    </form>
  );
}

const kCatchUp: readonly { readonly value: Schedule['catch_up']; readonly words: string }[] = [
  { value: 'latest', words: 'the latest is caught up' },
  { value: 'all', words: 'each is caught up' },
  { value: 'skip', words: 'they are skipped' },
];

function When({ site, draft, set, error }: PartProps) {
  const zone = useZone(site);
  const sensors =
    useResource(address('/api/v1/sensors', { query: { limit: 1000 } })).data?.items.filter(
      (sensor) => sensor.site === site,
    ) ?? [];
  const words = cronInWords(draft.cron);
  const clock = draft.time_zone.trim() === '' ? zone : draft.time_zone;
  return (
    <fieldset class="form-part">
      <legend>When</legend>
      <TextField label="Name" value={draft.name} error={error('name')} onValue={(name) => set({ name })} />
      <div class="field-pair">
        <TextField
          label="Time (cron)"
          value={draft.cron}
          hint={words === undefined ? 'minute hour day month weekday, such as 30 5 * * *' : `${words} (${clock})`}
          error={error('cron')}
          onValue={(cron) => set({ cron })}
        />
        <TextField
          label="Time zone"
          placeholder={zone}
          hint="Empty: that of the site."
          value={draft.time_zone}
          error={error('time_zone')}
          onValue={(time_zone) => set({ time_zone })}
        />
      </div>
      <div class="field-row">
        <NumberField
          label="Scans of the last"
          unit="h"
          min={0}
          hint="make its epoch"
          value={draft.window_h}
          error={error('window_s')}
          onValue={(window_h) => set({ window_h })}
        />
        <NumberField
          label="Begins later by"
          unit="min"
          min={0}
          hint="as scans may come late"
          value={draft.grace_min}
          error={error('grace_s')}
          onValue={(grace_min) => set({ grace_min })}
        />
        <SelectField
          label="Of runs that were missed"
          value={draft.catch_up}
          options={kCatchUp}
          error={error('catch_up')}
          onValue={(catch_up) => set({ catch_up })}
        />
      </div>
      {sensors.length > 0 && (
        <Choices
          label="A night without a scan of these counts as missed"
          error={error('required_sensors')}
          choices={sensors.map(({ name }) => ({ value: name, words: name }))}
          chosen={draft.required_sensors}
          onChosen={(required_sensors) => set({ required_sensors })}
        />
      )}
      <CheckField label="On: it runs at its times" checked={draft.enabled} onChecked={(enabled) => set({ enabled })} />
    </fieldset>
  );
}

function Choices<Value extends string | number>({
  label,
  error,
  choices,
  chosen,
  onChosen,
}: {
  label: string;
  error: string | undefined;
  choices: readonly { readonly value: Value; readonly words: string }[];
  chosen: readonly Value[];
  onChosen: (chosen: Value[]) => void;
}) {
  return (
    <div class="field" role="group" aria-label={label}>
      <span>{label}</span>
      <div class="actions">
        {choices.map(({ value, words }) => (
          <CheckField
            key={value}
            label={words}
            checked={chosen.includes(value)}
            onChecked={(checked) => onChosen(checked ? [...chosen, value] : chosen.filter((each) => each !== value))}
          />
        ))}
      </div>
      {error && <span class="field-bad">{error}</span>}
    </div>
  );
}

const kPolicies: readonly { readonly value: ScheduleDraft['policy']; readonly words: string }[] = [
  { value: 'previous', words: 'the night before' },
  { value: 'accepted', words: 'the latest state that somebody accepted' },
  { value: 'days_ago', words: 'the same time some days ago' },
  { value: 'fixed', words: 'one epoch' },
];

function CompareWith({ site, draft, set, error }: PartProps) {
  const zone = useZone(site);
  const epochs = useResource(address('/api/v1/epochs', { query: { site, limit: 200 } })).data?.items ?? [];
  const usable = epochs.filter(({ state, id }) => state !== 'refused' || String(id) === draft.epoch);
  return (
    <fieldset class="form-part">
      <legend>Compared with</legend>
      <div class="field-pair">
        <SelectField label="What" value={draft.policy} options={kPolicies} onValue={(policy) => set({ policy })} />
        {draft.policy === 'days_ago' && (
          <NumberField
            label="How many"
            unit="days"
            min={1}
            step={1}
            value={draft.days}
            error={error('survey.reference.days')}
            onValue={(days) => set({ days })}
          />
        )}
        {draft.policy === 'fixed' && (
          <SelectField
            label="Epoch"
            value={draft.epoch}
            options={[
              { value: '', words: 'choose one' },
              ...usable.map(({ id, name, to }) => ({
                value: String(id),
                words: `${id}: ${name === '' ? shortTime(to, zone, Date.now()) : name}`,
              })),
            ]}
            error={error('survey.reference.epoch')}
            onValue={(epoch) => set({ epoch })}
          />
        )}
      </div>
    </fieldset>
  );
}

function Where({ site, draft, set, error, zones }: PartProps & { zones: readonly Zone[] }) {
  return (
    <fieldset class="form-part">
      <legend>Where</legend>
      {zones.length === 0 ? (
        <p class="muted">
          There is no zone of the kind “volume”: the whole site is surveyed.{' '}
          <a href={linkTo('/zones/new', { site })}>Draw one</a>
        </p>
      ) : (
        <Choices
          label="Zones; none: all of the site"
          error={error('survey.zones')}
          choices={zones.map(({ id, name }) => ({ value: id, words: name }))}
          chosen={draft.zones}
          onChosen={(chosen) => set({ zones: chosen })}
        />
      )}
    </fieldset>
  );
}

function Exactness({ draft, set, error }: PartProps) {
  return (
    <fieldset class="form-part">
      <legend>How exact</legend>
      <div class="field-row">
        <NumberField
          label="Cells of the models"
          unit="m"
          min={0.02}
          max={100}
          value={draft.cell_m}
          error={error('survey.cell_m')}
          onValue={(cell_m) => set({ cell_m })}
        />
        <NumberField
          label="Core points apart"
          unit="m"
          min={0.02}
          max={100}
          value={draft.core_spacing_m}
          error={error('survey.core_spacing_m')}
          onValue={(core_spacing_m) => set({ core_spacing_m })}
        />
        <NumberField
          label="Density in place"
          unit="t/m³"
          min={0}
          placeholder="no masses"
          value={draft.density}
          error={error('survey.density_t_per_m3')}
          onValue={(density) => set({ density })}
        />
        <NumberField
          label="Steepest ground"
          unit="°"
          min={1}
          max={89}
          placeholder="not assumed"
          value={draft.greatest_slope_deg}
          error={error('survey.greatest_slope_deg')}
          onValue={(greatest_slope_deg) => set({ greatest_slope_deg })}
        />
      </div>
      <p class="muted">A night whose scans fit worse than this is refused:</p>
      <div class="field-row">
        <NumberField
          label="Residual"
          unit="mm"
          min={0}
          value={draft.residual_mm}
          error={error('survey.tolerance.residual_m')}
          onValue={(residual_mm) => set({ residual_mm })}
        />
        <NumberField
          label="Position uncertain by"
          unit="mm"
          min={0}
          value={draft.position_mm}
          error={error('survey.tolerance.position_m')}
          onValue={(position_mm) => set({ position_mm })}
        />
        <NumberField
          label="Angle uncertain by"
          unit="°"
          min={0}
          value={draft.angle_deg}
          error={error('survey.tolerance.angle_deg')}
          onValue={(angle_deg) => set({ angle_deg })}
        />
      </div>
    </fieldset>
  );
}
