// Mouse, touch and pen on a picture from above, as what is meant: a click, a pull, coming nearer.

import { type Frame, panned, type Pixel, type Place, toPlace, zoomed } from './frame';

/** Something that is done with the pointer on the picture, instead of moving the picture. */
export interface Tool {
  /** Pressed. @param reach_m how near counts as on it. @returns whether the tool takes this press. */
  press(at: Place, reach_m: number): boolean;
  drag(at: Place): void;
  release(): void;
}

export interface GestureTarget {
  frame(): Frame;
  setFrame(frame: Frame): void;
  tool(): Tool | undefined;
  click(at: Place, reach_m: number): void;
  hover(at: Place | undefined): void;
}

/** How near to something a mouse must be, and how near a finger. */
const kReach_px = { mouse: 9, touch: 20 };
/** A press that moves less is a click. */
const kStill_px = 4;

interface Press {
  readonly start: Pixel;
  readonly held: boolean;
  moved: boolean;
}

/** Listens on the canvas. @returns what ends that. */
export function listenToGestures(canvas: HTMLCanvasElement, target: GestureTarget): () => void {
  const pointers = new Map<number, Pixel>();
  let press: Press | undefined;
  const pixelOf = (event: MouseEvent): Pixel => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const reachOf = (event: PointerEvent): number =>
    (event.pointerType === 'mouse' ? kReach_px.mouse : kReach_px.touch) * target.frame().metres_per_pixel;

  const down = (event: PointerEvent): void => {
    if (event.button !== 0) return;
    canvas.setPointerCapture(event.pointerId);
    const at = pixelOf(event);
    pointers.set(event.pointerId, at);
    if (pointers.size > 1) {
      if (press?.held) target.tool()?.release();
      press = undefined; // two fingers: neither a click nor a tool
      return;
    }
    const held = target.tool()?.press(toPlace(target.frame(), at), reachOf(event)) ?? false;
    press = { start: at, held, moved: false };
  };
  const move = (event: PointerEvent): void => {
    const at = pixelOf(event);
    const before = pointers.get(event.pointerId);
    target.hover(toPlace(target.frame(), at));
    if (!before) return;
    if (pointers.size === 2) pinch(event.pointerId, before, at);
    else if (press) pull(press, before, at);
    pointers.set(event.pointerId, at);
  };
  const pull = (current: Press, before: Pixel, at: Pixel): void => {
    const far = Math.hypot(at[0] - current.start[0], at[1] - current.start[1]) > kStill_px;
    const from = current.moved ? before : current.start;
    current.moved ||= far;
    if (!current.moved) return;
    if (current.held) target.tool()?.drag(toPlace(target.frame(), at));
    else target.setFrame(panned(target.frame(), [at[0] - from[0], at[1] - from[1]]));
  };
  const pinch = (id: number, before: Pixel, at: Pixel): void => {
    const other = [...pointers].find(([key]) => key !== id)?.[1];
    if (!other) return;
    const distance = (one: Pixel): number => Math.max(1, Math.hypot(one[0] - other[0], one[1] - other[1]));
    const middle: Pixel = [(before[0] + other[0]) / 2, (before[1] + other[1]) / 2];
    const nearer = zoomed(target.frame(), distance(at) / distance(before), middle);
    target.setFrame(panned(nearer, [(at[0] - before[0]) / 2, (at[1] - before[1]) / 2]));
  };
  const up = (event: PointerEvent): void => {
    if (!pointers.delete(event.pointerId) || !press) return;
    const ended = press;
    press = undefined;
    if (ended.held) target.tool()?.release();
    else if (!ended.moved && event.type === 'pointerup') {
      target.click(toPlace(target.frame(), pixelOf(event)), reachOf(event));
    }
  };
  const wheel = (event: WheelEvent): void => {
    event.preventDefault();
    const turns = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? event.deltaY / 100 : event.deltaY / 3;
    target.setFrame(zoomed(target.frame(), 1.2 ** -turns, pixelOf(event)));
  };
  const leave = (): void => target.hover(undefined);

  canvas.addEventListener('pointerdown', down);
  canvas.addEventListener('pointermove', move);
  canvas.addEventListener('pointerup', up);
  canvas.addEventListener('pointercancel', up);
  canvas.addEventListener('pointerleave', leave);
  canvas.addEventListener('wheel', wheel, { passive: false });
  return () => {
    canvas.removeEventListener('pointerdown', down);
    canvas.removeEventListener('pointermove', move);
    canvas.removeEventListener('pointerup', up);
    canvas.removeEventListener('pointercancel', up);
    canvas.removeEventListener('pointerleave', leave);
    canvas.removeEventListener('wheel', wheel);
  };
}

const kStep_px = 40;

/** What a key does to the frame; undefined for keys that do nothing to it. */
export function frameAfterKey(frame: Frame, key: string, fine: boolean): Frame | undefined {
  const step = fine ? 4 : kStep_px;
  const middle: Pixel = [frame.width_px / 2, frame.height_px / 2];
  switch (key) {
    case 'ArrowLeft':
      return panned(frame, [step, 0]);
    case 'ArrowRight':
      return panned(frame, [-step, 0]);
    case 'ArrowUp':
      return panned(frame, [0, step]);
    case 'ArrowDown':
      return panned(frame, [0, -step]);
    case '+':
    case '=':
      return zoomed(frame, 1.25, middle);
    case '-':
      return zoomed(frame, 0.8, middle);
    default:
      return undefined;
  }
}
