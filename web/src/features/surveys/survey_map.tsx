// The map of a survey: how far the ground rose or fell, or the heights of one of the epochs, and what lies where somebody
// points.

import { useEffect, useMemo, useState } from 'preact/hooks';
import { setQuery, useResource, useSelect } from '../../app/app';
import { address, fetchBytes, type Schema } from '../../lib/api';
import { metres } from '../../lib/format';
import { Problem } from '../../lib/problem';
import { ErrorState, Loading } from '../../ui/states';
import { type Place } from '../../ui/top_view/frame';
import { MapCanvas } from '../../ui/top_view/map_canvas';
import { drawOverlays, type Overlay } from '../../ui/top_view/overlays';
import { type Drawing } from '../../ui/top_view/picture';
import { Coordinates } from './badges';
import { useVolumeZones } from './data';
import { boundsOfGrid, cellAt, type Grid, isChanged, parseGrid, sightOf } from './grid';
import { cellColours, heightRange, heightsAsCss, kSteps, kUnchanged, type MapKind, paintCells } from './map_paint';
import { riseMetres } from './words';

const kKinds: readonly { readonly kind: MapKind; readonly words: string }[] = [
  { kind: 'difference', words: 'Difference' },
  { kind: 'before', words: 'Before' },
  { kind: 'after', words: 'After' },
];

/** The latest grids: going to another survey and back asks for none again. */
const known = new Map<number, Grid>();
const kMostKnown = 4;

function useGrid(survey: number): Grid | Problem | undefined {
  const [found, setFound] = useState<Grid | Problem | undefined>(known.get(survey));
  useEffect(() => {
    if (known.has(survey)) return;
    const ending = new AbortController();
    const from = address('/api/v1/surveys/{id}/dod', { path: { id: survey }, query: { format: 'bin' } });
    fetchBytes(from, ending.signal).then(
      (bytes) => {
        const grid = parseGrid(bytes);
        for (const oldest of [...known.keys()].slice(0, Math.max(0, known.size + 1 - kMostKnown))) known.delete(oldest);
        known.set(survey, grid);
        setFound(grid);
      },
      (failure) => {
        if (failure instanceof Problem) setFound(failure);
      },
    );
    return () => ending.abort();
  }, [survey]);
  return found;
}

export function SurveyMap({ survey }: { survey: Schema<'SurveyDetail'> }) {
  const grid = useGrid(survey.id);
  const asked = useSelect((state) => state.location.query['map']);
  const kind = kKinds.find((each) => each.kind === asked)?.kind ?? 'difference';
  return (
    <section class="panel survey-map" aria-labelledby="map">
      <header class="panel-head">
        <h2 id="map">Map</h2>
        <div class="actions" role="group" aria-label="What the map shows">
          {kKinds.map((each) => (
            <button
              key={each.kind}
              type="button"
              aria-pressed={each.kind === kind}
              onClick={() => setQuery({ map: each.kind === 'difference' ? undefined : each.kind }, { replace: true })}
            >
              {each.words}
            </button>
          ))}
        </div>
        <span class="spacer" />
        <Coordinates site={survey.site} />
      </header>
      {grid === undefined ? (
        <Loading what="map" />
      ) : grid instanceof Problem ? (
        <ErrorState problem={grid} />
      ) : (
        <div class="survey-map-body">
          <DifferenceMap grid={grid} kind={kind} survey={survey} />
          <Legend grid={grid} kind={kind} />
        </div>
      )}
    </section>
  );
}

function useOverlays(survey: Schema<'SurveyDetail'>): readonly Overlay[] {
  const zones = useVolumeZones(survey.site);
  const changes = useResource(
    address('/api/v1/surveys/{id}/changes', { path: { id: survey.id }, query: { limit: 200 } }),
  ).data?.items;
  return useMemo(() => {
    const surveyed = survey.ground.survey.zones;
    const shown = zones.filter(({ id }) => surveyed.length === 0 || surveyed.includes(id));
    const outlines = shown.map(({ name, polygon_m }): Overlay => ({
      kind: 'outline',
      corners_m: polygon_m as unknown as Place[],
      closed: true,
      tone: 'volume',
      ...(shown.length > 1 ? { label: name } : {}),
    }));
    const boxes = (changes ?? []).map(({ box, kind }, index): Overlay => ({
      kind: 'box',
      box,
      tone: kind === 'removed' ? 'removed' : 'added',
      label: `${index + 1}`,
    }));
    return [...outlines, ...boxes];
  }, [zones.length, changes, survey]);
}

