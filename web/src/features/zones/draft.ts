// A zone as it is filled in: numbers are texts until they are sent.

import type { Schema } from '../../lib/api';
import { metres } from '../../lib/format';
import type { Difference } from '../../ui/edited_elsewhere';
import type { OutlineEdit } from './outline_edit';
import { area, crossing } from './polygon';

export interface ZoneDraft {
  readonly name: string;
  readonly kind: Schema<'ZoneKind'>;
  readonly z_min_m: string;
  readonly z_max_m: string;
}

export const draftOf = (zone: Schema<'Zone'>): ZoneDraft => ({
  name: zone.name,
  kind: zone.kind,
  z_min_m: String(zone.z_min_m),
  z_max_m: String(zone.z_max_m),
});

export const emptyDraft: ZoneDraft = { name: '', kind: 'alert', z_min_m: '', z_max_m: '' };

type ZoneField = 'name' | 'polygon_m' | 'z_min_m' | 'z_max_m';

/** What is wrong before anything is sent, in the daemon's own names of fields. */
export function faultsOf(draft: ZoneDraft, outline: OutlineEdit): Partial<Record<ZoneField, string>> {
  const faults: Partial<Record<ZoneField, string>> = {};
  if (draft.name.trim() === '') faults.name = 'needs a name';
  const crossed = crossing(outline.corners);
  if (outline.corners.length < 3) faults.polygon_m = 'needs at least 3 corners';
  else if (!outline.closed) faults.polygon_m = 'is open: close it at its first corner';
  else if (outline.corners.some((corner) => corner.some(Number.isNaN)))
    faults.polygon_m = 'has a corner without a number';
  else if (crossed)
    faults.polygon_m = `crosses itself: the sides after corners ${crossed[0] + 1} and ${crossed[1] + 1} meet`;
  else if (area(outline.corners) < 1e-6) faults.polygon_m = 'must enclose an area';
  for (const side of ['z_min_m', 'z_max_m'] as const)
    if (draft[side].trim() === '') faults[side] = 'needs a height in metres';
  if (!faults.z_min_m && !faults.z_max_m && Number(draft.z_min_m) >= Number(draft.z_max_m)) {
    faults.z_max_m = 'must be above the lower end';
  }
  return faults;
}

export const bodyOf = (draft: ZoneDraft, outline: OutlineEdit): Schema<'ZoneEdit'> => ({
  name: draft.name.trim(),
  kind: draft.kind,
  polygon_m: outline.corners.map(([x, y]) => [x, y]),
  z_min_m: Number(draft.z_min_m),
  z_max_m: Number(draft.z_max_m),
});

/** What differs between what is there and what is filled in. */
export function differencesOf(theirs: Schema<'ZoneEdit'>, mine: Schema<'ZoneEdit'>): Difference[] {
  const outline = ({ polygon_m }: Schema<'ZoneEdit'>): string =>
    `${polygon_m.length} corners: ${polygon_m.map((corner) => `(${corner.join(', ')})`).join(' ')}`;
  return [
    { name: 'Name', theirs: theirs.name, mine: mine.name },
    { name: 'Kind', theirs: theirs.kind, mine: mine.kind },
    { name: 'Outline', theirs: outline(theirs), mine: outline(mine) },
    { name: 'From', theirs: metres(theirs.z_min_m), mine: metres(mine.z_min_m) },
    { name: 'To', theirs: metres(theirs.z_max_m), mine: metres(mine.z_max_m) },
  ];
}
