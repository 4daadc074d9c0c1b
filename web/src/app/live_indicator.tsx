import { Icon } from '../ui/icon';
import { duration } from '../lib/format';
import { useSelect } from './app';

/** Whether what is shown follows the daemon, in a word. When it does not, since when. */
export function LiveIndicator() {
  const live = useSelect((state) => state.live);
  const now_ms = useSelect((state) => state.now_ms);
  const since = 'since_ms' in live ? ` for ${duration(Math.max(1, (now_ms - live.since_ms) / 1000))}` : '';
  const words = { connecting: 'connecting', live: 'live', reconnecting: 'reconnecting', offline: 'not live' }[
    live.state
  ];
  const title = {
    connecting: 'The stream of events is being opened.',
    live: 'What is shown follows the daemon as things happen.',
    reconnecting: 'The connection to the daemon was lost; what was missed is fetched when it is back.',
    offline: 'The daemon cannot be reached. What is shown is out of date; it is tried again every few seconds.',
  }[live.state];
  return (
    <span class={`live live-${live.state}`} role="status" title={title}>
      <Icon name={live.state === 'live' ? 'live' : 'clock'} /> {words}
      {live.state === 'offline' && since}
    </span>
  );
}
