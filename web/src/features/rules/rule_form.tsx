// Every field of a rule, with what it says in a sentence.

import './rules.css';
import { type ComponentChildren } from 'preact';
import { useState } from 'preact/hooks';
import { useZone } from '../../app/sites';
import { type Schema } from '../../lib/api';
import { type Problem } from '../../lib/problem';
import { CheckField, FormProblem, NumberField, SelectField, TextField } from '../../ui/form';
import { bodyOf, faultsOf, type RuleDraft } from './draft';
import { ruleSentence } from './rule_words';
import { ScheduleField } from './schedule_field';

export interface RuleFormProps {
  site: string;
  zones: readonly Schema<'Zone'>[];
  draft: RuleDraft;
  onDraft: (draft: RuleDraft) => void;
  problem: Problem | undefined;
  saving: boolean;
  actions?: ComponentChildren;
  notice?: ComponentChildren;
  onSave: (body: Schema<'NewRule'>) => void;
}

const kSeverities: readonly { readonly value: Schema<'Severity'>; readonly words: string }[] = [
  { value: 'info', words: 'info: worth noting' },
  { value: 'advisory', words: 'advisory: have a look' },
  { value: 'warning', words: 'warning: act soon' },
  { value: 'critical', words: 'critical: act now' },
];

const kShown = [
  'name',
  'zone',
  'kinds',
  'min_points',
  'min_volume_m3',
  'min_extent_m',
  'persistence.scans',
  'persistence.of',
  'persistence.seconds',
  'severity',
];

type Errors = (field: string) => string | undefined;
interface PartProps {
  draft: RuleDraft;
  set: (change: Partial<RuleDraft>) => void;
  error: Errors;
}

export function RuleForm(props: RuleFormProps) {
  const { draft, site, zones } = props;
  const time_zone = useZone(site);
  const [tried, setTried] = useState(false);
  const faults = faultsOf(draft);
  const error: Errors = (field) => (tried ? faults[field] : undefined) ?? props.problem?.about(field);
  const set = (change: Partial<RuleDraft>): void => props.onDraft({ ...draft, ...change });
  const zone = zones.find(({ id }) => String(id) === draft.zone);
  return (
    <form
      class="panel panel-body rule-form"
      noValidate
      onSubmit={(event) => {
        event.preventDefault();
        setTried(true);
        if (Object.keys(faults).length === 0) props.onSave(bodyOf(draft, site));
      }}
    >
      {props.notice}
      <p class="rule-sentence">{ruleSentence(bodyOf(draft, site), zone?.name)}</p>
      <TextField label="Name" value={draft.name} error={error('name')} onValue={(name) => set({ name })} />
      <div class="field-pair">
        <SelectField
          label="Severity"
          value={draft.severity}
          options={kSeverities}
          error={error('severity')}
          onValue={(severity) => set({ severity })}
        />
        <SelectField
          label="Where"
          value={draft.zone}
          options={[
            { value: '', words: 'anywhere in the site' },
            ...zones.map(({ id, name, kind }) => ({ value: String(id), words: `${name} (${kind} zone)` })),
          ]}
          error={error('zone')}
          onValue={(value) => set({ zone: value })}
        />
      </div>
      <KindsAndSize draft={draft} set={set} error={error} />
      <Lasting draft={draft} set={set} error={error} />
      <ScheduleField
        schedule={draft.schedule}
        time_zone={time_zone}
        error={error}
        onSchedule={(schedule) => set({ schedule })}
      />
      <fieldset class="form-part">
        <legend>How it acts</legend>
        <CheckField label="In force" checked={draft.enabled} onChecked={(enabled) => set({ enabled })} />
        <CheckField
          label="Its alerts resolve by themselves when the change is gone"
          checked={draft.auto_resolve}
          onChecked={(auto_resolve) => set({ auto_resolve })}
        />
      </fieldset>
      <FormProblem problem={props.problem} shown={kShown} />
      <div class="actions">
        <button type="submit" class="primary" disabled={props.saving}>
          Save
        </button>
        {props.actions}
      </div>
    </form>
  );
}

function KindsAndSize({ draft, set, error }: PartProps) {
  return (
    <fieldset class="form-part">
      <legend>What</legend>
      <div class="actions">
        <CheckField
          label="added: free before, now occupied"
          checked={draft.added}
          onChecked={(added) => set({ added })}
        />
        <CheckField
          label="removed: occupied before, now free"
          checked={draft.removed}
          onChecked={(removed) => set({ removed })}
        />
      </div>
      {error('kinds') && <span class="field-bad">{error('kinds')}</span>}
      <div class="field-row">
        <NumberField
          label="At least"
          unit="points"
          min={0}
          step={1}
          placeholder="any"
          value={draft.min_points}
          error={error('min_points')}
          onValue={(min_points) => set({ min_points })}
        />
        <NumberField
          label="Its box at least"
          unit="m³"
          min={0}
          placeholder="any"
          value={draft.min_volume_m3}
          error={error('min_volume_m3')}
          onValue={(min_volume_m3) => set({ min_volume_m3 })}
        />
        <NumberField
          label="Longest side at least"
          unit="m"
          min={0}
          placeholder="any"
          value={draft.min_extent_m}
          error={error('min_extent_m')}
          onValue={(min_extent_m) => set({ min_extent_m })}
        />
      </div>
    </fieldset>
  );
}

function Lasting({ draft, set, error }: PartProps) {
  return (
    <fieldset class="form-part">
      <legend>How long</legend>
      <p class="field-hint">Only scans that could see the place count. What only passes by is not told.</p>
      <div class="field-row">
        <NumberField
          label="Seen in"
          unit="scans"
          min={1}
          max={64}
          step={1}
          value={draft.scans}
          error={error('persistence.scans')}
          onValue={(scans) => set({ scans })}
        />
        <NumberField
          label="of the last"
          unit="scans"
          min={1}
          max={64}
          step={1}
          value={draft.of}
          error={error('persistence.of')}
          onValue={(of) => set({ of })}
        />
        <NumberField
          label="for at least"
          unit="s"
          min={0}
          placeholder="0"
          value={draft.seconds}
          error={error('persistence.seconds')}
          onValue={(seconds) => set({ seconds })}
        />
      </div>
    </fieldset>
  );
}
