import { useState } from 'preact/hooks';
import { showToast } from '../../app/app';
import { attempt } from '../../app/attempt';
import { withOperator } from '../../app/operator';
import { send } from '../../lib/api';
import { ConfirmDialog } from '../../ui/confirm_dialog';
import { isUnfinished, type Run, surveysAreOld } from './data';

/** Ends a run that waits or is under way; nothing where it has ended. */
export function CancelRun({ run }: { run: Run }) {
  const [asking, setAsking] = useState(false);
  if (!isUnfinished(run)) return null;
  const cancel = (by: string, note: string): Promise<boolean> =>
    attempt(async () => {
      const body = { by, ...(note === '' ? {} : { note }) };
      await send('post', '/api/v1/surveys/runs/{id}/cancel', { path: { id: run.id }, body });
      showToast('good', `Run ${run.id} was cancelled.`);
    }).finally(surveysAreOld);
  return (
    <>
      <button type="button" aria-label={`Cancel run ${run.id}`} onClick={() => setAsking(true)}>
        Cancel …
      </button>
      {asking && (
        <ConfirmDialog
          title={`Cancel run ${run.id}?`}
          draft=""
          about="the run"
          words="Nothing comes of it, and no alert. What it computes just now goes on for a while."
          doIt="Cancel it"
          doNot="Let it run"
          onClose={() => setAsking(false)}
          onConfirm={(note) => {
            setAsking(false);
            withOperator((by) => void cancel(by, note));
          }}
        />
      )}
    </>
  );
}
