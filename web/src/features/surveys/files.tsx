// What goes out of a survey, to download.

import { type Schema } from '../../lib/api';
import { Coordinates } from './badges';

const kFiles: readonly { readonly name: string; readonly words: string; readonly more: string }[] = [
  { name: 'bundle.zip', words: 'All but the points', more: 'ZIP' },
  { name: 'report.html', words: 'Report', more: 'HTML, one file, prints on A4' },
  { name: 'dod.tif', words: 'Difference', more: 'GeoTIFF: rise, level of detection' },
  { name: 'before.tif', words: 'Ground before', more: 'GeoTIFF' },
  { name: 'after.tif', words: 'Ground after', more: 'GeoTIFF' },
  { name: 'before.las', words: 'Points before', more: 'LAS 1.4, with classes' },
  { name: 'after.las', words: 'Points after', more: 'LAS 1.4, with classes' },
  { name: 'map.geojson', words: 'Zones and changes', more: 'GeoJSON' },
  { name: 'zones.csv', words: 'Figures of zones', more: 'CSV' },
  { name: 'changes.csv', words: 'Changes', more: 'CSV' },
];

export function Files({ survey: { id, site } }: { survey: Schema<'SurveyDetail'> }) {
  return (
    <section class="panel survey-files" aria-labelledby="files">
      <header class="panel-head">
        <h2 id="files">Files</h2>
        <Coordinates site={site} />
      </header>
      <ul class="panel-body">
        {kFiles.map(({ name, words, more }) => (
          <li key={name}>
            <a href={`/api/v1/surveys/${id}/${name}`} download={`survey-${id}-${name}`}>
              {words}
            </a>{' '}
            <span class="muted">{more}</span>
          </li>
        ))}
      </ul>
    </section>
  );
}
