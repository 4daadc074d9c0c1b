// What the table of views loads in one piece.

export { NewZoneView, ZoneView } from './zone_view';
export { ZonesView } from './zones_view';
