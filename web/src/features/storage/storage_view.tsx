// What is stored, how much room is left and for how long; what is kept, and what was deleted.

import './storage.css';
import { setQuery, useResource, useSelect } from '../../app/app';
import { useAskAgain } from '../../app/polling';
import { useSites } from '../../app/sites';
import { address, type Schema } from '../../lib/api';
import { bytes, count, counted, percent } from '../../lib/format';
import { type Column, DataTable } from '../../ui/data_table';
import { EmptyState, Loaded } from '../../ui/states';
import { Time } from '../../ui/time';
import { RetentionPanel } from './retention_panel';
import { sharesOf } from './shares';

type Storage = Schema<'Storage'>;
type Deletion = Schema<'Deletion'>;

const kStorage = address('/api/v1/storage');
/** No event tells that the disk fills. */
const kAskEveryMs = 30_000;

export function StorageView() {
  const sites = useSites();
  const query = useSelect((state) => state.location.query);
  const site = query['site'] ?? sites[0]?.name;
  const storage = useResource(kStorage);
  useAskAgain(kStorage, kAskEveryMs);
  return (
    <>
      <div class="view-head">
        <h1>Storage</h1>
        <span class="muted">what is kept, and how much room is left</span>
      </div>
      <div class="panels">
        <section class="panel" aria-labelledby="room">
          <header class="panel-head">
            <h2 id="room">Room</h2>
          </header>
          <div class="panel-body storage-room">
            <Loaded of={storage} what="figures">
              {(data) => <Room storage={data} />}
            </Loaded>
          </div>
        </section>
        {site !== undefined && (
          <RetentionPanel key={site} site={site} onSite={(name) => setQuery({ site: name, cursor: undefined })} />
        )}
        <section class="panel panel-wide" aria-labelledby="deletions">
          <header class="panel-head">
            <h2 id="deletions">What was deleted</h2>
          </header>
          <div class="panel-body">
            <Deletions site={query['site']} cursor={query['cursor']} />
          </div>
        </section>
      </div>
    </>
  );
}

function Room({ storage }: { storage: Storage }) {
  const { disk, sites, events } = storage;
  const shares = sharesOf(storage);
  const perDay = sites.reduce((sum, { bytes_per_day }) => sum + (bytes_per_day ?? 0), 0);
  const isTight = disk.free_bytes < 2 * disk.reserve_bytes;
  return (
    <>
      <dl class="figures">
        <div>
          <dt>Free</dt>
          <dd class={isTight ? 'field-bad' : undefined}>
            {bytes(disk.free_bytes)} of {bytes(disk.bytes)} ({percent(disk.free_bytes / disk.bytes)})
          </dd>
        </div>
        <div>
          <dt>Full in</dt>
          <dd>{disk.days_to_full === null ? 'cannot tell yet' : counted(Math.floor(disk.days_to_full), 'day')}</dd>
        </div>
        <div>
          <dt>Comes in a day</dt>
          <dd>{perDay === 0 ? 'too little to tell' : bytes(perDay)}</dd>
        </div>
        <div>
          <dt>New scans are refused below</dt>
          <dd>{bytes(disk.reserve_bytes)} free</dd>
        </div>
      </dl>
      <div class="storage-bar" aria-hidden="true">
        {shares
          .filter((share) => share.bytes > 0)
          .map((share) => (
            <span
              key={share.name}
              class={`storage-${share.look}`}
              style={{ flexGrow: String(share.bytes / disk.bytes) }}
            />
          ))}
      </div>
      <dl class="storage-shares">
        {shares.map((share) => (
          <div key={share.name}>
            <dt>
              <span class={`storage-key storage-${share.look}`} aria-hidden="true" /> {share.name}
            </dt>
            <dd>{bytes(share.bytes)}</dd>
          </div>
        ))}
      </dl>
      <p class="muted">
        {counted(events.events, 'event')} ({bytes(events.estimated_bytes)}) {events.events === 1 ? 'is' : 'are'} among
        “all but the points”
        {events.oldest_at !== null && (
          <>
            , the oldest of <Time at={events.oldest_at} site={undefined} />
          </>
        )}
        .
      </p>
    </>
  );
}

const kReasons: Readonly<Record<Deletion['reason'], string>> = {
  operator: 'by hand',
  age: 'for its age',
  bytes: 'for the room that points take',
  free_disk: 'to keep the disk free',
};

const kColumns: readonly Column<Deletion>[] = [
  { head: 'When', cell: ({ at, site }) => <Time at={at} site={site ?? undefined} /> },
  {
    head: 'What',
    cell: ({ what, scan, sensor, records }) =>
      what === 'scan'
        ? `scan ${scan ?? ''} of ${sensor ?? ''}`
        : what === 'events'
          ? counted(records, 'event')
          : counted(records, 'record of deletions', 'records of deletions'),
  },
  { head: 'Why', cell: ({ reason }) => kReasons[reason] },
  {
    head: 'Taken',
    cell: ({ captured_at, site }) => captured_at !== null && <Time at={captured_at} site={site ?? undefined} />,
    essential: false,
  },
  { head: 'Room', cell: ({ bytes: size }) => bytes(size), numeric: true },
  { head: 'Record', cell: ({ id }) => count(id), numeric: true, essential: false },
];

function Deletions({ site, cursor }: { site: string | undefined; cursor: string | undefined }) {
  const page = useResource(address('/api/v1/storage/deletions', { query: { site, cursor, limit: 50 } }));
  return (
    <DataTable
      caption="deletions"
      page={page}
      columns={kColumns}
      rowKey={({ id }) => id}
      empty={<EmptyState title="Nothing was deleted yet." />}
    />
  );
}
