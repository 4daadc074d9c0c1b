// A site from above: points by height, sensors, a scale, and what a view lays over them. Moved by mouse, touch and keys.

import { type ComponentChildren } from 'preact';
import { useEffect, useMemo, useState } from 'preact/hooks';
import { metres } from '../../lib/format';
import { ErrorState } from '../states';
import { type Bounds, type Place } from './frame';
import { type Tool } from './gestures';
import { MapCanvas } from './map_canvas';
import { drawOverlays, drawSensors, type Overlay } from './overlays';
import { paintPoints, rampAsCss } from './paint';
import { type Drawing } from './picture';
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
  const [cut_m, setCut] = useState(Infinity);
  useEffect(() => setCut(Infinity), [scene]);
  const drawing = useMemo(
    (): Drawing => ({
      bounds_m: focus_m ?? scene.extent_m,
      paint: (pixels, frame, scale) =>
        paintPoints(pixels, frame, scale, scene.clouds, { heights_m: scene.heights_m, cut_m, marks }),
      drawOver: (context, frame) => {
        drawSensors(context, frame, scene.sensors);
        drawOverlays(context, frame, overlays);
      },
    }),
    [scene, overlays, focus_m, cut_m, marks],
  );
  const { onPick } = props;
  const pick = (place_m: Place, reach_m: number): void => {
    const height = scene.ground?.at(place_m);
    onPick?.({ place_m, ground_m: height?.ground_m, top_m: height?.top_m, reach_m });
  };
  return (
    <MapCanvas
      label={props.label}
      drawing={drawing}
      inWords={(place) => inWords(place, scene)}
      onPick={onPick && pick}
      tool={props.tool}
      onKey={props.onKey}
      tools={props.children}
      state={<SceneState scene={scene} />}
      foot={scene.state === 'ready' && <Heights heights_m={scene.heights_m} cut_m={cut_m} onCut={setCut} />}
    />
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
