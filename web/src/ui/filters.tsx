// Filters of lists, which stand in the link: a list begins anew when one of them is changed.

import { setQuery, useResource, useSelect } from '../app/app';
import { useSites, useZone } from '../app/sites';
import { address } from '../lib/api';
import { localOf, momentOf } from '../lib/zone';

const set = (name: string, value: string): void =>
  setQuery({ cursor: undefined, [name]: value === '' ? undefined : value });

export interface Choice {
  readonly value: string;
  readonly words: string;
}

/** One of some values, or all. */
export function ChoiceFilter({
  name,
  all,
  choices,
}: {
  name: string;
  all: string;
  choices: readonly (Choice | string)[];
}) {
  const chosen = useSelect((state) => state.location.query[name]);
  return (
    <select aria-label={name} value={chosen ?? ''} onChange={(event) => set(name, event.currentTarget.value)}>
      <option value="">{all}</option>
      {choices
        .map((choice) => (typeof choice === 'string' ? { value: choice, words: choice } : choice))
        .map(({ value, words }) => (
          <option key={value} value={value}>
            {words}
          </option>
        ))}
    </select>
  );
}

/** Nothing to choose where there is only one site. */
export function SiteFilter() {
  const sites = useSites();
  if (sites.length < 2) return null;
  return <ChoiceFilter name="site" all="all sites" choices={sites.map(({ name }) => name)} />;
}

/** The sensors of the chosen site, or all. */
export function SensorFilter() {
  const site = useSelect((state) => state.location.query['site']);
  const sensors = useResource(address('/api/v1/sensors', { query: { limit: 1000 } })).data?.items ?? [];
  return (
    <ChoiceFilter
      name="sensor"
      all="all sensors"
      choices={sensors.filter((sensor) => !site || sensor.site === site).map(({ name }) => name)}
    />
  );
}

/** What a time of the link is on the clock of a zone; nothing where it is none. */
const clockText = (time: string | undefined, zone: string): string =>
  Number.isNaN(Date.parse(time ?? '')) ? '' : localOf(new Date(time ?? ''), zone);

/** From and to, on the clocks of the chosen site, or of the first. */
export function TimeFilter() {
  const query = useSelect((state) => state.location.query);
  const sites = useSites();
  const zone = useZone(query['site'] ?? sites[0]?.name);
  return (
    <>
      {(['from', 'to'] as const).map((name) => (
        <label key={name} class="inline-field">
          {name}
          <input
            type="datetime-local"
            value={clockText(query[name], zone)}
            onChange={(event) =>
              set(name, event.currentTarget.value && momentOf(event.currentTarget.value, zone).toISOString())
            }
          />
        </label>
      ))}
      <span class="muted">{zone}</span>
    </>
  );
}
