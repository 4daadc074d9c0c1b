// Every field of a rule, with what it says in a sentence.

import './rules.css';
import { useZone } from '../../app/sites';
import { type Schema } from '../../lib/api';
import { EditForm, type EditFormProps, type PartProps } from '../../ui/edit_form';
import { CheckField, FormPart, NumberField, SelectField, TextField } from '../../ui/form';
import { bodyOf, faultsOf, type RuleDraft } from './draft';
import { ruleSentence } from './rule_words';
import { ScheduleField } from './schedule_field';

const kSeverities: readonly { readonly value: Schema<'Severity'>; readonly words: string }[] = [
  { value: 'info', words: 'info: worth noting' },
  { value: 'advisory', words: 'advisory: have a look' },
  { value: 'warning', words: 'warning: act soon' },
  { value: 'critical', words: 'critical: act now' },
];

export interface RuleFormProps extends EditFormProps<RuleDraft> {
  site: string;
  zones: readonly Schema<'Zone'>[];
}

export function RuleForm({ site, zones, ...form }: RuleFormProps) {
  const { draft } = form;
  const time_zone = useZone(site);
  const zone = zones.find(({ id }) => String(id) === draft.zone);
  return (
    <EditForm {...form} class="panel panel-body rule-form" faults={faultsOf(draft)}>
      {(part) => (
        <>
          <p class="rule-sentence">{ruleSentence(bodyOf(draft, site), zone?.name)}</p>
          <TextField label="Name" {...part.field('name')} />
          <div class="field-pair">
            <SelectField label="Severity" options={kSeverities} {...part.field('severity')} />
            <SelectField
              label="Where"
              options={[
                { value: '', words: 'anywhere in the site' },
                ...zones.map(({ id, name, kind }) => ({ value: String(id), words: `${name} (${kind} zone)` })),
              ]}
              {...part.field('zone')}
            />
          </div>
          <KindsAndSize {...part} />
          <Lasting {...part} />
          <ScheduleField
            schedule={draft.schedule}
            time_zone={time_zone}
            error={part.error}
            onSchedule={(schedule) => part.set({ schedule })}
          />
          <FormPart title="How it acts">
            <CheckField label="In force" {...part.field('enabled')} />
            <CheckField
              label="Its alerts resolve by themselves when the change is gone"
              {...part.field('auto_resolve')}
            />
          </FormPart>
        </>
      )}
    </EditForm>
  );
}

function KindsAndSize({ field, error }: PartProps<RuleDraft>) {
  return (
    <FormPart title="What">
      <div class="actions">
        <CheckField label="added: free before, now occupied" {...field('added')} />
        <CheckField label="removed: occupied before, now free" {...field('removed')} />
      </div>
      {error('kinds') && <span class="field-bad">{error('kinds')}</span>}
      <div class="field-row">
        <NumberField label="At least" unit="points" min={0} step={1} placeholder="any" {...field('min_points')} />
        <NumberField label="Its box at least" unit="m³" min={0} placeholder="any" {...field('min_volume_m3')} />
        <NumberField label="Longest side at least" unit="m" min={0} placeholder="any" {...field('min_extent_m')} />
      </div>
    </FormPart>
  );
}

function Lasting({ field }: PartProps<RuleDraft>) {
  return (
    <FormPart title="How long">
      <p class="field-hint">Only scans that could see the place count. What only passes by is not told.</p>
      <div class="field-row">
        <NumberField label="Seen in" unit="scans" min={1} max={64} step={1} {...field('scans', 'persistence.scans')} />
        <NumberField label="of the last" unit="scans" min={1} max={64} step={1} {...field('of', 'persistence.of')} />
        <NumberField
          label="for at least"
          unit="s"
          min={0}
          placeholder="0"
          {...field('seconds', 'persistence.seconds')}
        />
      </div>
    </FormPart>
  );
}
