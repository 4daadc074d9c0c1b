import { type Schema } from '../../lib/api';

export const kSeverities: readonly Schema<'Severity'>[] = ['critical', 'warning', 'advisory', 'info'];

type Ordered = Pick<Schema<'Alert'>, 'severity' | 'opened_at' | 'id'>;

/** The gravest first; of the same severity the latest. */
export function bySeverity<A extends Ordered>(alerts: readonly A[]): A[] {
  return [...alerts].sort(
    (one, other) =>
      kSeverities.indexOf(one.severity) - kSeverities.indexOf(other.severity) ||
      Date.parse(other.opened_at) - Date.parse(one.opened_at) ||
      other.id - one.id,
  );
}
