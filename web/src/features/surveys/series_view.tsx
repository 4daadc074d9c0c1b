// Each figure of a schedule's surveys through time, with its interval and its levels, and how fast it changes.

import './surveys.css';
import { setQuery, useResource, useSelect } from '../../app/app';
import { lazy } from '../../app/lazy';
import { linkTo } from '../../app/router';
import { useChosenSite } from '../../app/sites';
import { address } from '../../lib/api';
import { ChoiceFilter } from '../../ui/filters';
import { SitePicker } from '../../ui/site_picker';
import { EmptyPanel, Loaded } from '../../ui/states';
import { type Schedule, useSchedules, useVolumeZones } from './data';
import { kFigureNames, kFigures } from './words';

const SeriesCharts = lazy(() => import('./series_charts').then((module) => module.SeriesCharts));

export function SeriesView() {
  const query = useSelect((state) => state.location.query);
  const asked = useResource(
    query['schedule'] === undefined || query['site'] !== undefined
      ? undefined
      : address('/api/v1/schedules/{id}', { path: { id: Number(query['schedule']) } }),
  ).data?.site;
  const chosen = useChosenSite('survey');
  const site = asked ?? chosen;
  const schedules = useSchedules(site);
  return (
    <>
      <div class="view-head">
        <h1>Series</h1>
        <span class="muted">each figure through time</span>
        {site !== undefined && (
          <SitePicker site={site} onSite={(name) => setQuery({ site: name, schedule: undefined, zone: undefined })} />
        )}
        <span class="spacer" />
        <a class="button" href={linkTo('/surveys', { site })}>
          Nights
        </a>
      </div>
      <Loaded of={schedules} what="schedules">
        {({ items }) => {
          const schedule = items.find(({ id }) => String(id) === query['schedule']) ?? items[0];
          return schedule ? (
            <OneSchedule schedule={schedule} schedules={items} />
          ) : (
            <EmptyPanel title="There is no schedule yet, and so no series.">
              <a href={linkTo('/surveys/schedules/new', { site })}>Make a schedule</a>
            </EmptyPanel>
          );
        }}
      </Loaded>
    </>
  );
}

function OneSchedule({ schedule, schedules }: { schedule: Schedule; schedules: readonly Schedule[] }) {
  const query = useSelect((state) => state.location.query);
  const zones = useVolumeZones(schedule.site);
  const figure = kFigureNames.find((name) => name === query['figure']) ?? 'net_m3';
  const [only] = schedule.survey.zones.length === 1 ? schedule.survey.zones : [];
  // Of one zone the total says the same, but it is the zone that has levels.
  const zone = only ?? zones.find(({ id }) => String(id) === query['zone'])?.id ?? null;
  return (
    <>
      <div class="toolbar">
        {schedules.length > 1 && (
          <select
            aria-label="schedule"
            value={schedule.id}
            onChange={(event) => setQuery({ schedule: event.currentTarget.value })}
          >
            {schedules.map(({ id, name }) => (
              <option key={id} value={id}>
                {name}
              </option>
            ))}
          </select>
        )}
        {only === undefined && (
          <ChoiceFilter
            name="zone"
            all="all zones together"
            choices={zones.map(({ id, name }) => ({ value: String(id), words: name }))}
          />
        )}
        <select
          aria-label="figure"
          value={figure}
          onChange={(event) => setQuery({ figure: event.currentTarget.value })}
        >
          {kFigureNames.map((name) => (
            <option key={name} value={name}>
              {kFigures[name]}
            </option>
          ))}
        </select>
        <label class="inline-field">
          velocity over
          <select
            aria-label="velocity over"
            value={query['window_h'] ?? '72'}
            onChange={(event) => setQuery({ window_h: event.currentTarget.value })}
          >
            {[
              [24, '1 day'],
              [72, '3 days'],
              [168, '7 days'],
              [720, '30 days'],
            ].map(([hours, words]) => (
              <option key={hours} value={hours}>
                {words}
              </option>
            ))}
          </select>
        </label>
      </div>
      <SeriesCharts schedule={schedule} zone={zone} figure={figure} window_h={Number(query['window_h'] ?? 72)} />
    </>
  );
}
