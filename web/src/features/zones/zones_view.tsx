// The zones of a site on its picture from above, and as a list.

import './zones.css';
import { navigate, setQuery, useResource, useSelect } from '../../app/app';
import { linkTo } from '../../app/router';
import { useChosenSite } from '../../app/sites';
import { address, type Schema } from '../../lib/api';
import { percent } from '../../lib/format';
import { StateBadge } from '../../ui/badges';
import { type Column, DataTable } from '../../ui/data_table';
import { AtSite } from '../../ui/at_site';
import { EmptyPanel } from '../../ui/states';
import { Ago } from '../../ui/time';
import { useScene } from '../../ui/top_view/scene';
import { TopView } from '../../ui/top_view/top_view';
import { SitePicker } from '../../ui/site_picker';
import { extentInWords } from './extent_words';
import { asOverlay, placesOf } from './overlays';
import { isInside } from './polygon';

type Zone = Schema<'Zone'>;

const kColumns: readonly Column<Zone>[] = [
  { head: 'Zone', cell: ({ id, name }) => <a href={`/zones/${id}`}>{name}</a> },
  { head: 'Kind', cell: ({ kind }) => <StateBadge>{kind}</StateBadge> },
  { head: 'Area and heights', cell: extentInWords, essential: false },
  { head: 'Seen by the latest scan', cell: (zone) => <LatestCoverage zone={zone} /> },
  { head: 'Edited', cell: ({ edited_at, site }) => <Ago at={edited_at} site={site} />, essential: false },
];

function LatestCoverage({ zone }: { zone: Zone }) {
  const page = useResource(address('/api/v1/zones/{id}/coverage', { path: { id: zone.id }, query: { limit: 1 } }));
  const latest = page.data?.items[0];
  if (!latest) return <span class="muted">{page.data ? 'no scan since' : '…'}</span>;
  return (
    <span class="share" title={`scan ${latest.scan}`}>
      <meter min={0} max={1} value={latest.share} aria-label="share that could be judged" /> {percent(latest.share)}
    </span>
  );
}

export function ZonesView() {
  const query = useSelect((state) => state.location.query);
  const site = useChosenSite();
  const page = useResource(
    site === undefined ? undefined : address('/api/v1/zones', { query: { site, cursor: query['cursor'], limit: 200 } }),
  );
  const scene = useScene(site);
  const zones = page.data?.items ?? [];
  return (
    <>
      <div class="view-head">
        <h1>Zones</h1>
        <span class="muted">where rules look, and where not</span>
        <span class="spacer" />
        <a class="button primary" href={linkTo('/zones/new', { site })}>
          New zone
        </a>
      </div>
      <AtSite site={site}>
        {(name) => (
          <div class="zones">
            <TopView
              scene={scene}
              label={`${name} from above, with its zones`}
              overlays={zones.map((zone) => asOverlay(zone))}
              onPick={({ place_m }) => {
                const hit = zones.filter((zone) => isInside(placesOf(zone), place_m)).at(-1);
                if (hit) navigate(`/zones/${hit.id}`);
              }}
            />
            <DataTable
              caption={`zones of ${name}`}
              page={page}
              columns={kColumns}
              rowKey={({ id }) => id}
              searchText={({ name, kind }) => `${name} ${kind}`}
              filters={<SitePicker site={name} onSite={(chosen) => setQuery({ site: chosen, cursor: undefined })} />}
              empty={
                <EmptyPanel title="No zone yet: rules look everywhere.">
                  <a href={linkTo('/zones/new', { site: name })}>Draw the first one</a>
                </EmptyPanel>
              }
            />
          </div>
        )}
      </AtSite>
    </>
  );
}
