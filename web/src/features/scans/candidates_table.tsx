// Every earlier scan that was considered, its figures, and why it was used or not.

import { useResource } from '../../app/app';
import { address, type Schema } from '../../lib/api';
import { duration, metres, percent } from '../../lib/format';
import { StateBadge } from '../../ui/badges';
import { type Column, DataTable } from '../../ui/data_table';
import { EmptyState } from '../../ui/states';

type Candidate = Schema<'Candidate'>;

const kColumns: readonly Column<Candidate>[] = [
  {
    head: 'Used',
    cell: ({ chosen }) => (chosen ? <StateBadge tone="good">used</StateBadge> : <StateBadge>not used</StateBadge>),
  },
  { head: 'Scan', cell: ({ scan }) => <a href={`/scans/${scan}`}>{scan}</a> },
  { head: 'Vantage', cell: ({ vantage }) => vantage, numeric: true, essential: false },
  { head: 'Away', cell: ({ distance_m }) => metres(distance_m), numeric: true, essential: false },
  { head: 'Earlier by', cell: ({ age_s }) => duration(age_s), numeric: true },
  { head: 'Overlap', cell: ({ overlap }) => percent(overlap, 1), numeric: true },
  { head: 'Adds', cell: ({ gain }) => percent(gain, 1), numeric: true, essential: false },
  { head: 'Why', cell: ({ reason }) => reason },
];

export function CandidatesTable({ scan, comparison }: { scan: number; comparison: number }) {
  const candidates = useResource(
    address('/api/v1/scans/{id}/candidates', { path: { id: scan }, query: { comparison } }),
  );
  return (
    <div class="panel-body">
      <h3>Why these earlier scans</h3>
      <p class="muted">
        What share of the scan lies where an earlier one looked decides; then each is chosen for what it adds.
      </p>
      <DataTable
        caption="candidates"
        page={candidates}
        columns={kColumns}
        rowKey={({ scan: id }) => id}
        empty={<EmptyState title="No earlier scan was near enough to be considered." />}
      />
    </div>
  );
}
