// Every comparison: of which scan, with what, and what came of it.

import './comparisons.css';
import { useResource, useSelect } from '../../app/app';
import { useZone } from '../../app/sites';
import { address, type Schema } from '../../lib/api';
import { count, counted, duration, percent } from '../../lib/format';
import { referenceInWords } from '../../lib/reference';
import { type Column, DataTable } from '../../ui/data_table';
import { ChoiceFilter, SiteFilter } from '../../ui/filters';
import { EmptyPanel, noneOf } from '../../ui/states';
import { Ago } from '../../ui/time';
import { ComparisonStateBadge } from './comparison_state';
import { ScanFilter } from './scan_filter';

type Comparison = Schema<'Comparison'>;

const kStates: readonly Schema<'ComparisonState'>[] = ['queued', 'running', 'done', 'failed'];

const kColumns: readonly Column<Comparison>[] = [
  { head: 'Comparison', cell: ({ id }) => <a href={`/comparisons/${id}`}>{id}</a> },
  { head: 'Scan', cell: ({ scan }) => <a href={`/scans/${scan}`}>{scan}</a> },
  { head: 'With', cell: (comparison) => <ReferenceOf comparison={comparison} /> },
  { head: 'State', cell: (comparison) => <ComparisonStateBadge comparison={comparison} /> },
  { head: 'Found', cell: ({ changes }) => counted(changes, 'change'), numeric: true },
  { head: 'Could be judged', cell: ({ testable }) => percent(testable, 1), numeric: true, essential: false },
  { head: 'Priors', cell: ({ priors }) => count(priors.length), numeric: true, essential: false },
  { head: 'Grouping', cell: ({ parameters }) => parameters.grouping, essential: false },
  { head: 'Asked for', cell: ({ created_at, site }) => <Ago at={created_at} site={site} />, essential: false },
  {
    head: 'Took',
    cell: ({ timings_ms }) =>
      timings_ms['total'] === undefined ? '' : duration(Math.max(0.001, timings_ms['total'] / 1000)),
    numeric: true,
    essential: false,
  },
];

function ReferenceOf({ comparison }: { comparison: Comparison }) {
  return <>{referenceInWords(comparison.reference, useZone(comparison.site))}</>;
}

export function ComparisonsView() {
  const { site, scan, state, cursor } = useSelect((all) => all.location.query);
  const page = useResource(
    address('/api/v1/comparisons', {
      query: {
        site,
        scan: scan === undefined ? undefined : Number(scan),
        state: kStates.find((each) => each === state),
        cursor,
        limit: 50,
      },
    }),
  );
  return (
    <>
      <div class="view-head">
        <h1>Comparisons</h1>
        <span class="spacer" />
        <a class="button primary" href="/compare">
          Compare by hand
        </a>
      </div>
      <DataTable
        caption="comparisons"
        page={page}
        columns={kColumns}
        rowKey={({ id }) => id}
        filters={
          <>
            <SiteFilter />
            <ScanFilter />
            <ChoiceFilter name="state" all="any state" choices={kStates} />
          </>
        }
        empty={
          <EmptyPanel title={noneOf('comparison', [site, scan, state, cursor])}>
            <p>Every scan that is stored is compared by itself.</p>
          </EmptyPanel>
        }
      />
    </>
  );
}
