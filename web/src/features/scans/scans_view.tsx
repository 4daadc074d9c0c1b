import './scans.css';
import { setQuery, useResource, useSelect } from '../../app/app';
import { useSites, useZone } from '../../app/sites';
import { address, type Schema } from '../../lib/api';
import { count } from '../../lib/format';
import { localOf, momentOf } from '../../lib/zone';
import { type Column, DataTable } from '../../ui/data_table';
import { EmptyState } from '../../ui/states';
import { Time } from '../../ui/time';
import { RegistrationBadge, ScanStateBadge } from './badges';
import { UploadPanel } from './upload_panel';

type Scan = Schema<'Scan'>;

const kColumns: readonly Column<Scan>[] = [
  { head: 'Scan', cell: (scan) => <a href={`/scans/${scan.id}`}>{scan.id}</a> },
  { head: 'Taken', cell: (scan) => <Time at={scan.captured_at} site={scan.site} /> },
  { head: 'Sensor', cell: (scan) => <a href={`/sensors/${encodeURIComponent(scan.sensor)}`}>{scan.sensor}</a> },
  { head: 'Vantage', cell: (scan) => scan.vantage, numeric: true, essential: false },
  { head: 'Points', cell: (scan) => count(scan.points), numeric: true },
  { head: 'Fit', cell: (scan) => <RegistrationBadge registration={scan.registration} />, essential: false },
  { head: 'State', cell: (scan) => <ScanStateBadge scan={scan} /> },
  {
    head: 'Note',
    cell: (scan) => [scan.pinned ? 'pinned' : '', scan.note].filter(Boolean).join(': '),
    essential: false,
  },
];

export function ScansView() {
  const query = useSelect((state) => state.location.query);
  const { site, sensor, from, to, cursor } = query;
  const page = useResource(address('/api/v1/scans', { query: { site, sensor, from, to, cursor, limit: 50 } }));
  return (
    <>
      <div class="view-head">
        <h1>Scans</h1>
      </div>
      <UploadPanel />
      <DataTable
        caption="scans"
        page={page}
        columns={kColumns}
        rowKey={(scan) => scan.id}
        searchText={(scan) => `${scan.id} ${scan.sensor} ${scan.site} ${scan.state} ${scan.note} ${scan.sha256}`}
        filters={<ScanFilters />}
        empty={
          <div class="panel">
            <EmptyState title="No scan is like this." />
          </div>
        }
      />
    </>
  );
}

function ScanFilters() {
  const query = useSelect((state) => state.location.query);
  const sites = useSites();
  const sensors = useResource(address('/api/v1/sensors', { query: { limit: 1000 } })).data?.items ?? [];
  const zone = useZone(query['site'] ?? sites[0]?.name);
  const set = (name: string, value: string): void =>
    setQuery({ cursor: undefined, [name]: value === '' ? undefined : value });
  const choice = (name: 'site' | 'sensor', all: string, names: readonly string[]) => (
    <select aria-label={name} value={query[name] ?? ''} onChange={(event) => set(name, event.currentTarget.value)}>
      <option value="">{all}</option>
      {names.map((each) => (
        <option key={each} value={each}>
          {each}
        </option>
      ))}
    </select>
  );
  const time = (name: 'from' | 'to', words: string) => (
    <label class="inline-field">
      {words}
      <input
        type="datetime-local"
        value={query[name] === undefined ? '' : localOf(new Date(query[name]), zone)}
        onChange={(event) =>
          set(name, event.currentTarget.value && momentOf(event.currentTarget.value, zone).toISOString())
        }
      />
    </label>
  );
  return (
    <>
      {sites.length > 1 &&
        choice(
          'site',
          'all sites',
          sites.map((site) => site.name),
        )}
      {choice(
        'sensor',
        'all sensors',
        sensors.filter((sensor) => !query['site'] || sensor.site === query['site']).map(({ name }) => name),
      )}
      {time('from', 'from')}
      {time('to', 'to')}
      <span class="muted">{zone}</span>
    </>
  );
}
