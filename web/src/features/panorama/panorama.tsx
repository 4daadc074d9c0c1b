// The quick flat view of a scan: how far it saw in each direction, with what changed outlined.

import './panorama.css';
import { useEffect, useMemo, useRef, useState } from 'preact/hooks';
import { useResource } from '../../app/app';
import { address, type Schema } from '../../lib/api';
import { degrees, metres } from '../../lib/format';
import { type LoadedPoints, pointStore } from '../../lib/points/point_store';
import { Problem } from '../../lib/problem';
import { Loaded } from '../../ui/states';
import {
  directionAt,
  outline,
  pixelsOf,
  rampColour,
  rangeAt,
  type RangeImage,
  rangeImage,
  rangeSpan,
} from './range_image';

type Scan = Schema<'Scan'>;
type Change = Schema<'Change'>;

export interface PanoramaPanelProps {
  scan: number;
  /** Outlined, each with a link to it. */
  changes: readonly Change[];
}

export function PanoramaPanel(props: PanoramaPanelProps) {
  return (
    <section class="panel" aria-labelledby="panorama">
      <header class="panel-head">
        <h2 id="panorama">Panorama</h2>
        <span class="muted">scan {props.scan}, from where it was taken</span>
      </header>
      <PanoramaFigure {...props} />
    </section>
  );
}

/** The picture itself. */
export function PanoramaFigure({ scan, changes }: PanoramaPanelProps) {
  const found = useResource(address('/api/v1/scans/{id}', { path: { id: scan } }));
  const panorama = useResource(address('/api/v1/scans/{id}/panorama', { path: { id: scan } }));
  return (
    <Loaded of={found} what="scan">
      {(data) => (
        <Loaded of={panorama} what="panorama">
          {(ranges) => <Panorama scan={data} panorama={ranges} changes={changes} />}
        </Loaded>
      )}
    </Loaded>
  );
}

/** Enough for cells of half a degree; a part of what a 3D view loads. */
const kPoints = 150_000;

function usePoints(scan: number): LoadedPoints | undefined {
  const [points, setPoints] = useState<LoadedPoints | undefined>();
  useEffect(() => {
    const ending = new AbortController();
    const from = address('/api/v1/scans/{id}/points', {
      path: { id: scan },
      query: { format: 'q16', frame: 'sensor' },
    });
    pointStore.load(from, kPoints, setPoints, ending.signal).catch((failure: unknown) => {
      // Without them the picture stays coarse.
      if (!(failure instanceof Problem)) throw failure;
    });
    return () => ending.abort();
  }, [scan]);
  return points;
}

interface Cursor {
  readonly x: number;
  readonly y: number;
}

function Panorama({
  scan,
  panorama,
  changes,
}: {
  scan: Scan;
  panorama: Schema<'Panorama'>;
  changes: readonly Change[];
}) {
  const points = usePoints(scan.id);
  const image = useMemo(() => rangeImage(panorama, points?.parts ?? []), [panorama, points]);
  const span = useMemo(() => rangeSpan(image), [image]);
  const [cursor, setCursor] = useState<Cursor | undefined>();
  return (
    <figure class="panorama">
      <div class="panorama-stage">
        <Picture image={image} span={span} cursor={cursor} onCursor={setCursor} />
        <Outlines image={image} scan={scan} changes={changes} />
        {cursor && (
          <span
            class="panorama-cursor"
            aria-hidden="true"
            style={{ left: `${(cursor.x / image.width) * 100}%`, top: `${(cursor.y / image.height) * 100}%` }}
          />
        )}
      </div>
      <figcaption>
        <span role="status">
          {cursor ? readOut(image, cursor) : 'Point at it, or use the arrow keys, to read ranges.'}
        </span>
        <Ramp span={span} />
      </figcaption>
    </figure>
  );
}

function readOut(image: RangeImage, { x, y }: Cursor): string {
  const { azimuth_deg, elevation_deg } = directionAt(image, x, y);
  const range_m = rangeAt(image, x, y);
  const where = `azimuth ${degrees(azimuth_deg, 1)}, elevation ${degrees(elevation_deg, 1)}`;
  return `${range_m === undefined ? 'nothing seen' : metres(range_m)} at ${where}`;
}

interface PictureProps {
  image: RangeImage;
  span: readonly [number, number];
  cursor: Cursor | undefined;
  onCursor: (cursor: Cursor | undefined) => void;
}

function Picture({ image, span, cursor, onCursor }: PictureProps) {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const { width, height } = image;
    canvas.current?.getContext('2d')?.putImageData(new ImageData(pixelsOf(image, span), width, height), 0, 0);
  }, [image, span]);
  const point = (event: PointerEvent): void => {
    const { left, top, width, height } = (event.currentTarget as Element).getBoundingClientRect();
    onCursor({
      x: ((event.clientX - left) / width) * image.width,
      y: ((event.clientY - top) / height) * image.height,
    });
  };
  const key = (event: KeyboardEvent): void => {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (!step) return;
    event.preventDefault();
    const cells = event.shiftKey ? 10 : 1;
    const from = cursor ?? { x: image.width / 2, y: image.height / 2 };
    onCursor({
      x: Math.min(image.width - 0.5, Math.max(0.5, from.x + (step[0] ?? 0) * cells)),
      y: Math.min(image.height - 0.5, Math.max(0.5, from.y + (step[1] ?? 0) * cells)),
    });
  };
  return (
    <canvas
      ref={canvas}
      width={image.width}
      height={image.height}
      tabIndex={0}
      role="application"
      aria-label="Range image. The arrow keys move the place that is read out, with Shift ten cells at once."
      onPointerMove={point}
      onPointerLeave={() => onCursor(undefined)}
      onKeyDown={key}
    />
  );
}

const kLeastOutline = 1.5; // cells: smaller ones could not be seen or pressed

function Outlines({ image, scan, changes }: { image: RangeImage; scan: Scan; changes: readonly Change[] }) {
  return (
    <>
      {changes.map((change) => {
        const { x, y, width, height } = outline(image, scan.pose, change);
        const more = { x: Math.max(0, kLeastOutline - width), y: Math.max(0, kLeastOutline - height) };
        const percent = (cells: number, of: number): string => `${((cells / of) * 100).toFixed(3)}%`;
        return (
          <a
            key={change.id}
            class={`panorama-change panorama-${change.kind}`}
            href={`/changes/${change.id}`}
            aria-label={`Change ${change.id}, ${change.kind}`}
            title={`Change ${change.id}, ${change.kind}`}
            style={{
              left: percent(x - more.x / 2, image.width),
              top: percent(y - more.y / 2, image.height),
              width: percent(width + more.x, image.width),
              height: percent(height + more.y, image.height),
            }}
          />
        );
      })}
    </>
  );
}

const kRampSteps = 24;

function Ramp({ span: [near_m, far_m] }: { span: readonly [number, number] }) {
  return (
    <span class="panorama-ramp">
      {metres(near_m, 1)}
      <svg viewBox={`0 0 ${kRampSteps} 1`} preserveAspectRatio="none" aria-hidden="true">
        {Array.from({ length: kRampSteps }, (_, step) => (
          <rect
            key={step}
            x={step}
            width={1.1}
            height={1}
            fill={`rgb(${rampColour(1 - step / (kRampSteps - 1)).join()})`}
          />
        ))}
      </svg>
      {metres(far_m, 1)}
    </span>
  );
}
