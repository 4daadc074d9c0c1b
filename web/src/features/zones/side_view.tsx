// The zone from its side: the points over its outline, and the two heights between which it reaches.

import { useEffect, useRef } from 'preact/hooks';
import { counted, metres } from '../../lib/format';
import { type Inside } from './inside';

const kHeight_px = 180;
const kMargin_px = 34;

interface Heights {
  readonly z_min_m: number;
  readonly z_max_m: number;
}

export interface SideViewProps extends Heights {
  inside: Inside;
  /** How many of the points lie between the two heights. */
  count: number;
  onHeights: (heights: Heights) => void;
}

/** The heights that are shown: of the points and of the zone, with some room. */
function shownHeights({ inside, z_min_m, z_max_m }: SideViewProps): readonly [number, number] {
  const known = [z_min_m, z_max_m].filter(Number.isFinite);
  let [low, high] = known.length > 0 ? [Math.min(...known), Math.max(...known)] : [0, 1];
  for (const z of inside.z_m) {
    if (z < low) low = z;
    if (z > high) high = z;
  }
  const room = Math.max(0.3, (high - low) * 0.1);
  return [low - room, high + room];
}

export function SideView(props: SideViewProps) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const current = useRef(props);
  current.current = props;
  const { inside, z_min_m, z_max_m } = props;
  useEffect(() => {
    if (!canvas.current) return;
    const element = canvas.current;
    const sizes = new ResizeObserver(() => draw(element, current.current));
    sizes.observe(element);
    return () => sizes.disconnect();
  }, []);
  useEffect(() => {
    if (canvas.current) draw(canvas.current, props);
  }, [inside, z_min_m, z_max_m]);
  const [low, high] = shownHeights(props);
  const slider = (name: keyof Heights, words: string) => (
    <label class="field">
      {words}: {metres(props[name])}
      <input
        type="range"
        min={low}
        max={high}
        step={0.05}
        value={Number.isFinite(props[name]) ? props[name] : low}
        onInput={(event) =>
          props.onHeights({ z_min_m, z_max_m, [name]: Math.round(event.currentTarget.valueAsNumber * 100) / 100 })
        }
      />
    </label>
  );
  return (
    <section class="side-view" aria-label="From the side">
      <canvas ref={canvas} role="img" aria-label={`The points over the zone from the side; ${inWords(props)}`} />
      <div class="side-view-foot">
        <p>
          <b>{inWords(props)}</b> of {counted(inside.z_m.length, 'point')} over its outline
        </p>
        {slider('z_min_m', 'From')}
        {slider('z_max_m', 'To')}
      </div>
    </section>
  );
}

const inWords = ({ count }: SideViewProps): string => `${counted(count, 'point')} inside`;

function draw(canvas: HTMLCanvasElement, props: SideViewProps): void {
  const context = canvas.getContext('2d');
  const width_px = canvas.clientWidth;
  if (!context || width_px === 0) return;
  const scale = Math.min(2, window.devicePixelRatio || 1);
  canvas.width = Math.round(width_px * scale);
  canvas.height = Math.round(kHeight_px * scale);
  context.setTransform(scale, 0, 0, scale, 0, 0);
  context.fillStyle = '#0c1117';
  context.fillRect(0, 0, width_px, kHeight_px);
  const { inside, z_min_m, z_max_m } = props;
  const [low, high] = shownHeights(props);
  const axis = inside.goesEast ? 0 : 1;
  const [start, end] = [inside.bounds.min[axis], inside.bounds.max[axis]];
  const toX = (along: number): number =>
    kMargin_px + ((along - start) / Math.max(0.01, end - start)) * (width_px - 2 * kMargin_px);
  const toY = (z: number): number => kHeight_px - 8 - ((z - low) / (high - low)) * (kHeight_px - 16);
  drawRange(context, [toY(z_max_m), toY(z_min_m)], width_px);
  for (let point = 0; point < inside.z_m.length; ++point) {
    const z = inside.z_m[point]!;
    context.fillStyle = z >= z_min_m && z <= z_max_m ? '#ffc857' : '#6f8ca6';
    context.fillRect(toX(inside.along_m[point]!) - 1, toY(z) - 1, 2, 2);
  }
  drawWords(context, [toY(z_max_m), toY(z_min_m)], [metres(z_max_m), metres(z_min_m)], width_px);
}

function drawRange(
  context: CanvasRenderingContext2D,
  [top, bottom]: readonly [number, number],
  width_px: number,
): void {
  if (!Number.isFinite(top) || !Number.isFinite(bottom)) return;
  context.fillStyle = 'rgb(255 200 87 / 12%)';
  context.fillRect(0, top, width_px, bottom - top);
  context.fillStyle = '#ffc857';
  context.fillRect(0, top - 0.5, width_px, 1);
  context.fillRect(0, bottom - 0.5, width_px, 1);
}

function drawWords(
  context: CanvasRenderingContext2D,
  places: readonly number[],
  words: readonly string[],
  width_px: number,
): void {
  context.font = '12px system-ui, "DejaVu Sans", sans-serif';
  context.fillStyle = '#ffffff';
  context.textAlign = 'right';
  for (const [index, y] of places.entries()) {
    if (Number.isFinite(y)) context.fillText(words[index] ?? '', width_px - 8, index === 0 ? y + 14 : y - 5);
  }
}
