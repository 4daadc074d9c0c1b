import { Problem } from '../lib/problem';
import { showProblem } from './app';

/** Does something. What is wrong with it is told in passing. @returns whether it was done. */
export async function attempt(act: () => Promise<unknown>): Promise<boolean> {
  try {
    await act();
    return true;
  } catch (failure) {
    if (!(failure instanceof Problem)) throw failure;
    showProblem(failure);
    return false;
  }
}
