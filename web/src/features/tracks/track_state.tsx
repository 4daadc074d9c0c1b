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

/** From the first scan that saw it to the last. */
export const lastedSeconds = (track: Pick<Schema<'Track'>, 'first_seen_at' | 'last_seen_at'>): number =>
  (Date.parse(track.last_seen_at) - Date.parse(track.first_seen_at)) / 1000;
