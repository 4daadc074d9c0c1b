import { type Schema } from '../../lib/api';
import { StateBadge } from '../../ui/badges';

const kStates: Record<Schema<'TrackState'>, { tone: 'busy' | 'good' | 'plain'; words: string }> = {
  open: { tone: 'busy', words: 'still so' },
  gone: { tone: 'plain', words: 'gone' },
  accepted: { tone: 'good', words: 'accepted as normal' },
};

export function TrackStateBadge({ track }: { track: Pick<Schema<'Track'>, 'state'> }) {
  const { tone, words } = kStates[track.state];
  return <StateBadge tone={tone}>{words}</StateBadge>;
}
