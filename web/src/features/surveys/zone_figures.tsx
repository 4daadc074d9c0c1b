// All figures of a survey: a line each, a column for each zone and the total.

import { type ComponentChildren } from 'preact';
import { type Schema } from '../../lib/api';
import { count, metres, percent, squareMetres } from '../../lib/format';
import { type ZoneFigures as Zone } from './data';
import { cubicMetres, interval, riseMetres, tonnes } from './words';

interface Line {
  readonly name: string;
  readonly hint?: string;
  readonly cell: (zone: Zone) => ComponentChildren;
}

function Sure({ of, signed }: { of: Schema<'VolumeFigure'>; signed?: boolean }) {
  return (
    <>
      {cubicMetres(of.value_m3, signed)}
      <span class="survey-under">{interval(of.low_m3, of.high_m3, 'm³', signed)}</span>
    </>
  );
}

function Mass({ of, signed }: { of: Schema<'MassFigure'> | undefined; signed?: boolean }) {
  if (!of) return null;
  return (
    <>
      {tonnes(of.value_t, signed)}
      <span class="survey-under">{interval(of.low_t, of.high_t, 't', signed)}</span>
    </>
  );
}

const Extent = ({ of }: { of: Schema<'ChangeExtent'> }) => (
  <>
    {riseMetres(of.greatest_rise_m)}, {riseMetres(of.greatest_fall_m)}
    <span class="survey-under">mean {riseMetres(of.mean_m)}</span>
  </>
);

const kLines: readonly Line[] = [
  { name: 'Cut', cell: ({ cut }) => <Sure of={cut} /> },
  { name: 'Fill', cell: ({ fill }) => <Sure of={fill} /> },
  { name: 'Net', hint: 'of all that both epochs saw', cell: ({ net }) => <Sure of={net} signed /> },
  {
    name: 'Net of what changed',
    hint: 'of what surely changed',
    cell: ({ changed_net }) => <Sure of={changed_net} signed />,
  },
  {
    name: 'Net of what was not seen',
    hint: 'certain bounds',
    cell: ({ unseen }) => interval(unseen.low_m3, unseen.high_m3, 'm³', true),
  },
  {
    name: 'Net of the whole',
    hint: 'seen and not seen',
    cell: ({ whole }) => interval(whole.low_m3, whole.high_m3, 'm³', true),
  },
  {
    name: 'Seen in both epochs',
    cell: ({ seen_share, seen_area_m2, area_m2 }) => (
      <>
        {percent(seen_share, 1)}
        <span class="survey-under">
          {squareMetres(seen_area_m2)} of {squareMetres(area_m2)}
        </span>
      </>
    ),
  },
  { name: 'Changed area', cell: ({ changed_area_m2 }) => squareMetres(changed_area_m2) },
  { name: 'Greatest rise and fall', hint: 'vertically', cell: ({ vertical }) => <Extent of={vertical} /> },
  { name: 'Greatest rise and fall', hint: 'along the normal', cell: ({ normal }) => <Extent of={normal} /> },
  {
    name: 'M3C2',
    hint: 'core points',
    cell: ({ m3c2 }) => (
      <>
        {count(m3c2.significant)} changed of {count(m3c2.measured)}
        <span class="survey-under">
          mean {riseMetres(m3c2.mean_m)}, detected from {metres(m3c2.mean_lod95_m)} on
        </span>
      </>
    ),
  },
];
const kMasses: readonly Line[] = [
  { name: 'Cut', hint: 'in tonnes', cell: ({ masses }) => <Mass of={masses?.cut} /> },
  { name: 'Fill', hint: 'in tonnes', cell: ({ masses }) => <Mass of={masses?.fill} /> },
  { name: 'Net', hint: 'in tonnes', cell: ({ masses }) => <Mass of={masses?.net} signed /> },
];

export function ZoneFigures({ zones, total }: { zones: readonly Zone[]; total: Zone }) {
  // Of one zone the total says the same.
  const columns = zones.length === 1 ? zones : [...zones, total];
  const lines = total.masses ? [...kLines.slice(0, 3), ...kMasses, ...kLines.slice(3)] : kLines;
  return (
    <div class="table-scroll survey-figures" tabIndex={0} role="region" aria-label="figures of the zones">
      <table>
        <caption class="visually-hidden">Figures of the zones</caption>
        <thead>
          <tr>
            <th scope="col">Figure</th>
            {columns.map((zone) => (
              <th key={zone.zone} scope="col" class="numeric">
                {zone.zone === null ? zone.name : <a href={`/zones/${zone.zone}`}>{zone.name}</a>}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {lines.map(({ name, hint, cell }) => (
            <tr key={`${name} ${hint}`}>
              <th scope="row">
                {name} {hint && <span class="survey-under">{hint}</span>}
              </th>
              {columns.map((zone) => (
                <td key={zone.zone} class="numeric">
                  {cell(zone)}
                </td>
              ))}
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}
