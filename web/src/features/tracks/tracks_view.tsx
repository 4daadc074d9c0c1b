// Changes through time: what appeared or went away, since when, and whether it is still so.

import { useResource, useSelect } from '../../app/app';
import { address, type Schema } from '../../lib/api';
import { count, duration, placeMetres, sizeMetres, volume } from '../../lib/format';
import { historyLink, pointPlace } from '../../lib/place';
import { KindBadge } from '../../ui/badges';
import { type Column, DataTable } from '../../ui/data_table';
import { ChoiceFilter, SiteFilter, TimeFilter } from '../../ui/filters';
import { EmptyPanel, noneOf } from '../../ui/states';
import { Time } from '../../ui/time';
import { lastedSeconds } from '../../ui/track_figures';
import { TrackStateBadge } from './track_state';

type Track = Schema<'Track'>;

const kKinds: readonly Schema<'ChangeKind'>[] = ['added', 'removed', 'discrepancy'];
const kStates: readonly { value: Schema<'TrackState'>; words: string }[] = [
  { value: 'open', words: 'still so' },
  { value: 'gone', words: 'gone' },
  { value: 'accepted', words: 'accepted as normal' },
];

const kColumns: readonly Column<Track>[] = [
  { head: 'Track', cell: ({ id }) => <a href={`/tracks/${id}`}>{id}</a> },
  { head: 'Kind', cell: ({ kind }) => <KindBadge kind={kind} /> },
  { head: 'State', cell: (track) => <TrackStateBadge track={track} /> },
  { head: 'First seen', cell: ({ first_seen_at, site }) => <Time at={first_seen_at} site={site} /> },
  {
    head: 'Last seen',
    cell: ({ last_seen_at, site }) => <Time at={last_seen_at} site={site} />,
    essential: false,
  },
  { head: 'Lasted', cell: (track) => duration(lastedSeconds(track)), numeric: true, essential: false },
  { head: 'Seen in', cell: ({ seen }) => `${count(seen)}\u00a0×`, numeric: true, essential: false },
  { head: 'Size', cell: ({ size_m }) => sizeMetres(size_m), numeric: true, essential: false },
  { head: 'Volume of its box', cell: ({ volume_m3 }) => volume(volume_m3), numeric: true, essential: false },
  {
    head: 'Place, and its history',
    cell: ({ site, centroid_m }) => (
      <a href={historyLink(site, pointPlace(centroid_m))} title="The history of this place">
        {placeMetres(centroid_m)}
      </a>
    ),
    essential: false,
  },
];

export function TracksView() {
  const { site, kind, state, from, to, cursor } = useSelect((all) => all.location.query);
  const page = useResource(
    address('/api/v1/tracks', {
      query: {
        site,
        kind: kKinds.find((each) => each === kind),
        state: kStates.find(({ value }) => value === state)?.value,
        from,
        to,
        cursor,
        limit: 50,
      },
    }),
  );
  return (
    <>
      <div class="view-head">
        <h1>Tracks</h1>
        <span class="muted">changes followed from scan to scan</span>
      </div>
      <DataTable
        caption="tracks"
        page={page}
        columns={kColumns}
        rowKey={({ id }) => id}
        filters={
          <>
            <SiteFilter />
            <ChoiceFilter name="kind" all="any kind" choices={kKinds} />
            <ChoiceFilter name="state" all="any state" choices={kStates} />
            <TimeFilter />
          </>
        }
        empty={
          <EmptyPanel title={noneOf('track', [site, kind, state, from, to, cursor])}>
            <p>A track begins when a scan shows something that differs from what is normal.</p>
          </EmptyPanel>
        }
      />
    </>
  );
}
