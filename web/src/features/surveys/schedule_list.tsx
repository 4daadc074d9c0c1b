// When a site is surveyed, in words, with what was missed, and the buttons that run and pause it.

import { useState } from 'preact/hooks';
import { showToast, useResource, useSelect } from '../../app/app';
import { attempt } from '../../app/attempt';
import { linkTo } from '../../app/router';
import { address, ask, type Schema, send } from '../../lib/api';
import { clockOf, counted, dayOf } from '../../lib/format';
import { type Resource } from '../../lib/resources';
import { StateBadge } from '../../ui/badges';
import { EmptyState, Loaded } from '../../ui/states';
import { cronInWords } from './cron_words';
import { type Schedule, surveysAreOld } from './data';
import { bodyOf, draftOf } from './schedule_draft';
import { isMissed, referenceInWords } from './words';

export function ScheduleList({ site, schedules }: { site: string; schedules: Resource<Schema<'SurveySchedulePage'>> }) {
  return (
    <section class="panel survey-schedules" aria-labelledby="schedules">
      <header class="panel-head">
        <h2 id="schedules">Schedules</h2>
      </header>
      <Loaded of={schedules} what="schedules">
        {({ items }) =>
          items.length === 0 ? (
            <EmptyState title="None yet.">
              <p>
                First draw <a href={linkTo('/zones/new', { site })}>a zone of the kind “volume”</a> where volumes are to
                be measured, then say when.
              </p>
              <a href={linkTo('/surveys/schedules/new', { site })}>Make a schedule</a>
            </EmptyState>
          ) : (
            <ul>
              {items.map((schedule) => (
                <li key={schedule.id} class="panel-body">
                  <OneSchedule schedule={schedule} />
                </li>
              ))}
            </ul>
          )
        }
      </Loaded>
    </section>
  );
}

const kCatchUp: Readonly<Record<Schedule['catch_up'], string>> = {
  all: 'missed runs are caught up, each of them',
  latest: 'of missed runs the latest is caught up',
  skip: 'missed runs are skipped',
};

function OneSchedule({ schedule }: { schedule: Schedule }) {
  const now_ms = useSelect((state) => state.now_ms);
  const { id, name, cron, time_zone, next_run_at, survey } = schedule;
  return (
    <>
      <h3>
        <a href={`/surveys/schedules/${id}`}>{name}</a>{' '}
        {schedule.enabled ? <StateBadge tone="good">on</StateBadge> : <StateBadge>paused</StateBadge>}
      </h3>
      <dl class="survey-facts">
        <div>
          <dt>Runs</dt>
          <dd title={cron}>
            {cronInWords(cron) ?? <code>{cron}</code>} <span class="muted">({time_zone})</span>
          </dd>
        </div>
        <div>
          <dt>Next run</dt>
          <dd>
            {next_run_at === null
              ? 'none: it is paused'
              : `${dayOf(next_run_at, time_zone, now_ms)}, ${clockOf(next_run_at, time_zone)}`}
          </dd>
        </div>
        <div>
          <dt>Compared with</dt>
          <dd>{referenceInWords(survey.reference)}</dd>
        </div>
        <div>
          <dt>Without a result</dt>
          <dd>
            <Missed schedule={schedule} />
            <span class="survey-under">{kCatchUp[schedule.catch_up]}</span>
          </dd>
        </div>
      </dl>
      <ScheduleActions schedule={schedule} />
    </>
  );
}

const kLatest = 30;

function Missed({ schedule: { id, site } }: { schedule: Schedule }) {
  const runs = useResource(address('/api/v1/schedules/{id}/runs', { path: { id }, query: { limit: kLatest } })).data
    ?.items;
  if (!runs) return <>…</>;
  const missed = runs.filter(isMissed).length;
  if (runs.length === 0) return <>it has not run yet</>;
  if (missed === 0) return <>none of the last {counted(runs.length, 'run')}</>;
  return (
    <a href={linkTo('/surveys', { site, schedule: id })}>
      {missed} of the last {counted(runs.length, 'run')}
    </a>
  );
}

export function ScheduleActions({ schedule, onItsPage }: { schedule: Schedule; onItsPage?: boolean }) {
  const [busy, setBusy] = useState(false);
  const { id, name, site, enabled } = schedule;
  const doing = async (act: () => Promise<unknown>, done: string): Promise<void> => {
    setBusy(true);
    if (await attempt(act)) showToast('good', done);
    setBusy(false);
    surveysAreOld();
  };
  const run = () => send('post', '/api/v1/schedules/{id}/run', { path: { id } });
  const turn = async () => {
    // From what is there now, so that nobody's edit is undone.
    const now = await ask(address('/api/v1/schedules/{id}', { path: { id } }));
    if (!now) return;
    const body = bodyOf({ ...draftOf(now.data), enabled: !enabled }, now.data);
    await send('put', '/api/v1/schedules/{id}', { path: { id }, body, etag: now.etag });
  };
  return (
    <div class="actions">
      <button type="button" disabled={busy} onClick={() => void doing(run, `${name} runs now; its window ends now.`)}>
        Run now
      </button>
      <button
        type="button"
        disabled={busy}
        onClick={() => void doing(turn, enabled ? `${name} is paused.` : `${name} runs again.`)}
      >
        {enabled ? 'Pause' : 'Resume'}
      </button>
      {!onItsPage && (
        <a class="button" href={`/surveys/schedules/${id}`} aria-label={`Edit ${name}`}>
          Edit
        </a>
      )}
      <a href={linkTo('/surveys/series', { site, schedule: id })}>Series</a>
    </div>
  );
}
