// A list as a table: columns, a search in what is shown, and pages by the API's cursors, which stand in the link.

import { type ComponentChildren } from 'preact';
import { useState } from 'preact/hooks';
import { setQuery, useSelect } from '../app/app';
import { type Resource } from '../lib/resources';
import { EmptyState, ErrorState, Loading } from './states';

export interface Column<Row> {
  readonly head: string;
  readonly cell: (row: Row) => ComponentChildren;
  /** Figures stand to the right. */
  readonly numeric?: boolean;
  /** On narrow screens these columns only. */
  readonly essential?: boolean;
}

export interface DataTableProps<Row> {
  /** Says what the table lists, for those who hear it. */
  caption: string;
  page: Resource<{ items: Row[]; next: string | null }>;
  columns: readonly Column<Row>[];
  rowKey: (row: Row) => string | number;
  /** The text in which the search looks; without it there is no search. */
  searchText?: (row: Row) => string;
  empty: ComponentChildren;
  /** Filters of the view, beside the search. */
  filters?: ComponentChildren;
}

export function DataTable<Row>(props: DataTableProps<Row>) {
  const [search, setSearch] = useState('');
  const { page } = props;
  const words = search.toLowerCase().split(/\s+/).filter(Boolean);
  const found = (page.data?.items ?? []).filter((row) => {
    const text = props.searchText?.(row).toLowerCase() ?? '';
    return words.every((word) => text.includes(word));
  });
  return (
    <div class="data-table">
      <div class="toolbar">
        {props.searchText && (
          <input
            type="search"
            placeholder="Search in this page"
            aria-label={`Search in ${props.caption}`}
            value={search}
            onInput={(event) => setSearch(event.currentTarget.value)}
          />
        )}
        {props.filters}
      </div>
      {page.data ? (
        <Rows {...props} found={found} searching={words.length > 0} />
      ) : page.problem ? (
        <ErrorState problem={page.problem} />
      ) : (
        <Loading what={props.caption} />
      )}
      <Pages next={page.data?.next ?? null} />
    </div>
  );
}

function Rows<Row>({
  caption,
  columns,
  rowKey,
  found,
  searching,
  empty,
}: DataTableProps<Row> & { found: readonly Row[]; searching: boolean }) {
  if (found.length === 0)
    return searching ? <EmptyState title="Nothing in this page has all of these words." /> : <>{empty}</>;
  const cellClass = (column: Column<Row>): string =>
    `${column.numeric ? 'numeric ' : ''}${column.essential === false ? 'not-narrow' : ''}`.trim();
  return (
    <div class="table-scroll" tabIndex={0} role="region" aria-label={caption}>
      <table>
        <caption class="visually-hidden">{caption}</caption>
        <thead>
          <tr>
            {columns.map((column) => (
              <th key={column.head} scope="col" class={cellClass(column)}>
                {column.head}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {found.map((row) => (
            <tr key={rowKey(row)}>
              {columns.map((column) => (
                <td key={column.head} class={cellClass(column)}>
                  {column.cell(row)}
                </td>
              ))}
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

function Pages({ next }: { next: string | null }) {
  const cursor = useSelect((state) => state.location.query['cursor']);
  if (cursor === undefined && next === null) return null;
  return (
    <nav class="pages" aria-label="Pages">
      <button type="button" disabled={cursor === undefined} onClick={() => setQuery({ cursor: undefined })}>
        First page
      </button>
      <button type="button" disabled={next === null} onClick={() => setQuery({ cursor: next ?? undefined })}>
        Next page
      </button>
    </nav>
  );
}
