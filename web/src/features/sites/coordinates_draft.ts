// In which coordinates the files of a site's surveys go out, as it is filled in: numbers are texts until they are sent.

import type { Schema } from '../../lib/api';
import type { Difference } from '../../ui/edited_elsewhere';

type Site = Schema<'Site'>;
export type Coordinates = Pick<Site, 'epsg' | 'mine_grid'>;
type Texts3 = readonly [string, string, string];

export interface CoordinatesDraft {
  readonly kind: 'own' | 'epsg' | 'mine_grid';
  readonly epsg: string;
  readonly site_origin_m: Texts3;
  readonly grid_origin_m: Texts3;
  readonly rotation_deg: string;
  readonly scale: string;
}

const texts3 = (values: readonly number[] | undefined): Texts3 => {
  const [x = '', y = '', z = ''] = values?.map(String) ?? [];
  return [x, y, z];
};

export function draftOf({ epsg, mine_grid, origin_m }: Coordinates & Pick<Site, 'origin_m'>): CoordinatesDraft {
  return {
    kind: mine_grid ? 'mine_grid' : epsg === null ? 'own' : 'epsg',
    epsg: epsg === null ? '' : String(epsg),
    site_origin_m: texts3(mine_grid?.site_origin_m ?? origin_m ?? undefined),
    grid_origin_m: texts3(mine_grid?.grid_origin_m),
    rotation_deg: String(mine_grid?.rotation_deg ?? 0),
    scale: String(mine_grid?.scale ?? 1),
  };
}

/** A site has one kind of coordinates: the other is taken away. */
export function bodyOf(draft: CoordinatesDraft): { epsg: number | null; mine_grid: Site['mine_grid'] } {
  const numbers = (texts: Texts3): [number, number, number] => [Number(texts[0]), Number(texts[1]), Number(texts[2])];
  return {
    epsg: draft.kind === 'epsg' ? Number(draft.epsg) : null,
    mine_grid:
      draft.kind === 'mine_grid'
        ? {
            site_origin_m: numbers(draft.site_origin_m),
            grid_origin_m: numbers(draft.grid_origin_m),
            rotation_deg: Number(draft.rotation_deg),
            scale: Number(draft.scale),
          }
        : null,
  };
}

const isNumber = (text: string): boolean => text.trim() !== '' && Number.isFinite(Number(text));

/** What is wrong before anything is sent, by the daemon's own names of fields. */
export function faultsOf(draft: CoordinatesDraft): Readonly<Record<string, string>> {
  const faults: Record<string, string> = {};
  if (draft.kind === 'epsg' && !isNumber(draft.epsg)) faults['epsg'] = 'needs a code, such as 28350';
  if (draft.kind !== 'mine_grid') return faults;
  for (const origin of ['site_origin_m', 'grid_origin_m'] as const)
    if (!draft[origin].every(isNumber)) faults[`mine_grid.${origin}`] = 'needs three numbers';
  for (const number of ['rotation_deg', 'scale'] as const)
    if (!isNumber(draft[number])) faults[`mine_grid.${number}`] = 'needs a number';
  return faults;
}

/** What lies 100 m along the site's x in the grid, as a check; nothing while a number is missing. */
export function hundredAlongX({ rotation_deg, scale }: CoordinatesDraft): readonly [number, number] | undefined {
  if (!isNumber(rotation_deg) || !isNumber(scale)) return undefined;
  const angle = (Number(rotation_deg) * Math.PI) / 180;
  return [100 * Number(scale) * Math.cos(angle), 100 * Number(scale) * Math.sin(angle)];
}

/** "EPSG:28350", "a local mine grid, turned by 23.5°". */
export function coordinatesInWords({ epsg, mine_grid }: Coordinates): string {
  if (mine_grid) return `a local mine grid, turned by ${mine_grid.rotation_deg}°`;
  return epsg === null ? 'those of the site' : `EPSG:${epsg}`;
}

export const isSame = (one: Coordinates, other: Coordinates): boolean =>
  JSON.stringify([one.epsg, one.mine_grid]) === JSON.stringify([other.epsg, other.mine_grid]);

/** What differs between what is there and what is filled in. */
export function differencesOf(theirs: Coordinates, mine: Coordinates): Difference[] {
  const row = (name: string, of: (site: Coordinates) => string): Difference => ({
    name,
    theirs: of(theirs),
    mine: of(mine),
  });
  return [
    row('Coordinates', coordinatesInWords),
    row('Place in the site', ({ mine_grid }) => mine_grid?.site_origin_m.join(', ') ?? ''),
    row('The same in the grid', ({ mine_grid }) => mine_grid?.grid_origin_m.join(', ') ?? ''),
    row('Scale', ({ mine_grid }) => String(mine_grid?.scale ?? '')),
  ];
}
