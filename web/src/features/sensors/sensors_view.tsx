import { useResource, useSelect } from '../../app/app';
import { address, type Schema } from '../../lib/api';
import { duration, metres, placeMetres } from '../../lib/format';
import { type Column, DataTable } from '../../ui/data_table';
import { FirstScan } from '../../ui/at_site';
import { SiteFilter } from '../../ui/filters';
import { EmptyPanel } from '../../ui/states';

type Sensor = Schema<'Sensor'>;

const kColumns: readonly Column<Sensor>[] = [
  { head: 'Sensor', cell: ({ name }) => <a href={`/sensors/${encodeURIComponent(name)}`}>{name}</a> },
  { head: 'Site', cell: ({ site }) => <a href={`/sites/${encodeURIComponent(site)}`}>{site}</a> },
  {
    head: 'Stands at',
    cell: ({ pose }) => (pose ? placeMetres(pose.position_m) : <span class="muted">each scan says where</span>),
    essential: false,
  },
  {
    head: 'Usable range',
    cell: ({ min_range_m, max_range_m }) =>
      min_range_m === null && max_range_m === null ? (
        <span class="muted">by the profile</span>
      ) : (
        `${min_range_m === null ? '0 m' : metres(min_range_m)} to ${max_range_m === null ? 'any' : metres(max_range_m)}`
      ),
    essential: false,
  },
  {
    head: 'A scan every',
    cell: ({ interval_s }) => (interval_s === null ? <span class="muted">not said</span> : duration(interval_s)),
  },
];

export function SensorsView() {
  const site = useSelect((state) => state.location.query['site']);
  const cursor = useSelect((state) => state.location.query['cursor']);
  const page = useResource(address('/api/v1/sensors', { query: { site, cursor, limit: 200 } }));
  return (
    <>
      <div class="view-head">
        <h1>Sensors</h1>
      </div>
      <DataTable
        caption="sensors"
        page={page}
        columns={kColumns}
        rowKey={({ name }) => name}
        searchText={({ name, site: at }) => `${name} ${at}`}
        filters={<SiteFilter />}
        empty={
          <EmptyPanel title="There is no sensor yet.">
            <FirstScan of="One" />
          </EmptyPanel>
        }
      />
    </>
  );
}
