import './scans.css';
import { useResource, useSelect } from '../../app/app';
import { address, type Schema } from '../../lib/api';
import { count } from '../../lib/format';
import { type Column, DataTable } from '../../ui/data_table';
import { SensorFilter, SiteFilter, TimeFilter } from '../../ui/filters';
import { EmptyPanel, noneOf } from '../../ui/states';
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
        filters={
          <>
            <SiteFilter />
            <SensorFilter />
            <TimeFilter />
          </>
        }
        empty={<EmptyPanel title={noneOf('scan', [site, sensor, from, to, cursor])} />}
      />
    </>
  );
}
