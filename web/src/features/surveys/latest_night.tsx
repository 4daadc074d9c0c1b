// What a surveyor comes for in the morning: the latest night, and what came together since the first.

import { useResource } from '../../app/app';
import { address } from '../../lib/api';
import { counted, percent, squareMetres } from '../../lib/format';
import { EmptyState } from '../../ui/states';
import { Time } from '../../ui/time';
import { LevelBadge } from './badges';
import { Card, NetCutFill } from './cards';
import { levelsOf, type Run, type Schedule, seriesAt, surveyAt, useLevels } from './data';
import { cubicMetres, figureText, isMissed, kFigures, worst } from './words';

export function LatestNight({ schedule }: { schedule: Schedule }) {
  const runs = useResource(address('/api/v1/schedules/{id}/runs', { path: { id: schedule.id }, query: { limit: 30 } }))
    .data?.items;
  const done = runs?.find(({ survey }) => survey !== null);
  if (!runs) return null;
  if (done?.survey == null) return <NothingYet schedule={schedule} runs={runs} />;
  const since = runs.slice(0, runs.indexOf(done)).filter(isMissed);
  return (
    <section class="panel" aria-labelledby="latest">
      <header class="panel-head">
        <h2 id="latest">The latest night</h2>
        <span class="muted">
          {schedule.name}, <Time at={done.due_at} site={schedule.site} whole />
        </span>
        <span class="spacer" />
        <a href={`/surveys/${done.survey}`}>Show it</a>
      </header>
      {since.length > 0 && <NoneSince runs={since} />}
      <Figures schedule={schedule} survey={done.survey} />
    </section>
  );
}

function NothingYet({ schedule: { name }, runs }: { schedule: Schedule; runs: readonly Run[] }) {
  return (
    <section class="panel" aria-label="The latest night">
      <EmptyState title={`No result of ${name} yet.`}>
        <p>{runs[0]?.why || 'It has not run yet. Its first night is what the next one is compared with.'}</p>
      </EmptyState>
    </section>
  );
}

/** Nights after the latest one, from which nothing came. */
function NoneSince({ runs }: { runs: readonly Run[] }) {
  return (
    <p class="notice notice-busy survey-none" role="status">
      <span aria-hidden="true">▲</span>
      <span>
        {counted(runs.length, 'night')} since brought no result; the last said: {runs[0]?.why}
      </span>
    </p>
  );
}

function Figures({ schedule, survey }: { schedule: Schedule; survey: number }) {
  const total = useResource(surveyAt(survey)).data?.total;
  const series = useResource(seriesAt(schedule.id, 'net_m3', null)).data;
  const judged = useLevels([levelsOf(schedule)])(survey);
  if (!total) return null;
  const level = worst(judged.map((each) => each.level));
  const reason = judged.find((each) => each.level === level);
  const first = series?.values[0];
  const trend = series?.values.at(-1)?.trend;
  return (
    <dl class="survey-cards">
      <NetCutFill total={total} reference={schedule.survey.reference} />
      {series?.cumulative && trend !== undefined && first && (
        <Card title="Net since the first night" under={`${counted(series.values.length, 'night')} added up`}>
          {cubicMetres(trend, true)}
        </Card>
      )}
      <Card title="Seen in both" under={`of ${squareMetres(total.area_m2)}`}>
        {percent(total.seen_share)}
      </Card>
      {level && reason && (
        <Card
          title="Level"
          under={`${kFigures[reason.thresholds.figure]}: ${figureText(reason.thresholds.figure, reason.value)}`}
        >
          <LevelBadge level={level} />
        </Card>
      )}
    </dl>
  );
}
