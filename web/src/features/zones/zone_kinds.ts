// What each kind of zone is for, in words.

import { type Schema } from '../../lib/api';

type Kind = Schema<'ZoneKind'>;

export const kZoneKinds: readonly { readonly kind: Kind; readonly means: string }[] = [
  { kind: 'alert', means: 'Rules look here. A rule that names this zone tells only of what changes in it.' },
  { kind: 'ignore', means: 'Never tells. What changes here raises no alert, whatever other zones it lies in.' },
  {
    kind: 'control',
    means: 'Nothing may change here, such as a wall. If it does, the scan is suspect, not the world: it is not used.',
  },
  { kind: 'volume', means: 'Where volumes are measured. It neither raises nor holds back alerts.' },
];

export const meaningOf = (kind: Kind): string => kZoneKinds.find((entry) => entry.kind === kind)?.means ?? '';
