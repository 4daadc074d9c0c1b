import { useResource, useSelect } from '../../app/app';
import { address, type Schema } from '../../lib/api';
import { PanoramaPanel } from './panorama';

/** Outlines beyond these would hide the picture. */
const kMostOutlined = 100;

const changesOf = (id: number) =>
  address('/api/v1/comparisons/{id}/changes', { path: { id }, query: { limit: kMostOutlined } });

/** A scan's panorama with what the comparison that is shown found. */
export function ScanPanorama({ scan }: { scan: Schema<'Scan'> }) {
  const asked = useSelect((state) => state.location.query['comparison']);
  const comparison = asked === undefined ? scan.comparison : Number(asked);
  const changes = useResource(comparison === null ? undefined : changesOf(comparison));
  return (
    <div class="panel-wide">
      <PanoramaPanel scan={scan.id} changes={changes.data?.items ?? []} />
    </div>
  );
}

/** What a sensor saw last. */
export function LatestPanorama({ sensor }: { sensor: string }) {
  const scans = useResource(address('/api/v1/scans', { query: { sensor, limit: 1 } }));
  const latest = scans.data?.items[0];
  return latest ? <ScanPanorama scan={latest} /> : null;
}
