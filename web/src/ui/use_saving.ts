import { useState } from 'preact/hooks';
import { Problem } from '../lib/problem';

/** Sends something, and keeps what went wrong. `onConflict` hears that there is another version meanwhile. */
export function useSaving() {
  const [saving, setSaving] = useState(false);
  const [problem, setProblem] = useState<Problem | undefined>();
  const run = async (save: () => Promise<void>, onConflict: () => void = () => undefined): Promise<void> => {
    setSaving(true);
    setProblem(undefined);
    try {
      await save();
    } catch (failure) {
      if (!(failure instanceof Problem)) throw failure;
      // Both versions are shown then, which says more.
      if (failure.kind === 'precondition-failed') onConflict();
      else setProblem(failure);
    } finally {
      setSaving(false);
    }
  };
  return { saving, problem, run };
}
