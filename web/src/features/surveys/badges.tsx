import { useSelect } from '../../app/app';
import { useSites, useZone } from '../../app/sites';
import { clockOf, dateTime, dayOf } from '../../lib/format';
import { StateBadge } from '../../ui/badges';
import { kRunStates, type Level, type RunState } from './words';

const kShapes: Readonly<Record<Level, string>> = { green: '●', yellow: '◆', orange: '▲', red: '■' };

/** A level in a word with a shape: colour is not the only difference. */
export const LevelBadge = ({ level }: { level: Level }) => (
  <span class={`badge level-${level}`}>
    <span aria-hidden="true">{kShapes[level]}</span> {level}
  </span>
);

export const RunBadge = ({ state }: { state: RunState }) => (
  <StateBadge tone={kRunStates[state].tone}>{kRunStates[state].words}</StateBadge>
);

/** A night by its day, with its hour beneath, in the site's zone. */
export function NightTime({ at, site }: { at: string; site: string }) {
  const zone = useZone(site);
  const now_ms = useSelect((state) => state.now_ms);
  return (
    <time dateTime={at} title={`${dateTime(at, zone)} (${zone}); ${at}`} class="survey-night">
      {dayOf(at, zone, now_ms)}
      <span class="survey-under">{clockOf(at, zone)}</span>
    </time>
  );
}

/** In which coordinates the results of a site are. */
export function Coordinates({ site }: { site: string }) {
  const known = useSites().find(({ name }) => name === site);
  const words = known?.mine_grid ? 'a local mine grid' : known?.epsg ? `EPSG:${known.epsg}` : `those of ${site}`;
  return (
    <span class="muted">
      coordinates: <a href={`/sites/${encodeURIComponent(site)}`}>{words}</a>, in metres
    </span>
  );
}
