// A site from above: points by height, sensors, a scale, and what a view lays over them. Moved by mouse, touch and keys.

import './top_view.css';
import { type ComponentChildren } from 'preact';
import { useEffect, useLayoutEffect, useRef, useState } from 'preact/hooks';
import { metres } from '../../lib/format';
import { Icon } from '../icon';
import { ErrorState } from '../states';
import { type Bounds, type Place, zoomed } from './frame';
import { frameAfterKey, listenToGestures, type Tool } from './gestures';
import { type Overlay } from './overlays';
import { rampAsCss } from './paint';
import { Picture } from './picture';
import { type Scene } from './scene';

/** A place that somebody pointed at; the heights are undefined where nothing was seen. */
export interface PickedPlace {
  readonly place_m: Place;
  /** The lowest and the highest return there. */
  readonly ground_m: number | undefined;
  readonly top_m: number | undefined;
  /** How near to something counts as on it. */
  readonly reach_m: number;
}

export interface TopViewProps {
  scene: Scene;
  /** What the picture is for, for those who hear it. */
  label: string;
  overlays?: readonly Overlay[];
  /** Shown first; all of the site when it is not given. */
  focus_m?: Bounds | undefined;
  /** Points to stand out, of each cloud of the scene. */
  marks?: readonly Uint8Array[] | undefined;
  /** Somebody clicked, or pressed Enter with the place in the middle. */
  onPick?: (picked: PickedPlace) => void;
  tool?: Tool;
  /** A key that the picture does not use itself. @returns whether it was used. */
  onKey?: (event: KeyboardEvent) => boolean;
  /** Beside the buttons for the zoom. */
  children?: ComponentChildren;
}

const kNone: readonly Overlay[] = [];

export function TopView(props: TopViewProps) {
  const { scene, overlays = kNone, focus_m, marks } = props;
  const canvas = useRef<HTMLCanvasElement>(null);
  const readout = useRef<HTMLOutputElement>(null);
  const picture = useRef<Picture>();
  const current = useRef(props);
  current.current = props;
  const [crosshair, setCrosshair] = useState(false);
  const [cut_m, setCut] = useState(Infinity);

  const pick = (place_m: Place, reach_m: number): void => {
    const height = current.current.scene.ground?.at(place_m);
    current.current.onPick?.({ place_m, ground_m: height?.ground_m, top_m: height?.top_m, reach_m });
  };
  const tell = (place: Place | undefined): void => {
    if (readout.current) readout.current.textContent = place ? inWords(place, current.current.scene) : '';
  };
  useLayoutEffect(() => {
    if (!canvas.current) return;
    const shown = new Picture(canvas.current);
    picture.current = shown;
    const sizes = new ResizeObserver(() => shown.resized());
    sizes.observe(canvas.current);
    const deaf = listenToGestures(canvas.current, {
      frame: () => shown.frame(),
      setFrame: (frame) => shown.setFrame(frame),
      tool: () => current.current.tool,
      click: pick,
      hover: tell,
    });
    return () => {
      deaf();
      sizes.disconnect();
      shown.end();
    };
  }, []);
  useEffect(
    () => picture.current?.show({ scene, overlays, focus_m, cut_m, marks, crosshair }),
    [scene, overlays, focus_m, cut_m, marks, crosshair],
  );
  useEffect(() => setCut(Infinity), [scene]);

  const onKeyDown = (event: KeyboardEvent): void => {
    const plain = !event.altKey && !event.ctrlKey && !event.metaKey;
    const used = (plain && usesKey(event)) || (current.current.onKey?.(event) ?? false);
    if (!used) return;
    event.preventDefault();
    event.stopPropagation();
  };
  const usesKey = (event: KeyboardEvent): boolean => {
    const shown = picture.current;
    if (!shown) return false;
    const next = frameAfterKey(shown.frame(), event.key, event.shiftKey);
    if (next) {
      shown.setFrame(next);
      tell(next.centre_m);
    } else if (event.key === '0') shown.showAll();
    else if (event.key === 'Enter' && current.current.onPick) {
      const { centre_m, metres_per_pixel } = shown.frame();
      pick(centre_m, 9 * metres_per_pixel);
    } else return false;
    return true;
  };
  const zoom = (factor: number): void => {
    const frame = picture.current?.frame();
    if (frame) picture.current?.setFrame(zoomed(frame, factor, [frame.width_px / 2, frame.height_px / 2]));
  };
  return (
    <div class="top-view">
      <canvas
        ref={canvas}
        tabIndex={0}
        role="application"
        aria-label={`${props.label}. Arrow keys move it, plus and minus zoom, 0 shows all${props.onPick ? ', Enter takes the place in the middle' : ''}.`}
        onKeyDown={onKeyDown}
        onFocus={(event) => setCrosshair(event.currentTarget.matches(':focus-visible'))}
        onBlur={() => setCrosshair(false)}
      />
      <div class="top-view-tools">
        <button type="button" aria-label="Nearer" title="Nearer (+)" onClick={() => zoom(1.5)}>
          <Icon name="added" />
        </button>
        <button type="button" aria-label="Farther" title="Farther (−)" onClick={() => zoom(1 / 1.5)}>
          <Icon name="removed" />
        </button>
        <button type="button" aria-label="Show all" title="Show all (0)" onClick={() => picture.current?.showAll()}>
          <Icon name="whole" />
        </button>
        {props.children}
      </div>
      <SceneState scene={scene} />
      <div class="top-view-foot">
        <output ref={readout} class="top-view-readout" aria-live="off" />
        {scene.state === 'ready' && <Heights heights_m={scene.heights_m} cut_m={cut_m} onCut={setCut} />}
      </div>
    </div>
  );
}

function inWords(place: Place, scene: Scene): string {
  const height = scene.ground?.at(place);
  const ground = height ? `ground at ${metres(height.ground_m)}` : 'nothing seen';
  return `x ${metres(place[0])}, y ${metres(place[1])}; ${ground}`;
}

/** What the shades mean, and up to which height points are shown, so that a roof can be looked under. */
function Heights({
  heights_m: [low, high],
  cut_m,
  onCut,
}: {
  heights_m: readonly [number, number];
  cut_m: number;
  onCut: (cut_m: number) => void;
}) {
  const top = Math.min(cut_m, high);
  return (
    <label class="top-view-heights">
      <span>
        height {metres(low, 1)} to {metres(high, 1)}
        {cut_m < high && `, shown up to ${metres(cut_m, 1)}`}
      </span>
      <input
        type="range"
        aria-label="Show points up to this height"
        aria-valuetext={metres(top, 1)}
        style={{ backgroundImage: rampAsCss() }}
        min={low}
        max={high}
        step={(high - low) / 200 || 1}
        value={top}
        onInput={(event) => {
          const value = Number(event.currentTarget.value);
          onCut(value >= high - (high - low) / 200 ? Infinity : value);
        }}
      />
    </label>
  );
}

function SceneState({ scene }: { scene: Scene }) {
  if (scene.state === 'ready') return null;
  return (
    <div class="top-view-state">
      {scene.state === 'loading' && (
        <p role="status">
          <span class="spinner" aria-hidden="true" /> Loading the points …
        </p>
      )}
      {scene.state === 'empty' && <p>No scan of this site yet: there are no points to see.</p>}
      {scene.problem && <ErrorState problem={scene.problem} />}
    </div>
  );
}
