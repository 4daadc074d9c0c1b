// The nights of a site: what moved in each, how sure that is, and the nights without a result; its schedules beside them.

import './surveys.css';
import { setQuery, useResource, useSelect } from '../../app/app';
import { linkTo } from '../../app/router';
import { useChosenSite } from '../../app/sites';
import { useAskAgain } from '../../app/polling';
import { address } from '../../lib/api';
import { percent } from '../../lib/format';
import { ChoiceFilter } from '../../ui/filters';
import { type Column, DataTable } from '../../ui/data_table';
import { SitePicker } from '../../ui/site_picker';
import { AtSite } from '../../ui/at_site';
import { EmptyPanel } from '../../ui/states';
import { CancelRun } from './cancel_run';
import { Coordinates, LevelBadge, NightTime, RunBadge } from './badges';
import {
  isUnfinished,
  kAskRunsMs,
  linkToRun,
  type Judged,
  type Run,
  type Schedule,
  surveyAt,
  levelsOf,
  useLevels,
  useSchedules,
  useVolumeZones,
  volumesAt,
  type ZoneFigures,
} from './data';
import { LatestNight } from './latest_night';
import { ScheduleList } from './schedule_list';
import { cubicMetres, interval, isMissed, kRunStates, type RunState, worst } from './words';

const kStates = Object.entries(kRunStates).map(([value, { words }]) => ({ value: value as RunState, words }));
/** Each line asks for a survey of its own. */
const kLines = 30;
const kMostSought = 1000;

type LevelsOf = (survey: number) => readonly Judged[];

function columnsFor(zone: number | undefined, levels: LevelsOf): readonly Column<Run>[] {
  return [
    { head: 'Night', cell: (run) => <Night run={run} /> },
    { head: 'State', cell: (run) => <RunState run={run} />, essential: false },
    { head: 'Compared with', cell: (run) => <Before run={run} />, essential: false },
    ...(['net', 'cut', 'fill'] as const).map((name): Column<Run> => ({
      head: name[0]!.toUpperCase() + name.slice(1),
      cell: (run) => (run.survey === null ? '' : <Volume survey={run.survey} zone={zone} name={name} />),
      numeric: true,
      essential: name === 'net',
    })),
    { head: 'Level', cell: ({ survey }) => survey !== null && <WorstLevel levels={levels(survey)} /> },
    { head: 'Seen, fits to', cell: (run) => <Seen run={run} zone={zone} />, numeric: true, essential: false },
  ];
}

function Night({ run }: { run: Run }) {
  const time = <NightTime at={run.due_at} site={run.site} />;
  const said = run.survey !== null ? '' : run.state === 'done' ? 'the first' : kRunStates[run.state].words;
  return (
    <>
      <a href={linkToRun(run)}>{time}</a>
      {run.schedule === null && <span class="survey-under">by hand</span>}
      {said !== '' && <span class="survey-under only-narrow">{said}</span>}
    </>
  );
}

function RunState({ run }: { run: Run }) {
  const isFirst = run.state === 'done' && run.survey === null;
  return (
    <>
      <RunBadge state={run.state} />{' '}
      {(isMissed(run) || isFirst) && <span class="survey-under survey-why">{run.why}</span>}
      <CancelRun run={run} />
    </>
  );
}

function Before({ run }: { run: Run }) {
  const survey = useResource(run.survey === null ? undefined : surveyAt(run.survey)).data;
  return survey ? <NightTime at={survey.before.captured_at} site={run.site} /> : null;
}

/** The figures of one zone of a survey, or the total. */
function useFigures(survey: number | null, zone: number | undefined): ZoneFigures | undefined {
  const total = useResource(survey === null || zone !== undefined ? undefined : surveyAt(survey)).data?.total;
  const zones = useResource(survey === null || zone === undefined ? undefined : volumesAt(survey)).data?.zones;
  return zone === undefined ? total : zones?.find((each) => each.zone === zone);
}

function Volume({ survey, zone, name }: { survey: number; zone: number | undefined; name: 'net' | 'cut' | 'fill' }) {
  const figure = useFigures(survey, zone)?.[name];
  if (!figure) return <span class="muted">–</span>;
  const signed = name === 'net';
  return (
    <>
      {cubicMetres(figure.value_m3, signed)}
      <span class="survey-under">{interval(figure.low_m3, figure.high_m3, 'm³', signed)}</span>
    </>
  );
}

function WorstLevel({ levels }: { levels: readonly Judged[] }) {
  const level = worst(levels.map((each) => each.level));
  return level ? <LevelBadge level={level} /> : null;
}

/** What share both epochs saw, and how well the worst of the night's scans fits. */
function Seen({ run, zone }: { run: Run; zone: number | undefined }) {
  const figures = useFigures(run.survey, zone);
  const survey = useResource(run.survey === null ? undefined : surveyAt(run.survey)).data;
  const residuals = survey?.ground.scans.after.map(({ registration }) => registration.residual_m ?? 0) ?? [];
  if (!figures || residuals.length === 0) return null;
  return (
    <>
      {percent(figures.seen_share)}
      <span class="survey-under">{(1000 * Math.max(...residuals)).toFixed(1)}&nbsp;mm</span>
    </>
  );
}

function useRuns(site: string | undefined) {
  const { schedule, state, cursor } = useSelect((all) => all.location.query);
  // States are not asked for but sought, in as many runs as one answer has.
  const query = { cursor, limit: state === undefined ? kLines : kMostSought };
  const from =
    site === undefined
      ? undefined
      : schedule === undefined
        ? address('/api/v1/surveys/runs', { query: { site, ...query } })
        : address('/api/v1/schedules/{id}/runs', { path: { id: Number(schedule) }, query });
  const page = useResource(from);
  // That a run began is told by no event.
  useAskAgain(from, state === undefined && page.data?.items.some(isUnfinished) ? kAskRunsMs : undefined);
  if (!page.data || state === undefined) return page;
  const items = page.data.items.filter((run) => run.state === state).slice(0, 2 * kLines);
  return { ...page, data: { ...page.data, items } };
}

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

function Nights({ site, schedules }: { site: string; schedules: readonly Schedule[] }) {
  const { zone, schedule, state } = useSelect((all) => all.location.query);
  const zones = useVolumeZones(site);
  const runs = useRuns(site);
  const levels = useLevels(schedules.map(levelsOf));
  const isFiltered = schedule !== undefined || state !== undefined;
  return (
    <div class="survey-nights">
      <DataTable
        caption={`nights of ${site}`}
        page={runs}
        columns={columnsFor(zone === undefined ? undefined : Number(zone), levels)}
        rowKey={({ id }) => id}
        filters={
          <>
            {schedules.length > 0 && (
              <ChoiceFilter
                name="schedule"
                all="all schedules"
                choices={schedules.map(({ id, name }) => ({ value: String(id), words: name }))}
              />
            )}
            {zones.length > 0 && (
              <ChoiceFilter
                name="zone"
                all="all zones together"
                choices={zones.map(({ id, name }) => ({ value: String(id), words: name }))}
              />
            )}
            <ChoiceFilter name="state" all="any state" choices={kStates} />
            <Coordinates site={site} />
          </>
        }
        empty={
          isFiltered ? (
            <EmptyPanel title="No night is like this." />
          ) : (
            <EmptyPanel title="No night was surveyed yet.">
              <p>A schedule compares what was scanned each night with what was there before.</p>
            </EmptyPanel>
          )
        }
      />
    </div>
  );
}
