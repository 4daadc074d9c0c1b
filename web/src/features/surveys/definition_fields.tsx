// Where and how finely volumes are measured, of a schedule as of a survey by hand; and which epoch.

import { useResource } from '../../app/app';
import { linkTo } from '../../app/router';
import { useZone } from '../../app/sites';
import { address, type Schema } from '../../lib/api';
import { shortTime } from '../../lib/format';
import { type PartProps } from '../../ui/edit_form';
import { ChoicesField, FormPart, NumberField, SelectField } from '../../ui/form';
import { useVolumeZones } from './data';
import { type DefinitionDraft } from './definition_draft';

export function ZonesPart({ site, field }: Pick<PartProps<DefinitionDraft>, 'field'> & { site: string }) {
  const zones = useVolumeZones(site);
  return (
    <FormPart title="Where">
      {zones.length === 0 ? (
        <p class="muted">
          There is no zone of the kind “volume”: the whole site is surveyed.{' '}
          <a href={linkTo('/zones/new', { site })}>Draw one</a>
        </p>
      ) : (
        <ChoicesField
          label="Zones; none: all of the site"
          choices={zones.map(({ id, name }) => ({ value: id, words: name }))}
          {...field('zones', 'survey.zones')}
        />
      )}
    </FormPart>
  );
}

export function ModelFields({ field }: Pick<PartProps<DefinitionDraft>, 'field'>) {
  return (
    <div class="field-row">
      <NumberField label="Cells of the models" unit="m" min={0.02} max={100} {...field('cell_m', 'survey.cell_m')} />
      <NumberField
        label="Core points apart"
        unit="m"
        min={0.02}
        max={100}
        {...field('core_spacing_m', 'survey.core_spacing_m')}
      />
      <NumberField
        label="Density in place"
        unit="t/m³"
        min={0}
        placeholder="no masses"
        {...field('density', 'survey.density_t_per_m3')}
      />
      <NumberField
        label="Steepest ground"
        unit="°"
        min={1}
        max={89}
        placeholder="not assumed"
        {...field('greatest_slope_deg', 'survey.greatest_slope_deg')}
      />
    </div>
  );
}

export const epochsOf = (site: string) => address('/api/v1/epochs', { query: { site, limit: 200 } });

export function EpochField({
  site,
  ...field
}: {
  site: string;
  label: string;
  value: string;
  error: string | undefined;
  onValue: (epoch: string) => void;
}) {
  const zone = useZone(site);
  const epochs = useResource(epochsOf(site)).data?.items ?? [];
  const usable = epochs.filter(({ state, id }) => state !== 'refused' || String(id) === field.value);
  const words = ({ id, name, to, state }: Schema<'Epoch'>): string =>
    `${id}: ${name === '' ? shortTime(to, zone, Date.now()) : name}${state === 'usable' ? '' : `, ${state}`}`;
  return (
    <SelectField
      {...field}
      options={[
        { value: '', words: 'choose one' },
        ...usable.map((epoch) => ({ value: String(epoch.id), words: words(epoch) })),
      ]}
    />
  );
}
