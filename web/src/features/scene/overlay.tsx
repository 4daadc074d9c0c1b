// What stands over the picture: names of places, the scale. It follows the camera without being rendered anew.

import { useEffect, useRef } from 'preact/hooks';
import { metres } from '../../lib/format';
import { type Vector3 } from '../../lib/points/quantised';
import { project } from './camera';
import { scaleBar } from './controls';
import { type Viewer } from './viewer';

export interface Label {
  readonly key: string;
  readonly place_m: Vector3;
  readonly text: string;
  readonly look: 'mark' | 'change' | 'measure';
  readonly href?: string | undefined;
}

export function Labels({ viewer, labels }: { viewer: Viewer; labels: readonly Label[] }) {
  const holder = useRef<HTMLDivElement>(null);
  useEffect(
    () =>
      viewer.follow((camera, viewport) => {
        labels.forEach(({ place_m }, index) => {
          const element = holder.current?.children[index];
          if (!(element instanceof HTMLElement)) return;
          const at = project(camera, viewport, place_m);
          const seen = at && at.x > 0 && at.y > 0 && at.x < viewport.width && at.y < viewport.height;
          element.style.visibility = seen ? 'visible' : 'hidden';
          if (seen) element.style.transform = `translate(${at.x.toFixed(1)}px, ${at.y.toFixed(1)}px)`;
        });
      }),
    [viewer, labels],
  );
  return (
    <div ref={holder} class="scene-labels">
      {labels.map(({ key, text, look, href }) => (
        <div key={key} class={`scene-label scene-label-${look}`}>
          {href === undefined ? <span>{text}</span> : <a href={href}>{text}</a>}
        </div>
      ))}
    </div>
  );
}

const kWidestScale_px = 120;

/** A length at the distance of what is looked at. */
export function Scale({ viewer }: { viewer: Viewer }) {
  const bar = useRef<HTMLDivElement>(null);
  useEffect(
    () =>
      viewer.follow((camera, viewport) => {
        const { length_m, width_px } = scaleBar(camera, viewport, kWidestScale_px);
        if (!bar.current) return;
        bar.current.style.width = `${width_px.toFixed(1)}px`;
        bar.current.textContent = metres(length_m, length_m < 1 ? 2 : 0);
      }),
    [viewer],
  );
  return <div ref={bar} class="scene-scale" title="At the distance of what is looked at" />;
}
