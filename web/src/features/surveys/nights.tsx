// The nights of a site: what moved in each, how sure that is, and the nights without a result.

import { type ComponentChildren } from 'preact';
import { useResource, useSelect } from '../../app/app';
import { useAskAgain } from '../../app/polling';
import { address } from '../../lib/api';
import { percent } from '../../lib/format';
import { type Column, DataTable } from '../../ui/data_table';
import { ChoiceFilter } from '../../ui/filters';
import { EmptyPanel } from '../../ui/states';
import { Coordinates, LevelBadge, NightTime, RunBadge } from './badges';
import { CancelRun } from './cancel_run';
import {
  isUnfinished,
  type Judged,
  kAskRunsMs,
  levelsOf,
  linkToRun,
  type Run,
  type Schedule,
  useLevels,
  useVolumeZones,
} from './data';
import { type NightFigures, useListedSurveys, useZoneFigures } from './night_figures';
import { cubicMetres, interval, isMissed, kRunStates, type RunState, worst } from './words';

const kStates = Object.entries(kRunStates).map(([value, { words }]) => ({ value: value as RunState, words }));
const kLines = 30;
const kMostSought = 1000;

/** What is known of each survey, by its id. */
interface Known {
  readonly before: (survey: number) => string | undefined;
  readonly figures: (survey: number) => NightFigures | undefined;
  readonly levels: (survey: number) => readonly Judged[];
}

function columnsFor({ before, figures, levels }: Known): readonly Column<Run>[] {
  const withSurvey =
    (cell: (survey: number, run: Run) => ComponentChildren) =>
    (run: Run): ComponentChildren =>
      run.survey === null ? null : cell(run.survey, run);
  return [
    { head: 'Night', cell: (run) => <Night run={run} /> },
    { head: 'State', cell: (run) => <RunState run={run} />, essential: false },
    {
      head: 'Compared with',
      cell: withSurvey((survey, { site }) => {
        const at = before(survey);
        return at && <NightTime at={at} site={site} />;
      }),
      essential: false,
    },
    ...(['net', 'cut', 'fill'] as const).map((name): Column<Run> => ({
      head: name[0]!.toUpperCase() + name.slice(1),
      cell: withSurvey((survey) => <Volume volume={figures(survey)?.[name]} signed={name === 'net'} />),
      numeric: true,
      essential: name === 'net',
    })),
    { head: 'Level', cell: withSurvey((survey) => <WorstLevel levels={levels(survey)} />) },
    {
      head: 'Seen in both',
      cell: withSurvey((survey) => {
        const known = figures(survey);
        return known && percent(known.seen_share);
      }),
      numeric: true,
      essential: false,
    },
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

function Volume({ volume, signed }: { volume: NightFigures['net'] | undefined; signed: boolean }) {
  if (!volume) return <span class="muted">–</span>;
  return (
    <>
      {cubicMetres(volume.value_m3, signed)}
      <span class="survey-under">{interval(volume.low_m3, volume.high_m3, 'm³', signed)}</span>
    </>
  );
}

function WorstLevel({ levels }: { levels: readonly Judged[] }) {
  const level = worst(levels.map((each) => each.level));
  return level ? <LevelBadge level={level} /> : null;
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

export function Nights({ site, schedules }: { site: string; schedules: readonly Schedule[] }) {
  const { zone, schedule, state } = useSelect((all) => all.location.query);
  const zones = useVolumeZones(site);
  const runs = useRuns(site);
  const chosen = zone === undefined ? undefined : Number(zone);
  const items = runs.data?.items ?? [];
  const surveys = useListedSurveys(items, schedule === undefined ? { site } : { schedule: Number(schedule) });
  const figuresOfZone = useZoneFigures(items, site, chosen);
  const columns = columnsFor({
    before: (survey) => surveys.get(survey)?.before.captured_at,
    figures: (survey) => (chosen === undefined ? surveys.get(survey)?.total : figuresOfZone(survey)),
    levels: useLevels(schedules.map(levelsOf)),
  });
  const isFiltered = schedule !== undefined || state !== undefined;
  return (
    <div class="survey-nights">
      <DataTable
        caption={`nights of ${site}`}
        page={runs}
        columns={columns}
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
