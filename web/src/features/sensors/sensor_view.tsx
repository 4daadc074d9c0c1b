// One sensor: what was given about it, what its scans showed of the rest, and the few figures that are set by hand.

import { loader, showToast, useResource } from '../../app/app';
import { address, type Schema, send } from '../../lib/api';
import { degrees, duration, metres, placeMetres } from '../../lib/format';
import { type Resource } from '../../lib/resources';
import { EditForm, useEditing } from '../../ui/edit_form';
import { NumberField } from '../../ui/form';
import { Loaded } from '../../ui/states';
import { Time } from '../../ui/time';
import { LatestPanorama } from '../panorama/scan_panorama';

type Sensor = Schema<'Sensor'>;

const addressOf = (name: string) => address('/api/v1/sensors/{name}', { path: { name } });

export function SensorView({ name }: { name: string }) {
  const sensor = useResource(addressOf(name));
  return (
    <Loaded of={sensor} what="sensor">
      {(data) => (
        <>
          <div class="view-head">
            <h1>{data.name}</h1>
            <span class="muted">
              at <a href={`/sites/${encodeURIComponent(data.site)}`}>{data.site}</a>, known since{' '}
              <Time at={data.created_at} site={data.site} />
            </span>
            <span class="spacer" />
            <a class="button" href={`/scans?sensor=${encodeURIComponent(data.name)}`}>
              Its scans
            </a>
          </div>
          <div class="panels">
            <Facts sensor={data} />
            <Edit key={sensor.etag} sensor={data} resource={sensor} />
            <LatestPanorama sensor={data.name} />
          </div>
        </>
      )}
    </Loaded>
  );
}

interface Fact {
  readonly name: string;
  readonly given: string | undefined;
  readonly estimated: string | undefined;
}

const said = <T,>(value: T | null | undefined, words: (value: T) => string): string | undefined =>
  value === null || value === undefined ? undefined : words(value);

function factsOf(sensor: Sensor): Fact[] {
  const fact = (
    name: string,
    words: (value: number) => string,
    key: 'min_range_m' | 'max_range_m' | 'range_noise_m' | 'no_return_m' | 'beam_divergence_mrad',
  ): Fact => ({ name, given: said(sensor[key], words), estimated: said(sensor.estimated[key], words) });
  const spacing = (pair: readonly number[]): string => pair.map((part) => degrees(part)).join(' × ');
  return [
    fact('Nearest usable range', metres, 'min_range_m'),
    fact('Farthest usable range', metres, 'max_range_m'),
    fact('Noise of the range', (value) => metres(value, 3), 'range_noise_m'),
    {
      name: 'Spacing of shots, azimuth × elevation',
      given: said(sensor.angular_resolution_deg, spacing),
      estimated: said(sensor.estimated.angular_resolution_deg, spacing),
    },
    fact('Beam divergence', (value) => `${value} mrad`, 'beam_divergence_mrad'),
    fact('Range that means no return', metres, 'no_return_m'),
    { name: 'A scan every', given: said(sensor.interval_s, duration), estimated: undefined },
    {
      name: 'Stands at',
      given: said(sensor.pose, (pose) => placeMetres(pose.position_m)),
      estimated: sensor.pose ? undefined : 'each scan says where',
    },
  ];
}

function Facts({ sensor }: { sensor: Sensor }) {
  return (
    <section class="panel" aria-labelledby="facts">
      <header class="panel-head">
        <h2 id="facts">What is known of it</h2>
      </header>
      <dl class="figures panel-body">
        {factsOf(sensor).map(({ name, given, estimated }) => (
          <div key={name}>
            <dt>{name}</dt>
            <dd>
              {given ?? (estimated ? <>{estimated}</> : <span class="muted">not known</span>)}
              {given === undefined && estimated !== undefined && name !== 'Stands at' && (
                <span class="muted"> (estimated)</span>
              )}
            </dd>
          </div>
        ))}
      </dl>
    </section>
  );
}

const kFields = [
  { key: 'min_range_m', label: 'Nearest usable range', unit: 'm' },
  { key: 'max_range_m', label: 'Farthest usable range', unit: 'm' },
  { key: 'range_noise_m', label: 'Noise of the range', unit: 'm' },
  { key: 'interval_s', label: 'A scan every', unit: 's', hint: 'Silent for two of these, it raises an alert.' },
] as const;

type Key = (typeof kFields)[number]['key'];
type SensorDraft = Readonly<Record<Key, string>>;

const draftOf = (sensor: Sensor): SensorDraft => ({
  min_range_m: String(sensor.min_range_m ?? ''),
  max_range_m: String(sensor.max_range_m ?? ''),
  range_noise_m: String(sensor.range_noise_m ?? ''),
  interval_s: String(sensor.interval_s ?? ''),
});

function Edit({ sensor, resource }: { sensor: Sensor; resource: Resource<Sensor> }) {
  const { name } = sensor;
  const { draft, run, form } = useEditing(() => draftOf(sensor));
  const save = (): void =>
    void run(
      async () => {
        const body = Object.fromEntries(kFields.map(({ key }) => [key, draft[key] === '' ? null : Number(draft[key])]));
        const answer = await send('patch', '/api/v1/sensors/{name}', { path: { name }, body, etag: resource.etag });
        loader.put(addressOf(name), answer);
        loader.invalidate((key) => key.startsWith('/api/v1/sensors?'));
        showToast('good', `${name} was changed. Scans that are stored keep what was found in them.`);
      },
      () => {
        showToast('bad', `Somebody else has changed ${name} meanwhile; what is there now is shown.`);
        loader.invalidate((key) => key === addressOf(name));
      },
    );
  return (
    <section class="panel" aria-labelledby="edit">
      <header class="panel-head">
        <h2 id="edit">Say more about it</h2>
      </header>
      <EditForm {...form} class="panel-body" onSave={save}>
        {({ field }) =>
          kFields.map(({ key, ...about }) => (
            <NumberField key={key} min={0} placeholder="left to the scans" {...about} {...field(key)} />
          ))
        }
      </EditForm>
    </section>
  );
}