function DifferenceMap({ grid, kind, survey }: { grid: Grid; kind: MapKind; survey: Schema<'SurveyDetail'> }) {
  const overlays = useOverlays(survey);
  const colours = useMemo(() => cellColours(grid, kind), [grid, kind]);
  const drawing = useMemo(
    (): Drawing => ({
      bounds_m: boundsOfGrid(grid),
      paint: (pixels, frame, scale) => paintCells(pixels, frame, scale, grid, colours),
      drawOver: (context, frame) => drawOverlays(context, frame, overlays, true),
    }),
    [grid, colours, overlays],
  );
  const shows = {
    difference: 'The difference of both epochs',
    before: 'The earlier ground',
    after: 'The later ground',
  };
  return (
    <MapCanvas
      label={`${shows[kind]} from above, north up`}
      drawing={drawing}
      inWords={(place) => placeInWords(grid, place)}
      foot={<span class="survey-hint">point, or move by arrow keys, to read a cell</span>}
    />
  );
}

const kSights = {
  both: 'seen in both epochs, but not compared',
  before: 'not seen in the later epoch',
  after: 'not seen in the earlier epoch',
  neither: 'not seen in either epoch',
};

/** "x 3.10 m, y −20.00 m; −2.13 m, surely (from 0.08 m on); 12.10 m before, 9.97 m after". */
export function placeInWords(grid: Grid, place: Place): string {
  const where = `x ${metres(place[0], 1)}, y ${metres(place[1], 1)}`;
  const cell = cellAt(grid, place);
  if (cell === undefined) return `${where}; outside of the map`;
  const height = (value: number | undefined): string => metres((value ?? NaN) + grid.zero_m);
  const rise = grid.rise_m[cell] ?? NaN;
  const heights = [[grid.before_m[cell], 'before'] as const, [grid.after_m[cell], 'after'] as const].flatMap(
    ([value, when]) => (Number.isNaN(value) ? [] : [`${height(value)} ${when}`]),
  );
  if (Number.isNaN(rise)) return [where, kSights[sightOf(grid, cell)], ...heights].join('; ');
  const sure = isChanged(grid, cell) ? 'changed' : 'no sure change';
  return `${where}; ${riseMetres(rise)}, ${sure} (detected from ${metres(grid.lod95_m[cell] ?? NaN)} on); ${heights.join(', ')}`;
}

const css = (rgb: readonly number[]): string => `rgb(${rgb.join(' ')})`;

function Legend({ grid, kind }: { grid: Grid; kind: MapKind }) {
  const [low, high] = heightRange(grid);
  return (
    <div class="survey-legend">
      {kind === 'difference' ? (
        <ul aria-label="Legend, in metres of height">
          {[...kSteps].reverse().map(({ colour, words }) => (
            <li key={colour.join()}>
              <span class="survey-swatch" style={{ background: css(colour) }} /> {words}
            </li>
          ))}
          <li>
            <span class="survey-swatch" style={{ background: css(kUnchanged) }} /> no sure change
          </li>
          <li>
            <span class="survey-swatch survey-unseen" /> not seen in both epochs
          </li>
        </ul>
      ) : (
        <ul aria-label="Legend">
          <li class="survey-heights">
            <span style={{ backgroundImage: heightsAsCss() }} />
            height {metres(low + grid.zero_m, 1)} to {metres(high + grid.zero_m, 1)}
          </li>
          <li>
            <span class="survey-swatch survey-unseen" /> not seen
          </li>
        </ul>
      )}
      <p class="muted">Cells of {metres(grid.cell_m)}; shaded by a light from the north-west.</p>
      <p class="muted">Lines: zones, and boxes of changes with their numbers in the table.</p>
    </div>
  );
}
