// Every field of a schedule: when, what to compare with, where, how exact, and which levels raise an alert.

import { useResource } from '../../app/app';
import { useZone } from '../../app/sites';
import { address } from '../../lib/api';
import { EditForm, type EditFormProps, type PartProps } from '../../ui/edit_form';
import { CheckField, ChoicesField, FormPart, NumberField, SelectField, TextField } from '../../ui/form';
import { cronInWords } from './cron_words';
import { type Schedule } from './data';
import { EpochField, ModelFields, ZonesPart } from './definition_fields';
import { faultsOf, type ScheduleDraft } from './schedule_draft';
import { Levels } from './schedule_levels';

export function ScheduleForm({ site, ...form }: EditFormProps<ScheduleDraft> & { site: string }) {
  return (
    <EditForm {...form} faults={faultsOf(form.draft)}>
      {(part) => (
        <>
          <When {...part} site={site} />
          <CompareWith {...part} site={site} />
          <ZonesPart {...part} site={site} />
          <Exactness {...part} />
          <Levels {...part} site={site} />
        </>
      )}
    </EditForm>
  );
}

type Part = PartProps<ScheduleDraft>;
type PartAtSite = Part & { readonly site: string };

const kCatchUp: readonly { readonly value: Schedule['catch_up']; readonly words: string }[] = [
  { value: 'latest', words: 'the latest is caught up' },
  { value: 'all', words: 'each is caught up' },
  { value: 'skip', words: 'they are skipped' },
];

function When({ site, draft, field }: PartAtSite) {
  const zone = useZone(site);
  const sensors =
    useResource(address('/api/v1/sensors', { query: { limit: 1000 } })).data?.items.filter(
      (sensor) => sensor.site === site,
    ) ?? [];
  const words = cronInWords(draft.cron);
  const clock = draft.time_zone.trim() === '' ? zone : draft.time_zone;
  return (
    <FormPart title="When">
      <TextField label="Name" {...field('name')} />
      <div class="field-pair">
        <TextField
          label="Time (cron)"
          hint={words === undefined ? 'minute hour day month weekday, such as 30 5 * * *' : `${words} (${clock})`}
          {...field('cron')}
        />
        <TextField label="Time zone" placeholder={zone} hint="Empty: that of the site." {...field('time_zone')} />
      </div>
      <div class="field-row">
        <NumberField
          label="Scans of the last"
          unit="h"
          min={0}
          hint="make its epoch"
          {...field('window_h', 'window_s')}
        />
        <NumberField
          label="Begins later by"
          unit="min"
          min={0}
          hint="as scans may come late"
          {...field('grace_min', 'grace_s')}
        />
        <SelectField label="Of runs that were missed" options={kCatchUp} {...field('catch_up')} />
      </div>
      {sensors.length > 0 && (
        <ChoicesField
          label="A night without a scan of these counts as missed"
          choices={sensors.map(({ name }) => ({ value: name, words: name }))}
          {...field('required_sensors')}
        />
      )}
      <CheckField label="On: it runs at its times" {...field('enabled')} />
    </FormPart>
  );
}

const kPolicies: readonly { readonly value: ScheduleDraft['policy']; readonly words: string }[] = [
  { value: 'previous', words: 'the night before' },
  { value: 'accepted', words: 'the latest state that somebody accepted' },
  { value: 'days_ago', words: 'the same time some days ago' },
  { value: 'fixed', words: 'one epoch' },
];

function CompareWith({ site, draft, field }: PartAtSite) {
  return (
    <FormPart title="Compared with">
      <div class="field-pair">
        <SelectField label="What" options={kPolicies} {...field('policy', 'survey.reference.policy')} />
        {draft.policy === 'days_ago' && (
          <NumberField label="How many" unit="days" min={1} step={1} {...field('days', 'survey.reference.days')} />
        )}
        {draft.policy === 'fixed' && (
          <EpochField label="Epoch" site={site} {...field('epoch', 'survey.reference.epoch')} />
        )}
      </div>
    </FormPart>
  );
}

function Exactness(part: Part) {
  const { field } = part;
  return (
    <FormPart title="How exact">
      <ModelFields {...part} />
      <p class="muted">A night whose scans fit worse than this is refused:</p>
      <div class="field-row">
        <NumberField label="Residual" unit="mm" min={0} {...field('residual_mm', 'survey.tolerance.residual_m')} />
        <NumberField
          label="Position uncertain by"
          unit="mm"
          min={0}
          {...field('position_mm', 'survey.tolerance.position_m')}
        />
        <NumberField
          label="Angle uncertain by"
          unit="°"
          min={0}
          {...field('angle_deg', 'survey.tolerance.angle_deg')}
        />
      </div>
    </FormPart>
  );
}
