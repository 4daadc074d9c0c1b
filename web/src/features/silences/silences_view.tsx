// Planned work: no alert from a site, zone or sensor until a time. What still lasts then is told then.

import { useState } from 'preact/hooks';
import { showToast, useResource, useSelect } from '../../app/app';
import { attempt } from '../../app/attempt';
import { address, type Schema, send } from '../../lib/api';
import { StateBadge } from '../../ui/badges';
import { type Column, DataTable } from '../../ui/data_table';
import { EmptyPanel } from '../../ui/states';
import { Time } from '../../ui/time';
import { NewSilence, silencesAreOld } from './new_silence';

type Silence = Schema<'Silence'>;

function useColumns(): readonly Column<Silence>[] {
  const now_ms = useSelect((state) => state.now_ms);
  const zones = useResource(address('/api/v1/zones', { query: { limit: 1000 } })).data?.items ?? [];
  const isOver = (silence: Silence): boolean => Date.parse(silence.until) <= now_ms;
  const isAhead = (silence: Silence): boolean => Date.parse(silence.from) > now_ms;
  return [
    {
      head: 'Now',
      cell: (silence) =>
        isOver(silence) ? (
          <StateBadge>over</StateBadge>
        ) : isAhead(silence) ? (
          <StateBadge>ahead</StateBadge>
        ) : (
          <StateBadge tone="busy">silent</StateBadge>
        ),
    },
    {
      head: 'What is silent',
      cell: ({ site, zone, sensor }) =>
        [
          site,
          zone === null ? '' : `zone ${zones.find(({ id }) => id === zone)?.name ?? zone}`,
          sensor === null ? '' : `sensor ${sensor}`,
        ]
          .filter(Boolean)
          .join(' · '),
    },
    { head: 'From', cell: ({ from, site }) => <Time at={from} site={site} />, essential: false },
    { head: 'Until', cell: ({ until, site }) => <Time at={until} site={site} /> },
    { head: 'By', cell: ({ by }) => by, essential: false },
    { head: 'Why', cell: ({ note }) => note, essential: false },
    {
      head: 'End',
      cell: (silence) => (
        <button
          type="button"
          disabled={isOver(silence)}
          aria-label={`End silence ${silence.id}`}
          onClick={() => void end(silence.id)}
        >
          End
        </button>
      ),
    },
  ];
}

async function end(id: number): Promise<void> {
  await attempt(async () => {
    await send('delete', '/api/v1/silences/{id}', { path: { id } });
    showToast('good', 'The silence was ended.');
  });
  silencesAreOld();
}

export function SilencesView() {
  const cursor = useSelect((state) => state.location.query['cursor']);
  const page = useResource(address('/api/v1/silences', { query: { cursor, limit: 100 } }));
  const columns = useColumns();
  const [asking, setAsking] = useState(false);
  return (
    <>
      <div class="view-head">
        <h1>Silences</h1>
        <span class="muted">planned work raises no alert</span>
        <span class="spacer" />
        <button type="button" class="primary" onClick={() => setAsking(true)}>
          New silence
        </button>
      </div>
      <DataTable
        caption="silences"
        page={page}
        columns={columns}
        rowKey={({ id }) => id}
        searchText={({ site, sensor, by, note }) => `${site} ${sensor ?? ''} ${by} ${note}`}
        empty={<EmptyPanel title="Nothing is silent." />}
      />
      {asking && <NewSilence onClose={() => setAsking(false)} />}
    </>
  );
}
