// What counts as normal at each site: every version, by whom, when and why; and learning it anew.

import { useState } from 'preact/hooks';
import { loader, setQuery, showToast, useResource, useSelect } from '../../app/app';
import { attempt } from '../../app/attempt';
import { withOperator } from '../../app/operator';
import { useChosenSite } from '../../app/sites';
import { address, type Schema, send } from '../../lib/api';
import { counted, placeMetres } from '../../lib/format';
import { StateBadge } from '../../ui/badges';
import { ConfirmDialog } from '../../ui/confirm_dialog';
import { type Column, DataTable } from '../../ui/data_table';
import { AtSite } from '../../ui/at_site';
import { SitePicker } from '../../ui/site_picker';
import { EmptyPanel } from '../../ui/states';
import { Time } from '../../ui/time';

type Baseline = Schema<'Baseline'>;

const kColumns: readonly Column<Baseline>[] = [
  { head: 'Version', cell: ({ version }) => version },
  { head: 'Kind', cell: ({ kind }) => <StateBadge>{kind}</StateBadge> },
  { head: 'Made', cell: ({ made_at, site }) => <Time at={made_at} site={site} /> },
  { head: 'By', cell: ({ by }) => by },
  { head: 'Why', cell: ({ note }) => note, essential: false },
  { head: 'Scans that stand for it', cell: (baseline) => <Entries baseline={baseline} />, essential: false },
];

function Entries({ baseline }: { baseline: Baseline }) {
  if (baseline.entries.length === 0) return <span class="muted">none: nothing is normal yet</span>;
  return (
    <details>
      <summary>{counted(baseline.entries.length, 'entry', 'entries')}</summary>
      <ul>
        {baseline.entries.map((entry, index) => (
          <li key={index}>
            <a href={`/scans/${entry.scan}`}>scan {entry.scan}</a>, vantage {entry.vantage}, {entry.origin},{' '}
            {entry.region_m === null
              ? 'all of it'
              : `from ${placeMetres(entry.region_m.min)} to ${placeMetres(entry.region_m.max)}`}
          </li>
        ))}
      </ul>
    </details>
  );
}

export function BaselinesView() {
  const query = useSelect((state) => state.location.query);
  const site = useChosenSite();
  const page = useResource(
    site === undefined
      ? undefined
      : address('/api/v1/baselines', { query: { site, cursor: query['cursor'], limit: 50 } }),
  );
  const [asking, setAsking] = useState(false);
  return (
    <>
      <div class="view-head">
        <h1>Baselines</h1>
        <span class="muted">what counts as normal</span>
      </div>
      <AtSite site={site}>
        {(name) => (
          <DataTable
            caption={`versions of what is normal at ${name}`}
            page={page}
            columns={kColumns}
            rowKey={({ version }) => version}
            searchText={({ by, note, kind }) => `${by} ${note} ${kind}`}
            filters={
              <>
                <SitePicker site={name} onSite={(chosen) => setQuery({ cursor: undefined, site: chosen })} />
                <button type="button" onClick={() => setAsking(true)}>
                  Learn anew …
                </button>
              </>
            }
            empty={
              <EmptyPanel title="Nothing is normal yet.">
                <p>It is learned from the first scans of each vantage.</p>
              </EmptyPanel>
            }
          />
        )}
      </AtSite>
      {asking && site !== undefined && (
        <ConfirmDialog
          draft=""
          about="the version"
          title={`Learn anew what is normal at ${site}`}
          words="Nothing is normal from now on, and the next scans of each vantage are learned. Until then nothing raises an alert there. Versions before stay in this list."
          doIt="Learn anew"
          onClose={() => setAsking(false)}
          onConfirm={(note) => {
            setAsking(false);
            withOperator((by) => void learnAnew(site, by, note));
          }}
        />
      )}
    </>
  );
}

async function learnAnew(site: string, by: string, note: string): Promise<void> {
  await attempt(async () => {
    const body = { by, mode: 'learn' as const, ...(note === '' ? {} : { note }) };
    await send('post', '/api/v1/baselines/{name}/accept', { path: { name: site }, body });
    showToast('good', `What is normal at ${site} is learned anew.`);
  });
  loader.invalidate((key) => key.startsWith('/api/v1/baselines'));
}
