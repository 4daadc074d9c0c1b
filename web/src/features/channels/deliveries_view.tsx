import './channels.css';
import { setQuery, useResource, useSelect } from '../../app/app';
import { address, type Schema } from '../../lib/api';
import { DeliveryTable } from './delivery_table';

const kStates: readonly Schema<'DeliveryState'>[] = ['pending', 'sending', 'delivered', 'failed', 'dropped'];

/** What was sent, to whom, and what became of it. The filters stand in the link. */
export function DeliveriesView() {
  const query = useSelect((state) => state.location.query);
  const channels = useResource(address('/api/v1/channels', { query: { limit: 1000 } })).data?.items ?? [];
  const number = (name: string): number | undefined => (query[name] === undefined ? undefined : Number(query[name]));
  const set = (name: string, value: string): void => setQuery({ cursor: undefined, [name]: value || undefined });
  return (
    <>
      <div class="view-head">
        <h1>Deliveries</h1>
        <span class="muted">what was sent to channels; times in UTC</span>
      </div>
      <DeliveryTable
        channel={number('channel')}
        alert={number('alert')}
        state={kStates.find((state) => state === query['state'])}
        cursor={query['cursor']}
        limit={100}
        filters={
          <>
            <select
              aria-label="Channel"
              value={query['channel'] ?? ''}
              onChange={(event) => set('channel', event.currentTarget.value)}
            >
              <option value="">all channels</option>
              {channels.map(({ id, name }) => (
                <option key={id} value={id}>
                  {name}
                </option>
              ))}
            </select>
            <select
              aria-label="State"
              value={query['state'] ?? ''}
              onChange={(event) => set('state', event.currentTarget.value)}
            >
              <option value="">any state</option>
              {kStates.map((state) => (
                <option key={state} value={state}>
                  {state}
                </option>
              ))}
            </select>
            {query['alert'] !== undefined && (
              <button type="button" onClick={() => set('alert', '')}>
                Only alert {query['alert']}: show all
              </button>
            )}
          </>
        }
      />
    </>
  );
}
