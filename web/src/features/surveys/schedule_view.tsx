// One schedule: edited, run, paused, deleted, with what became of its runs. And a new one.

import './schedules.css';
import './surveys.css';
import { useState } from 'preact/hooks';
import { loader, navigate, showToast, useResource } from '../../app/app';
import { useAskAgain } from '../../app/polling';
import { linkTo } from '../../app/router';
import { useChosenSite, useZone } from '../../app/sites';
import { address, send } from '../../lib/api';
import { type Resource } from '../../lib/resources';
import { localOf, momentOf } from '../../lib/zone';
import { StateBadge } from '../../ui/badges';
import { NewAtSite } from '../../ui/at_site';
import { DeleteButton, DeleteDialog } from '../../ui/delete_dialog';
import { useEditing } from '../../ui/edit_form';
import { EditedElsewhere, useVersion, type Version } from '../../ui/edited_elsewhere';
import { TextField } from '../../ui/form';
import { EmptyState, Loaded } from '../../ui/states';
import { Ago, Time } from '../../ui/time';
import { RunBadge } from './badges';
import { CancelRun } from './cancel_run';
import { cronInWords } from './cron_words';
import { isUnfinished, kAskRunsMs, linkToRun, type Schedule, surveysAreOld } from './data';
import { bodyOf, differencesOf, draftOf, newDraft } from './schedule_draft';
import { ScheduleForm } from './schedule_form';
import { ScheduleActions } from './schedule_list';

const addressOf = (id: number) => address('/api/v1/schedules/{id}', { path: { id } });

export function ScheduleView({ id }: { id: string }) {
  const schedule = useResource(addressOf(Number(id)));
  return (
    <Loaded of={schedule} what="schedule">
      {(data) => <OneSchedule key={data.id} resource={{ ...schedule, data }} />}
    </Loaded>
  );
}

/** When it runs next is another version, too; only what somebody edited counts. */
const isEdited = (one: Schedule, other: Schedule): boolean => one.edited_at !== other.edited_at;

function OneSchedule({ resource }: { resource: Resource<Schedule> & { data: Schedule } }) {
  const { base, newer, adopt } = useVersion(resource);
  const schedule = resource.data;
  const { name, site, cron, time_zone, enabled, next_run_at, edited_at } = schedule;
  return (
    <>
      <div class="view-head">
        <h1>{name}</h1>
        {enabled ? <StateBadge tone="good">on</StateBadge> : <StateBadge>paused</StateBadge>}
        <span class="muted">
          schedule at {site}, {cronInWords(cron) ?? cron} ({time_zone})
          {next_run_at !== null && (
            <>
              , next <Time at={next_run_at} site={site} />
            </>
          )}
          , edited <Ago at={edited_at} site={site} />
        </span>
      </div>
      <div class="schedule-editor">
        <EditSchedule
          key={base.data.edited_at}
          base={base}
          newer={newer && isEdited(newer.data, base.data) ? newer : undefined}
          latest={resource.etag}
          adopt={adopt}
        />
        <div class="survey-side">
          <section class="panel" aria-label="At once">
            <div class="panel-body">
              <ScheduleActions schedule={schedule} onItsPage />
            </div>
          </section>
          <Runs schedule={schedule} />
        </div>
      </div>
    </>
  );
}

function EditSchedule({
  base,
  newer,
  latest,
  adopt,
}: {
  base: Version<Schedule>;
  newer: Version<Schedule> | undefined;
  /** Of what is there now. */
  latest: string | undefined;
  adopt: (version: Version<Schedule>) => void;
}) {
  const { id, site } = base.data;
  const { draft, run, form } = useEditing(() => draftOf(base.data));
  const [asking, setAsking] = useState(false);
  const save = (etag: string | undefined): void =>
    void run(
      async () => {
        const body = bodyOf(draft, base.data);
        const answer = await send('put', '/api/v1/schedules/{id}', { path: { id }, body, etag });
        loader.put(addressOf(id), answer);
        adopt(answer);
        surveysAreOld();
        showToast('good', `${answer.data.name} was changed. Runs that wait keep what they were made with.`);
      },
      () => loader.invalidate((key) => key === addressOf(id)),
    );
  return (
    <>
      <ScheduleForm
        {...form}
        site={site}
        onSave={() => save(newer ? base.etag : latest)}
        notice={
          newer && (
            <EditedElsewhere
              differences={differencesOf(draftOf(newer.data), draft)}
              onTake={() => adopt(newer)}
              onKeep={() => save(latest)}
            />
          )
        }
        actions={<DeleteButton onAsk={() => setAsking(true)} />}
      />
      {asking && <DeleteSchedule schedule={base.data} onClose={() => setAsking(false)} />}
    </>
  );
}

