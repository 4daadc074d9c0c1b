import type { Schema } from '../../lib/api';
import type { Place } from '../../ui/top_view/frame';
import type { Overlay } from '../../ui/top_view/overlays';

export const placesOf = ({ polygon_m }: Pick<Schema<'Zone'>, 'polygon_m'>): readonly Place[] =>
  polygon_m.map(([x = 0, y = 0]) => [x, y]);

/** A zone as it is drawn on a picture from above. */
export const asOverlay = (zone: Schema<'Zone'>, chosen = false): Overlay => ({
  kind: 'outline',
  corners_m: placesOf(zone),
  tone: zone.kind,
  label: zone.name,
  chosen,
});
