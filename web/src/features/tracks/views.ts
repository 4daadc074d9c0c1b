// Loaded together, when the first of them is shown.

export { TrackView } from './track_view';
export { TracksView } from './tracks_view';
