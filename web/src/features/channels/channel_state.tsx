import { type Schema } from '../../lib/api';
import { StateBadge } from '../../ui/badges';
import { Ago } from '../../ui/time';

/** Whether messages arrive; why not, and since when. */
export function ChannelState({ channel }: { channel: Schema<'Channel'> }) {
  if (!channel.enabled) return <StateBadge>off</StateBadge>;
  if (channel.trouble === null) return <StateBadge tone="good">in order</StateBadge>;
  return (
    <span title={channel.trouble}>
      <StateBadge tone="bad">failing</StateBadge>
      {channel.failing_since !== null && (
        <span class="muted">
          {' '}
          since <Ago at={channel.failing_since} site={channel.site ?? undefined} />
        </span>
      )}
    </span>
  );
}
