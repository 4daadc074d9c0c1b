// Turning, moving and coming nearer: by mouse, by touch and by keys.

import { type Camera, metresPerPixel, orbit, pan, type Viewport, zoom } from './camera';

export interface Controlled {
  readonly camera: Camera;
  readonly size: Viewport;
  look(camera: Camera): void;
}

export interface ControlOptions {
  readonly element: HTMLElement;
  readonly viewer: Controlled;
  /** A press that did not move: in pixels from the element's upper left corner. */
  readonly onClick: (at: { x: number; y: number }) => void;
}

const kTurnPerPixel_rad = 0.005;
const kClickWithin_px = 4;
const kWheelStep = 0.0015;
const kLinePixels = 20; // of wheels that count lines

interface Pointer {
  x: number;
  y: number;
}

/** Listens to the element. @returns what ends that */
export function control({ element, viewer, onClick }: ControlOptions): () => void {
  const pointers = new Map<number, Pointer>();
  let pressed: { at: Pointer; moved: boolean } | undefined;

  const placeOf = (event: PointerEvent | WheelEvent): Pointer => {
    const { left, top } = element.getBoundingClientRect();
    return { x: event.clientX - left, y: event.clientY - top };
  };
  const down = (event: PointerEvent): void => {
    element.setPointerCapture(event.pointerId);
    const at = placeOf(event);
    pointers.set(event.pointerId, at);
    pressed = pointers.size === 1 ? { at, moved: false } : undefined;
  };
  const move = (event: PointerEvent): void => {
    const before = pointers.get(event.pointerId);
    if (!before) return;
    const now = placeOf(event);
    const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1];
    pointers.set(event.pointerId, now);
    if (pressed && Math.hypot(now.x - pressed.at.x, now.y - pressed.at.y) <= kClickWithin_px && !pressed.moved) return;
    if (pressed) pressed.moved = true;
    const moves = event.buttons !== 1 || event.shiftKey;
    viewer.look(other ? pinched(viewer, before, now, other) : dragged(viewer, before, now, moves));
  };
  const up = (event: PointerEvent): void => {
    if (!pointers.delete(event.pointerId)) return;
    if (event.type === 'pointerup' && pressed && !pressed.moved && event.button === 0) onClick(placeOf(event));
    pressed = undefined;
  };
  const wheel = (event: WheelEvent): void => {
    event.preventDefault();
    const pixels = event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_LINE ? kLinePixels : 1);
    viewer.look(zoom(viewer.camera, viewer.size, Math.exp(pixels * kWheelStep), placeOf(event)));
  };
  const menu = (event: Event): void => event.preventDefault();
  const key = (event: KeyboardEvent): void => {
    const camera = keyed(viewer, event);
    if (!camera) return;
    event.preventDefault();
    viewer.look(camera);
  };

  const ending = new AbortController();
  const { signal } = ending;
  element.addEventListener('pointerdown', down, { signal });
  element.addEventListener('pointermove', move, { signal });
  element.addEventListener('pointerup', up, { signal });
  element.addEventListener('pointercancel', up, { signal });
  element.addEventListener('wheel', wheel, { signal, passive: false });
  element.addEventListener('contextmenu', menu, { signal });
  element.addEventListener('keydown', key, { signal });
  return () => ending.abort();
}

function dragged({ camera, size }: Controlled, before: Pointer, now: Pointer, moves: boolean): Camera {
  const [right, down] = [now.x - before.x, now.y - before.y];
  return moves ? pan(camera, size, right, down) : orbit(camera, -right * kTurnPerPixel_rad, down * kTurnPerPixel_rad);
}

/** Two fingers: what lies between them moves with them, and grows as they part. */
function pinched({ camera, size }: Controlled, before: Pointer, now: Pointer, other: Pointer): Camera {
  const apart = (finger: Pointer): number => Math.max(10, Math.hypot(finger.x - other.x, finger.y - other.y));
  const middle = { x: (now.x + other.x) / 2, y: (now.y + other.y) / 2 };
  const moved = pan(camera, size, (now.x - before.x) / 2, (now.y - before.y) / 2);
  return zoom(moved, size, apart(before) / apart(now), middle);
}

const kKeyTurn_rad = Math.PI / 24;
const kKeyMove = 0.08; // of the view's height
const kKeyZoom = 0.8;

/** What a key does to the camera; nothing when it is none of its keys. */
export function keyed(
  { camera, size }: Controlled,
  event: Pick<KeyboardEvent, 'key' | 'shiftKey'>,
): Camera | undefined {
  const [right, up] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key] ?? [];
  if (right !== undefined && up !== undefined) {
    const step_px = kKeyMove * size.height;
    return event.shiftKey
      ? pan(camera, size, -right * step_px, up * step_px)
      : orbit(camera, right * kKeyTurn_rad, up * kKeyTurn_rad);
  }
  if (event.key === '+' || event.key === '=') return zoom(camera, size, kKeyZoom);
  if (event.key === '-') return zoom(camera, size, 1 / kKeyZoom);
  return undefined;
}

/** A length in metres that is a round number, for a scale of at most so many pixels. */
export function scaleBar(camera: Camera, size: Viewport, most_px: number): { length_m: number; width_px: number } {
  const perPixel = metresPerPixel(camera, size);
  const most_m = perPixel * most_px;
  const power = 10 ** Math.floor(Math.log10(most_m));
  const length_m = ([5, 2, 1].find((digit) => digit * power <= most_m) ?? 1) * power;
  return { length_m, width_px: length_m / perPixel };
}
