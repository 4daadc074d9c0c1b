import './channels.css';
import { useResource, useSelect } from '../../app/app';
import { address, type Schema } from '../../lib/api';
import { StateBadge } from '../../ui/badges';
import { type Column, DataTable } from '../../ui/data_table';
import { EmptyPanel } from '../../ui/states';
import { ChannelState } from './channel_state';
import { placeOf } from './draft';

type Channel = Schema<'Channel'>;

const kColumns: readonly Column<Channel>[] = [
  { head: 'Channel', cell: ({ id, name }) => <a href={`/channels/${id}`}>{name}</a> },
  { head: 'Kind', cell: ({ kind }) => <StateBadge>{kind}</StateBadge> },
  { head: 'State', cell: (channel) => <ChannelState channel={channel} /> },
  { head: 'Leads to', cell: (channel) => <span class="channel-place">{placeOf(channel)}</span>, essential: false },
  {
    head: 'Tells of',
    cell: ({ events, min_severity, site }) =>
      `${events.join(', ')} ${min_severity === 'info' ? '' : `from ${min_severity} on `}at ${site ?? 'all sites'}`,
    essential: false,
  },
];

export function ChannelsView() {
  const cursor = useSelect((state) => state.location.query['cursor']);
  const page = useResource(address('/api/v1/channels', { query: { cursor, limit: 100 } }));
  return (
    <>
      <div class="view-head">
        <h1>Channels</h1>
        <span class="muted">who is told</span>
        <span class="spacer" />
        <a class="button" href="/deliveries">
          What was sent
        </a>
        <a class="button primary" href="/channels/new">
          New channel
        </a>
      </div>
      <DataTable
        caption="channels"
        page={page}
        columns={kColumns}
        rowKey={({ id }) => id}
        searchText={({ name, kind, site }) => `${name} ${kind} ${site ?? ''}`}
        empty={
          <EmptyPanel title="Nobody is told yet.">
            <p>By a channel, alerts go to a webhook, by mail, or to an MQTT broker.</p>
            <a href="/channels/new">Make the first one</a>
          </EmptyPanel>
        }
      />
    </>
  );
}
