// What a site's surveys came to: the latest night, its schedules, and all nights.

import './surveys.css';
import { setQuery, useSelect } from '../../app/app';
import { linkTo } from '../../app/router';
import { useChosenSite } from '../../app/sites';
import { AtSite } from '../../ui/at_site';
import { SitePicker } from '../../ui/site_picker';
import { type Schedule, useSchedules } from './data';
import { LatestNight } from './latest_night';
import { Nights } from './nights';
import { ScheduleList } from './schedule_list';

export function SurveysView() {
  const query = useSelect((state) => state.location.query);
  const site = useChosenSite('survey');
  const schedules = useSchedules(site);
  return (
    <>
      <div class="view-head">
        <h1>Surveys</h1>
        <span class="muted">what moved, how much, and how sure that is</span>
        {site !== undefined && (
          <SitePicker
            site={site}
            onSite={(name) =>
              setQuery({ site: name, cursor: undefined, schedule: undefined, zone: undefined, state: undefined })
            }
          />
        )}
        <span class="spacer" />
        <a class="button" href={linkTo('/surveys/series', { site, schedule: query['schedule'] })}>
          Series
        </a>
        <a class="button" href={linkTo('/surveys/compare', { site })}>
          Compare two nights …
        </a>
        <a class="button primary" href={linkTo('/surveys/schedules/new', { site })}>
          New schedule
        </a>
      </div>
      <AtSite site={site}>
        {(name) => (
          <div class="surveys">
            <Latest schedules={schedules.data?.items ?? []} />
            <ScheduleList site={name} schedules={schedules} />
            <Nights key={name} site={name} schedules={schedules.data?.items ?? []} />
          </div>
        )}
      </AtSite>
    </>
  );
}

/** Of the chosen schedule, or the first. */
function Latest({ schedules }: { schedules: readonly Schedule[] }) {
  const chosen = useSelect((state) => state.location.query['schedule']);
  const schedule = schedules.find(({ id }) => String(id) === chosen) ?? schedules[0];
  return schedule ? <LatestNight schedule={schedule} /> : null;
}