function DeleteSchedule({ schedule: { id, name, site }, onClose }: { schedule: Schedule; onClose: () => void }) {
  const remove = async (): Promise<void> => {
    await send('delete', '/api/v1/schedules/{id}', { path: { id } });
    // Not what is asked of it here, which is gone.
    loader.invalidate((key) => key.startsWith('/api/v1/schedules?'));
    showToast('good', `The schedule ${name} was deleted.`);
    navigate(linkTo('/surveys', { site }));
  };
  return (
    <DeleteDialog what={`the schedule ${name}`} onClose={onClose} onDelete={remove}>
      <p>Nothing is surveyed at its times any more. Its surveys stay.</p>
    </DeleteDialog>
  );
}

/** The latest runs, also those without a result. */
function Runs({ schedule: { id, site } }: { schedule: Schedule }) {
  const from = address('/api/v1/schedules/{id}/runs', { path: { id }, query: { limit: 10 } });
  const page = useResource(from);
  useAskAgain(from, page.data?.items.some(isUnfinished) ? kAskRunsMs : undefined);
  return (
    <section class="panel" aria-labelledby="runs">
      <header class="panel-head">
        <h2 id="runs">Latest runs</h2>
        <span class="spacer" />
        <a href={linkTo('/surveys', { site, schedule: id })}>All of them</a>
      </header>
      <Loaded of={page} what="runs">
        {({ items }) =>
          items.length === 0 ? (
            <EmptyState title="It has not run yet." />
          ) : (
            <ul class="panel-body schedule-runs">
              {items.map((run) => (
                <li key={run.id}>
                  <RunBadge state={run.state} />
                  <span>
                    <a href={linkToRun(run)}>
                      <Time at={run.due_at} site={site} />
                    </a>{' '}
                    {run.why !== '' && <span class="survey-under">{run.why}</span>}
                    <CancelRun run={run} />
                  </span>
                </li>
              ))}
            </ul>
          )
        }
      </Loaded>
    </section>
  );
}

export const NewScheduleView = () => (
  <NewAtSite title="New schedule" words="of surveys at" site={useChosenSite('survey')}>
    {(site) => <MakeSchedule site={site} />}
  </NewAtSite>
);

function MakeSchedule({ site }: { site: string }) {
  const zone = useZone(site);
  const { draft, problem, run, form } = useEditing(newDraft);
  const [since, setSince] = useState('');
  const make = (): void =>
    void run(async () => {
      const from = since === '' ? {} : { since: momentOf(since, zone).toISOString() };
      const answer = await send('post', '/api/v1/schedules', { body: { ...bodyOf(draft, { site }), ...from } });
      surveysAreOld();
      showToast('good', `The schedule ${answer.data.name} is there.`);
      navigate(`/surveys/schedules/${answer.data.id}`);
    });
  return (
    <div class="schedule-editor">
      <ScheduleForm
        {...form}
        site={site}
        onSave={make}
        notice={
          <TextField
            type="datetime-local"
            label={`Survey also what was scanned since (${zone})`}
            hint="Empty: only from now on. Which of the past nights are made is said by what becomes of missed runs."
            max={localOf(new Date(), zone)}
            value={since}
            error={problem?.about('since')}
            onValue={setSince}
          />
        }
      />
    </div>
  );
}
