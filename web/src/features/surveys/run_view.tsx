// A run of a survey: that it waits or is under way, or why nothing came of it. With a result, the survey stands for it.

import './surveys.css';
import { useEffect } from 'preact/hooks';
import { navigate, useResource } from '../../app/app';
import { linkTo } from '../../app/router';
import { address } from '../../lib/api';
import { useAskAgain } from '../../app/polling';
import { Loaded } from '../../ui/states';
import { Time } from '../../ui/time';
import { RunBadge } from './badges';
import { CancelRun } from './cancel_run';
import { isUnfinished, kAskRunsMs, type Run } from './data';
import { RunLog } from './run_log';

export function RunView({ id }: { id: string }) {
  const from = address('/api/v1/surveys/runs/{id}', { path: { id: Number(id) } });
  const run = useResource(from);
  const survey = run.data?.survey ?? undefined;
  useAskAgain(from, run.data && isUnfinished(run.data) ? kAskRunsMs : undefined);
  useEffect(() => {
    if (survey !== undefined) navigate(`/surveys/${survey}`, { replace: true });
  }, [survey]);
  return (
    <Loaded of={run} what="run">
      {(data) => <OneRun run={data} />}
    </Loaded>
  );
}

function OneRun({ run }: { run: Run }) {
  const { id, site, schedule, from, to } = run;
  return (
    <>
      <div class="view-head">
        <h1>Run {id}</h1>
        <RunBadge state={run.state} />
        <span class="muted">
          {schedule === null ? 'by hand' : <a href={`/surveys/schedules/${schedule}`}>by its schedule</a>} at {site}, of
          what was scanned from <Time at={from} site={site} /> to <Time at={to} site={site} />
        </span>
        <span class="spacer" />
        <CancelRun run={run} />
        <a class="button" href={linkTo('/surveys', { site })}>
          Nights
        </a>
      </div>
      <div class="panels">
        <section class="panel panel-body" aria-label="How far it is" aria-live="polite">
          <HowFar run={run} />
        </section>
        {run.log.length > 0 && <RunLog run={run} />}
      </div>
    </>
  );
}

function HowFar({ run }: { run: Run }) {
  if (!isUnfinished(run)) return <p>{run.why === '' ? 'It has ended.' : run.why}</p>;
  return (
    <>
      <p>{run.state === 'queued' ? 'It waits for its turn.' : 'It is under way.'}</p>
      <progress class="survey-progress" aria-label="Progress" />
      <p class="muted">The result stands here as soon as it is there.</p>
    </>
  );
}
