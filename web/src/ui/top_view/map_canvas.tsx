// A picture from above that is moved by mouse, touch and keys, and says what lies where somebody points.

import './top_view.css';
import { type ComponentChildren } from 'preact';
import { useEffect, useLayoutEffect, useRef, useState } from 'preact/hooks';
import { Icon } from '../icon';
import { type Place, zoomed } from './frame';
import { frameAfterKey, listenToGestures, type Tool } from './gestures';
import { type Drawing, Picture } from './picture';

export interface MapCanvasProps {
  /** What the picture is for, for those who hear it. */
  label: string;
  drawing: Drawing;
  /** What is said of a place. */
  inWords: (place: Place) => string;
  /** Somebody clicked, or pressed Enter with the place in the middle. @param reach_m how near to something counts as on it */
  onPick?: ((place: Place, reach_m: number) => void) | undefined;
  tool?: Tool | undefined;
  /** A key that the picture does not use itself. @returns whether it was used. */
  onKey?: ((event: KeyboardEvent) => boolean) | undefined;
  /** Beside the buttons for the zoom. */
  tools?: ComponentChildren;
  /** Over the picture, when there is nothing to show. */
  state?: ComponentChildren;
  /** Beside what is said of the place. */
  foot?: ComponentChildren;
}

export function MapCanvas(props: MapCanvasProps) {
  const { drawing } = props;
  const canvas = useRef<HTMLCanvasElement>(null);
  const readout = useRef<HTMLOutputElement>(null);
  const picture = useRef<Picture>();
  const current = useRef(props);
  current.current = props;
  const [crosshair, setCrosshair] = useState(false);

  const tell = (place: Place | undefined): void => {
    if (readout.current) readout.current.textContent = place ? current.current.inWords(place) : '';
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
      click: (place, reach_m) => current.current.onPick?.(place, reach_m),
      hover: tell,
    });
    return () => {
      deaf();
      sizes.disconnect();
      shown.end();
    };
  }, []);
  useEffect(() => picture.current?.show(drawing, crosshair), [drawing, crosshair]);

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
      current.current.onPick(centre_m, 9 * metres_per_pixel);
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
        {props.tools}
      </div>
      {props.state}
      <div class="top-view-foot">
        <output ref={readout} class="top-view-readout" aria-live="off" />
        {props.foot}
      </div>
    </div>
  );
}
