// Changes as a list: where, how large, how sure, and the ways to each.

import { type ComponentChildren } from 'preact';
import { type Schema } from '../lib/api';
import { count, percent, placeMetres, sizeMetres, volume } from '../lib/format';
import { historyLink, pointPlace } from '../lib/place';
import { type Resource } from '../lib/resources';
import { KindBadge } from './badges';
import { type Column, DataTable } from './data_table';
import { Time } from './time';
import { ViewLink } from './view_link';

type Change = Schema<'Change'>;

const kChange: Column<Change> = {
  head: 'Change',
  cell: ({ id }) => <ViewLink to={`/changes/${id}`}>{id}</ViewLink>,
};
const kScan: Column<Change> = {
  head: 'Taken',
  cell: ({ scan, captured_at, site }) => (
    <a href={`/scans/${scan}`}>
      <Time at={captured_at} site={site} />
    </a>
  ),
};
const kTrack: Column<Change> = {
  head: 'Track',
  cell: ({ track }) => (track === null ? '' : <ViewLink to={`/tracks/${track}`}>{track}</ViewLink>),
  essential: false,
};
const kFigures: readonly Column<Change>[] = [
  { head: 'Kind', cell: ({ kind }) => <KindBadge kind={kind} /> },
  { head: 'Size', cell: ({ size_m }) => sizeMetres(size_m), numeric: true, essential: false },
  { head: 'Volume of its box', cell: ({ volume_m3 }) => volume(volume_m3), numeric: true },
  { head: 'Points', cell: ({ points }) => count(points), numeric: true },
  { head: 'Confidence', cell: ({ confidence }) => percent(confidence.value), numeric: true, essential: false },
  {
    head: 'Place, and its history',
    cell: ({ centroid_m, site }) => (
      <a href={historyLink(site, pointPlace(centroid_m))} title="The history of this place">
        {placeMetres(centroid_m)}
      </a>
    ),
    essential: false,
  },
];

export interface ChangesTableProps {
  caption: string;
  page: Resource<{ items: Change[]; next: string | null }>;
  /** What all have in common, and need not be said of each. */
  of: 'comparison' | 'track';
  empty: ComponentChildren;
}

export function ChangesTable({ caption, page, of, empty }: ChangesTableProps) {
  const columns = of === 'track' ? [kChange, kScan, ...kFigures] : [kChange, ...kFigures, kTrack];
  return <DataTable caption={caption} page={page} columns={columns} rowKey={({ id }) => id} empty={empty} />;
}
