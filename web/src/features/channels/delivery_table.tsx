import { useEffect } from 'preact/hooks';
import { loader, showToast, useResource } from '../../app/app';
import { attempt } from '../../app/attempt';
import { withOperator } from '../../app/operator';
import { useSites } from '../../app/sites';
import { address, type Schema, send } from '../../lib/api';
import { count } from '../../lib/format';
import { StateBadge } from '../../ui/badges';
import { type Column, DataTable } from '../../ui/data_table';
import { EmptyState } from '../../ui/states';
import { Time } from '../../ui/time';

type Delivery = Schema<'Delivery'>;

const kTones = { pending: 'busy', sending: 'busy', delivered: 'good', failed: 'bad', dropped: 'bad' } as const;
/** No event tells how a message fares. */
const kAskEveryMs = 5_000;

async function retry(id: number, by: string): Promise<void> {
  await attempt(async () => {
    await send('post', '/api/v1/deliveries/{id}/retry', { path: { id }, body: { by } });
    showToast('good', 'It waits to be sent again.');
  });
  loader.invalidate((key) => key.startsWith('/api/v1/deliveries'));
}

/** What the latest attempt brought: "200 after 12 ms", or why it failed. */
function Answer({ delivery, site }: { delivery: Delivery; site: string | undefined }) {
  const { response_code, took_ms, error, next_attempt_at } = delivery;
  const answer = [
    response_code === null ? '' : String(response_code),
    took_ms === null ? '' : `after ${count(took_ms)}\u00a0ms`,
  ]
    .filter(Boolean)
    .join(' ');
  return (
    <>
      {answer}
      {error !== null && <span class="delivery-error">{error}</span>}
      {next_attempt_at !== null && (
        <span class="muted">
          next try at <Time at={next_attempt_at} site={site} />
        </span>
      )}
    </>
  );
}

/** In whose zone the times of a delivery are: its channel's site, or the only one; UTC where there are several. */
function useSiteOf(): (delivery: Delivery) => string | undefined {
  const channels = useResource(address('/api/v1/channels', { query: { limit: 1000 } })).data?.items ?? [];
  const sites = useSites();
  const only = sites.length === 1 ? sites[0]?.name : undefined;
  return ({ channel }) => channels.find(({ id }) => id === channel)?.site ?? only;
}

const columnsFor = (siteOf: (delivery: Delivery) => string | undefined): readonly Column<Delivery>[] => [
  { head: 'Since', cell: (delivery) => <Time at={delivery.created_at} site={siteOf(delivery)} /> },
  {
    head: 'State',
    cell: ({ state }) => <StateBadge tone={kTones[state]}>{state}</StateBadge>,
  },
  {
    head: 'What',
    cell: ({ type, alert }) =>
      alert === null ? (
        type
      ) : (
        <>
          {type}, <a href={`/alerts/${alert}`}>alert {alert}</a>
        </>
      ),
  },
  {
    head: 'To',
    cell: ({ channel, channel_name }) =>
      channel_name === null ? (
        <span class="muted">deleted channel {channel}</span>
      ) : (
        <a href={`/channels/${channel}`}>{channel_name}</a>
      ),
    essential: false,
  },
  { head: 'Attempts', cell: ({ attempts }) => attempts, numeric: true, essential: false },
  { head: 'Answer', cell: (delivery) => <Answer delivery={delivery} site={siteOf(delivery)} />, essential: false },
  {
    head: 'Again',
    cell: ({ id, state, channel_name }) =>
      (state === 'failed' || state === 'dropped') &&
      channel_name !== null && (
        <button
          type="button"
          aria-label={`Send delivery ${id} again`}
          onClick={() => withOperator((by) => void retry(id, by))}
        >
          Send again
        </button>
      ),
  },
];

export interface DeliveryTableProps {
  channel?: number | undefined;
  state?: Schema<'DeliveryState'> | undefined;
  alert?: number | undefined;
  cursor?: string | undefined;
  limit: number;
  filters?: preact.ComponentChildren;
}

/** The log of what was sent, or waits; of one channel without its name in each row. */
export function DeliveryTable({ filters, ...query }: DeliveryTableProps) {
  const page = useResource(address('/api/v1/deliveries', { query }));
  useEffect(() => {
    const timer = setInterval(() => loader.invalidate((key) => key.startsWith('/api/v1/deliveries')), kAskEveryMs);
    return () => clearInterval(timer);
  }, []);
  const columns = columnsFor(useSiteOf());
  const isShort = filters === undefined;
  return (
    <DataTable
      caption="deliveries"
      page={isShort && page.data ? { ...page, data: { ...page.data, next: null } } : page}
      columns={isShort ? columns.filter(({ head }) => head !== 'To' && head !== 'Attempts') : columns}
      rowKey={({ id }) => id}
      filters={filters}
      empty={
        <EmptyState title="Nothing was sent.">
          <p>Each message stands here from the moment at which it waits.</p>
        </EmptyState>
      }
    />
  );
}
