// Any scan with any earlier scans, with parameters of one's own.

import './comparisons.css';
import { useResource, useSelect } from '../../app/app';
import { useSites, useZone } from '../../app/sites';
import { address, type Schema } from '../../lib/api';
import { EmptyPanel, ErrorState, Loading } from '../../ui/states';
import { CompareForm } from './compare_form';
import { draftLike, draftOf } from './request';

export function CompareView() {
  const query = useSelect((state) => state.location.query);
  const like = Number(query['like']) || undefined;
  return (
    <>
      <div class="view-head">
        <h1>Compare by hand</h1>
        <span class="muted">any scan with any earlier scans, with parameters of your own</span>
      </div>
      {like === undefined ? <Fresh key={JSON.stringify(query)} query={query} /> : <Like key={like} id={like} />}
    </>
  );
}

/** Without a scan in the link, the latest one. */
function Fresh({ query }: { query: Readonly<Record<string, string>> }) {
  const sites = useSites();
  const latest = useResource(
    query['scan'] === undefined ? address('/api/v1/scans', { query: { limit: 1, site: query['site'] } }) : undefined,
  );
  if (query['scan'] === undefined && latest.data === undefined) {
    return latest.problem ? <ErrorState problem={latest.problem} /> : <Loading what="latest scan" />;
  }
  const scan = query['scan'] ?? latest.data?.items[0]?.id;
  if (scan === undefined || sites.length === 0) {
    return (
      <EmptyPanel title="No scan is stored yet.">
        <p>
          <a href="/scans">Upload the first ones</a>
        </p>
      </EmptyPanel>
    );
  }
  return <CompareForm initial={draftOf({ ...query, scan: String(scan) })} />;
}

function Like({ id }: { id: number }) {
  const comparison = useResource(address('/api/v1/comparisons/{id}', { path: { id } }));
  if (comparison.data) return <Again comparison={comparison.data} />;
  return comparison.problem ? <ErrorState problem={comparison.problem} /> : <Loading what="comparison" />;
}

function Again({ comparison }: { comparison: Schema<'Comparison'> }) {
  const zone = useZone(comparison.site);
  const sites = useSites();
  const defaults = useResource(
    address('/api/v1/sites/{name}/parameters', {
      path: { name: comparison.site },
      query: { grouping: comparison.parameters.grouping },
    }),
  );
  if (!defaults.data || sites.length === 0) {
    return defaults.problem ? <ErrorState problem={defaults.problem} /> : <Loading what="parameters" />;
  }
  return <CompareForm initial={draftLike(comparison, defaults.data, zone)} />;
}
