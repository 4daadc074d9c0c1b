// Planned work: no alert from a site, zone or sensor until a time. What still lasts then is told then.

import { useState } from 'preact/hooks';
import { loader, showProblem, showToast, useResource, useSelect } from '../../app/app';
import { withOperator } from '../../app/operator';
import { useSites, useZone } from '../../app/sites';
import { address, type Schema, send } from '../../lib/api';
import { Problem } from '../../lib/problem';
import { localOf, momentOf } from '../../lib/zone';
import { StateBadge } from '../../ui/badges';
import { type Column, DataTable } from '../../ui/data_table';
import { Dialog } from '../../ui/dialog';
import { EmptyState } from '../../ui/states';
import { Time } from '../../ui/time';

type Silence = Schema<'Silence'>;

const stale = (): void => loader.invalidate((key) => key.startsWith('/api/v1/silences'));

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
  try {
    await send('delete', '/api/v1/silences/{id}', { path: { id } });
    showToast('good', 'The silence was ended.');
  } catch (failure) {
    if (!(failure instanceof Problem)) throw failure;
    showProblem(failure);
  }
  stale();
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
        empty={
          <div class="panel">
            <EmptyState title="Nothing is silent." />
          </div>
        }
      />
      {asking && <NewSilence onClose={() => setAsking(false)} />}
    </>
  );
}

function NewSilence({ onClose }: { onClose: () => void }) {
  const sites = useSites();
  const now_ms = useSelect((state) => state.now_ms);
  const [chosenSite, setSite] = useState<string | undefined>();
  const site = chosenSite ?? sites[0]?.name ?? '';
  const time_zone = useZone(site);
  const [of, setOf] = useState(''); // "sensor:NAME", "zone:ID", or all of the site
  const [chosenEnd, setUntil] = useState<string | undefined>();
  const until = chosenEnd ?? localOf(new Date(now_ms + 2 * 3_600_000), time_zone);
  const [note, setNote] = useState('');
  const [problem, setProblem] = useState<Problem | undefined>();
  const sensors = useResource(address('/api/v1/sensors', { query: { site, limit: 1000 } })).data?.items ?? [];
  const zones = useResource(address('/api/v1/zones', { query: { site, limit: 1000 } })).data?.items ?? [];
  const make = async (by: string): Promise<void> => {
    const [kind, ...name] = of.split(':');
    try {
      await send('post', '/api/v1/silences', {
        body: {
          site,
          by,
          until: momentOf(until, time_zone).toISOString(),
          ...(kind === 'sensor' ? { sensor: name.join(':') } : {}),
          ...(kind === 'zone' ? { zone: Number(name[0]) } : {}),
          ...(note === '' ? {} : { note }),
        },
      });
      stale();
      onClose();
    } catch (failure) {
      if (!(failure instanceof Problem)) throw failure;
      setProblem(failure);
    }
  };
  return (
    <Dialog title="New silence" onClose={onClose}>
      <form
        onSubmit={(event) => {
          event.preventDefault();
          withOperator((by) => void make(by));
        }}
      >
        <label class="field">
          Site
          <select data-first value={site} onChange={(event) => setSite(event.currentTarget.value)}>
            {sites.map(({ name }) => (
              <option key={name} value={name}>
                {name}
              </option>
            ))}
          </select>
        </label>
        <label class="field">
          What of it
          <select value={of} onChange={(event) => setOf(event.currentTarget.value)}>
            <option value="">all of it</option>
            {sensors.map(({ name }) => (
              <option key={name} value={`sensor:${name}`}>
                sensor {name}
              </option>
            ))}
            {zones.map(({ id, name }) => (
              <option key={id} value={`zone:${id}`}>
                zone {name}
              </option>
            ))}
          </select>
        </label>
        <label class="field">
          Until ({time_zone})
          <input
            type="datetime-local"
            required
            value={until}
            onInput={(event) => setUntil(event.currentTarget.value)}
          />
        </label>
        <label class="field">
          Why
          <textarea rows={2} maxLength={2000} value={note} onInput={(event) => setNote(event.currentTarget.value)} />
        </label>
        {problem && (
          <p class="field-bad" role="alert">
            {problem.fields.map(({ field, message }) => `${field} ${message}`).join('; ') || problem.message}
          </p>
        )}
        <div class="actions">
          <button type="submit" class="primary">
            Keep silent
          </button>
          <button type="button" onClick={onClose}>
            Cancel
          </button>
        </div>
      </form>
    </Dialog>
  );
}
