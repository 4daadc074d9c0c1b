import { type Schema } from '../../lib/api';
import { metres, squareMetres } from '../../lib/format';
import { area } from './polygon';
import { placesOf } from './overlays';

/** "24 m², from −0.50 m to 3.00 m". */
export const extentInWords = (zone: Pick<Schema<'Zone'>, 'polygon_m' | 'z_min_m' | 'z_max_m'>): string =>
  `${squareMetres(area(placesOf(zone)))}, from ${metres(zone.z_min_m)} to ${metres(zone.z_max_m)}`;
