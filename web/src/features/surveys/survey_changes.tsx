// What changed between both epochs, piece by piece, each with its own volume.

import { useResource, useSelect } from '../../app/app';
import { address, type Schema } from '../../lib/api';
import { count, percent, placeMetres, sizeMetres, squareMetres } from '../../lib/format';
import { historyLink, pointPlace } from '../../lib/place';
import { KindBadge } from '../../ui/badges';
import { type Column, DataTable } from '../../ui/data_table';
import { EmptyState } from '../../ui/states';
import { cubicMetres, interval, tonnes } from './words';

interface Row {
  readonly number: number | undefined;
  readonly change: Schema<'SurveyChange'>;
}

const columnsFor = (site: string): readonly Column<Row>[] => [
  { head: 'Change', cell: ({ number }) => number ?? '', essential: false },
  {
    head: 'Kind and size',
    cell: ({ change }) => (
      <>
        <KindBadge kind={change.kind} />
        <span class="survey-under">{sizeMetres(change.size_m)}</span>
      </>
    ),
  },
  {
    head: 'Net',
    cell: ({ change: { net } }) => (
      <>
        {cubicMetres(net.value_m3, true)}
        <span class="survey-under">{interval(net.low_m3, net.high_m3, 'm³', true)}</span>
      </>
    ),
    numeric: true,
  },
  {
    head: 'Mass',
    cell: ({ change: { mass } }) => (mass ? tonnes(mass.value_t, true) : ''),
    numeric: true,
    essential: false,
  },
  {
    head: 'Area, seen',
    cell: ({ change: { area_m2, seen_area_m2 } }) => (
      <>
        {squareMetres(area_m2)}
        <span class="survey-under">{percent(area_m2 > 0 ? seen_area_m2 / area_m2 : 0)}</span>
      </>
    ),
    numeric: true,
    essential: false,
  },
  {
    head: 'Points, confidence',
    cell: ({ change: { points, confidence } }) => (
      <>
        {count(points)}
        <span class="survey-under">{percent(confidence.value)}</span>
      </>
    ),
    numeric: true,
    essential: false,
  },
  {
    head: 'Place, and its history',
    cell: ({ change }) => (
      <a href={historyLink(site, pointPlace(change.centroid_m))} title="The history of this place">
        {placeMetres(change.centroid_m)}
      </a>
    ),
  },
];

export function SurveyChanges({ survey }: { survey: Schema<'SurveyDetail'> }) {
  const cursor = useSelect((state) => state.location.query['cursor']);
  const page = useResource(
    address('/api/v1/surveys/{id}/changes', { path: { id: survey.id }, query: { limit: 200, cursor } }),
  );
  // The map has those of the first page.
  const rows = (found: Schema<'SurveyChange'>[]): Row[] =>
    found.map((change, index) => ({ number: cursor === undefined ? index + 1 : undefined, change }));
  const { data, ...rest } = page;
  return (
    <section class="panel panel-wide" aria-labelledby="changes">
      <header class="panel-head">
        <h2 id="changes">Changes</h2>
        <span class="muted">between the grounds of both epochs, over the footprint of each</span>
      </header>
      <div class="panel-body">
        <DataTable
          caption={`changes of survey ${survey.id}`}
          page={data ? { ...rest, data: { next: data.next, items: rows(data.items) } } : rest}
          columns={columnsFor(survey.site)}
          rowKey={({ change }) => change.centroid_m.join()}
          empty={<EmptyState title="Nothing surely changed." />}
        />
      </div>
    </section>
  );
}
