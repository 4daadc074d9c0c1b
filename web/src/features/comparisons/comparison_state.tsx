import { type Schema } from '../../lib/api';
import { percent } from '../../lib/format';
import { StateBadge } from '../../ui/badges';

type Comparison = Schema<'Comparison'>;

const kTones = { queued: 'busy', running: 'busy', done: 'good', failed: 'bad' } as const;

export const isUnfinished = ({ state }: Pick<Comparison, 'state'>): boolean =>
  state === 'queued' || state === 'running';

export function ComparisonStateBadge({ comparison }: { comparison: Pick<Comparison, 'state' | 'progress'> }) {
  const { state, progress } = comparison;
  return <StateBadge tone={kTones[state]}>{state === 'running' ? `running, ${percent(progress)}` : state}</StateBadge>;
}
