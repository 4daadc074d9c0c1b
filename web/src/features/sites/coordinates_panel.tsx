// In which coordinates the files of a site's surveys go out: its own, those of an EPSG code, or a grid of the mine.

import { loader, showToast } from '../../app/app';
import { kSites, siteAt } from '../../app/sites';
import { type Schema, send } from '../../lib/api';
import { metres } from '../../lib/format';
import { type Resource } from '../../lib/resources';
import { EditForm, type PartProps, useEditing } from '../../ui/edit_form';
import { EditedElsewhere, useVersion, type Version } from '../../ui/edited_elsewhere';
import { FormPart, NumberField, SelectField, VectorField } from '../../ui/form';
import {
  bodyOf,
  type CoordinatesDraft,
  coordinatesInWords,
  differencesOf,
  draftOf,
  faultsOf,
  hundredAlongX,
  isSame,
} from './coordinates_draft';

type Site = Schema<'Site'>;

export function CoordinatesPanel({ resource }: { resource: Resource<Site> & { data: Site } }) {
  const { base, newer, adopt } = useVersion(resource);
  return (
    <section class="panel" aria-labelledby="coordinates">
      <header class="panel-head">
        <h2 id="coordinates">Coordinates of its results</h2>
        <span class="muted">now {coordinatesInWords(resource.data)}</span>
      </header>
      <CoordinatesForm
        key={JSON.stringify(base.data)}
        base={base}
        newer={newer && !isSame(newer.data, base.data) ? newer : undefined}
        latest={resource.etag}
        adopt={adopt}
      />
    </section>
  );
}

interface CoordinatesFormProps {
  base: Version<Site>;
  /** With other coordinates; other edits of the site are none of this form. */
  newer: Version<Site> | undefined;
  latest: string | undefined;
  adopt: (version: Version<Site>) => void;
}

function CoordinatesForm({ base, newer, latest, adopt }: CoordinatesFormProps) {
  const { name } = base.data;
  const { draft, run, form } = useEditing(() => draftOf(base.data));
  const save = (etag: string | undefined): void =>
    void run(
      async () => {
        const answer = await send('patch', '/api/v1/sites/{name}', { path: { name }, body: bodyOf(draft), etag });
        loader.put(siteAt(name), answer);
        loader.invalidate((key) => key === kSites);
        adopt(answer);
        showToast(
          'good',
          `Files of surveys of ${name} go out in other coordinates: ${coordinatesInWords(answer.data)}.`,
        );
      },
      () => loader.invalidate((key) => key === siteAt(name)),
    );
  return (
    <EditForm
      {...form}
      class="panel-body"
      faults={faultsOf(draft)}
      onSave={() => save(newer ? base.etag : latest)}
      notice={
        newer && (
          <EditedElsewhere
            differences={differencesOf(newer.data, bodyOf(draft))}
            onTake={() => adopt(newer)}
            onKeep={() => save(latest)}
          />
        )
      }
    >
      {(part) => (
        <>
          <SelectField
            label="Files of surveys go out in"
            options={[
              { value: 'own', words: 'the coordinates of the site' },
              { value: 'epsg', words: 'the coordinates of the site, which have an EPSG code' },
              { value: 'mine_grid', words: 'a local mine grid' },
            ]}
            {...part.field('kind')}
          />
          {draft.kind === 'epsg' && (
            <NumberField
              label="EPSG code"
              unit=""
              step={1}
              hint="Of a projection in metres, such as 28350 for GDA94 / MGA zone 50. With it GeoJSON is in WGS 84."
              {...part.field('epsg')}
            />
          )}
          {draft.kind === 'mine_grid' && <GridFields {...part} />}
        </>
      )}
    </EditForm>
  );
}

const kAxes = ['x (east)', 'y (north)', 'z (height)'];

function GridFields({ draft, field, error }: PartProps<CoordinatesDraft>) {
  const along = hundredAlongX(draft);
  return (
    <FormPart title="One place in both, and how they lie to each other">
      <VectorField
        label="A place in the site's coordinates"
        axes={kAxes}
        {...field('site_origin_m', 'mine_grid.site_origin_m')}
      />
      <VectorField
        label="The same place in the grid"
        axes={kAxes}
        {...field('grid_origin_m', 'mine_grid.grid_origin_m')}
      />
      <div class="field-pair">
        <NumberField
          label="The site's axes are turned by"
          unit="°"
          min={-360}
          max={360}
          hint="counter-clockwise, as seen in the grid"
          {...field('rotation_deg', 'mine_grid.rotation_deg')}
        />
        <NumberField
          label="Scale"
          unit=""
          min={0.9}
          max={1.1}
          hint="metres in the grid for 1 m of the site"
          {...field('scale', 'mine_grid.scale')}
        />
      </div>
      {error('mine_grid') && <span class="field-bad">{error('mine_grid')}</span>}
      <p class="muted">
        {along &&
          `100 m along the x of the site lead ${metres(along[0])} east and ${metres(along[1])} north in the grid. `}
        Volumes, areas and sizes stay as measured.
      </p>
    </FormPart>
  );
}
