// What is said beside the picture: what was measured or found, what could not be loaded, and why there is no picture.

import { type ComponentChildren } from 'preact';
import { metres, placeMetres } from '../../lib/format';
import { type Vector3 } from '../../lib/points/quantised';
import { Icon } from '../../ui/icon';
import { ViewLink } from '../../ui/view_link';
import { type Measuring, measureOf } from './measuring';
import { type Loading } from './use_layers';

export function MeasureNote({ measuring }: { measuring: Measuring }) {
  return (
    <p class="scene-note" role="status">
      {measuring.step === 'first' && 'Click a point, or bring it to the cross and press Enter.'}
      {measuring.step === 'second' && 'Now the other point.'}
      {measuring.step === 'done' && <Measured {...measuring} />}
      <span class="scene-note-hint">Escape ends it.</span>
    </p>
  );
}

function Measured(between: { from_m: Vector3; to_m: Vector3 }) {
  const { length_m, level_m, rise_m } = measureOf(between);
  return (
    <>
      <b class="scene-measure">{metres(length_m, 3)}</b> {metres(level_m, 3)} level, {metres(Math.abs(rise_m), 3)}{' '}
      {rise_m < 0 ? 'down' : 'up'}
    </>
  );
}

export function Found({ place_m, site, onClose }: { place_m: Vector3; site: string; onClose: () => void }) {
  return (
    <p class="scene-note" role="status">
      {placeMetres(place_m)}{' '}
      <ViewLink
        to={`/history?site=${encodeURIComponent(site)}&point=${place_m.map((part) => part.toFixed(3)).join(',')}`}
      >
        This place through time
      </ViewLink>
      <button type="button" class="quiet" aria-label="Close" onClick={onClose}>
        <Icon name="close" />
      </button>
    </p>
  );
}

export function Notices({ loading }: { loading: Loading }) {
  return (
    <>
      {loading.problems.map(({ what, problem }) => (
        <p key={what} class="scene-note scene-note-bad" role="alert">
          <b>{what}:</b> {problem.message}
        </p>
      ))}
    </>
  );
}

/** Where there can be no picture: why, and what stands for it. */
export function NoPicture({
  lost,
  retry,
  children,
}: {
  lost: boolean;
  retry: () => void;
  children?: ComponentChildren;
}) {
  return (
    <div class="scene-without panel">
      <div class="placeholder" role="status">
        <Icon name="change" />
        <p class="placeholder-title">
          {lost ? 'The graphics card took the picture away.' : 'There is no 3D picture here.'}
        </p>
        <p>
          {lost
            ? 'That happens when it is overloaded, or after sleep. The figures are complete without it.'
            : 'This browser offers no WebGL 2; it may be switched off in its settings. The figures are complete without it.'}
        </p>
        <button type="button" onClick={retry}>
          Try again
        </button>
      </div>
      {children}
    </div>
  );
}
