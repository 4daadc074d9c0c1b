// The 3D view on a page: the picture, what stands over it, and the keys that it understands. All that is chosen stands in
// the link. This file and what it imports is loaded when a 3D view is first shown.

import './scene.css';
import { type ComponentChildren } from 'preact';
import { useEffect, useMemo, useRef, useState } from 'preact/hooks';
import { setQuery, useKeys, useSelect } from '../../app/app';
import { type Box, type Vector3 } from '../../lib/points/quantised';
import { type Camera } from './camera';
import { chosen, kNotMeasuring, type Measuring, toggled } from './measuring';
import { type Label, Labels, Scale } from './overlay';
import { Found, MeasureNote, NoPicture, Notices } from './notes';
import { type Look, type Looks, type RayBundle, type SceneSpec, usualBox } from './scene_spec';
import { Swipe } from './swipe';
import { keyOfLook, Legend, Points, Toolbar } from './toolbar';
import { useBoxes, useClouds, useLine, useRays } from './use_layers';
import { useViewer } from './use_viewer';
import { type Viewer } from './viewer';
import { add, times } from './vectors';

export interface SceneStageProps {
  spec: SceneSpec;
  /** What is seen, in words. */
  label: string;
  looksAvailable: readonly Look[];
  looks: Looks;
  /** Nothing while they are not known; undefined `onRays`: this scene has none. */
  rays: readonly RayBundle[] | undefined;
  hasRays: boolean;
  /** Shown where there can be no picture. */
  instead?: ComponentChildren;
}

const kHalfway = 50;
const kNarrow_px = 700;

export function SceneStage(props: SceneStageProps) {
  const [turn, setTurn] = useState(0);
  return <Stage key={turn} {...props} retry={() => setTurn(turn + 1)} />;
}

function Stage(props: SceneStageProps & { retry: () => void }) {
  const query = useSelect((state) => state.location.query);
  const stage = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLCanvasElement>(null);
  const click = useRef<(at: { x: number; y: number }) => void>(() => undefined);
  const asked = query['view'] as Look;
  const firstLook = props.looksAvailable.includes(asked) ? asked : 'frame';
  const setting = useMemo(
    () => ({ ...props.spec, camera: props.looks(firstLook, { width: 4, height: 3 }, undefined) }),
    [],
  );
  const state = useViewer(stage, canvas, setting, click);
  if (state.state === 'missing' || state.state === 'lost') {
    return (
      <NoPicture lost={state.state === 'lost'} retry={props.retry}>
        {props.instead}
      </NoPicture>
    );
  }
  return (
    <div ref={stage} class="scene">
      <canvas ref={canvas} class="scene-canvas" tabIndex={0} role="application" aria-label={props.label} />
      {state.state === 'ready' && (
        <Inside {...props} viewer={state.viewer} click={click} firstLook={firstLook} query={query} />
      )}
    </div>
  );
}

interface InsideProps extends SceneStageProps {
  viewer: Viewer;
  click: { current: ((at: { x: number; y: number }) => void) | null };
  firstLook: Look;
  query: Readonly<Record<string, string>>;
}

const change = (query: Readonly<Record<string, string | undefined>>): void => setQuery(query, { replace: true });

function useCamera({ viewer, looks, firstLook }: InsideProps) {
  const around = useRef<Box>();
  const atFirst = useRef<Camera>();
  const first = (): void => {
    viewer.look((atFirst.current = looks(firstLook, viewer.size, around.current)), true);
  };
  useEffect(first, [viewer]);
  return {
    look: (look: Look): void => {
      viewer.look(looks(look, viewer.size, around.current));
      change({ view: look });
    },
    /** The first points say how large the place is. Whoever has moved meanwhile stays where he is. */
    know: (box: Box | undefined): void => {
      if (around.current) return;
      around.current = box;
      if (viewer.camera === atFirst.current) first();
    },
  };
}

function Inside(props: InsideProps) {
  const { viewer, spec, query } = props;
  const swipeAt = query['swipe'] === undefined ? undefined : Number(query['swipe']) || 0;
  const swiped = swipeAt !== undefined && spec.before !== undefined;
  const usual = viewer.size.width < kNarrow_px ? 250_000 : 1_000_000;
  const budget = Number(query['points'] ?? usual);
  const camera = useCamera(props);
  const loading = useClouds(viewer, spec, { budget, swiped }, ({ parts: [part] }) => {
    if (part) camera.know(usualBox(part));
  });
  const showsRays = props.hasRays && query['rays'] === '1';
  useBoxes(viewer, spec.boxes);
  useRays(viewer, showsRays ? props.rays : undefined);
  useEffect(() => viewer.swipe(swiped ? swipeAt / 50 - 1 : undefined), [viewer, swiped, swipeAt]);
  const pointing = usePointing(props);
  const toggleSwipe = (): void => change({ swipe: swiped ? undefined : String(kHalfway) });
  const toggleRays = (): void => change({ rays: showsRays ? undefined : '1' });
  useKeys([
    ...props.looksAvailable.map((look) => ({
      key: keyOfLook(look),
      does: { frame: 'frame it', top: 'look from above', sensor: 'look from the sensor' }[look],
      run: () => camera.look(look),
    })),
    ...(spec.before === undefined ? [] : [{ key: 'b', does: 'before and after', run: toggleSwipe }]),
    ...(props.hasRays ? [{ key: 'y', does: 'the rays that prove it', run: toggleRays }] : []),
    ...pointing.keys,
  ]);
  const labels = useMemo(
    () => [...labelsOf(spec), ...pointing.labels],
    [JSON.stringify([spec.boxes, spec.marks]), pointing.labels],
  );
  return (
    <>
      <Labels viewer={viewer} labels={labels} />
      {swiped && (
        <Swipe
          at={swipeAt}
          onMove={(at) => change({ swipe: String(at) })}
          before={spec.before ?? ''}
          after={spec.after ?? ''}
        />
      )}
      {pointing.measures && <span class="scene-cross" aria-hidden="true" />}
      <Toolbar
        looks={props.looksAvailable}
        onLook={camera.look}
        swiped={spec.before === undefined ? undefined : swiped}
        rays={props.hasRays ? showsRays : undefined}
        measures={pointing.measures}
        onSwipe={toggleSwipe}
        onRays={toggleRays}
        onMeasure={pointing.toggle}
      />
      <div class="scene-notes">
        <Notices loading={loading} />
        {pointing.note}
      </div>
      <div class="scene-foot">
        <Legend kinds={legendOf(spec)} />
        <Scale viewer={viewer} />
        <Points loading={loading} budget={budget} onBudget={(points) => change({ points: String(points) })} />
      </div>
    </>
  );
}

/** What clicking and the keys of measuring do. */
function usePointing({ viewer, spec, click }: InsideProps) {
  const [measuring, setMeasuring] = useState<Measuring>(kNotMeasuring);
  const [found, setFound] = useState<Vector3 | undefined>();
  const measures = measuring.step !== 'off';
  click.current = (at) => {
    const place_m = viewer.pick(at)?.place_m;
    if (measures && place_m) setMeasuring(chosen(measuring, place_m));
    if (!measures) setFound(place_m);
  };
  const segment = useMemo(
    () => (measuring.step === 'done' ? ([measuring.from_m, measuring.to_m] as const) : undefined),
    [measuring],
  );
  useLine(viewer, segment);
  const labels = useMemo(() => labelsOfMeasure(measuring, found), [measuring, found]);
  const toggle = (): void => {
    setFound(undefined);
    setMeasuring(toggled(measuring));
  };
  const { width, height } = viewer.size;
  const keys = [
    { key: 'm', does: 'measure a distance', run: toggle },
    ...(measures
      ? [
          {
            key: 'Enter',
            does: 'take the point in the middle',
            run: () => click.current?.({ x: width / 2, y: height / 2 }),
          },
        ]
      : []),
    ...(measures || found
      ? [{ key: 'Escape', does: 'end it', run: () => (measures ? toggle() : setFound(undefined)) }]
      : []),
  ];
  const note = measures ? (
    <MeasureNote measuring={measuring} />
  ) : (
    found && <Found place_m={found} site={spec.site} onClose={() => setFound(undefined)} />
  );
  return { measures, labels, keys, toggle, note };
}

function labelsOfMeasure(measuring: Measuring, found: Vector3 | undefined): Label[] {
  const dot = (key: string, place_m: Vector3): Label => ({ key, place_m, text: '', look: 'measure' });
  switch (measuring.step) {
    case 'second':
      return [dot('from', measuring.from_m)];
    case 'done':
      return [dot('from', measuring.from_m), dot('to', measuring.to_m)];
    default:
      return found ? [dot('found', found)] : [];
  }
}

function labelsOf({ boxes, marks }: SceneSpec): Label[] {
  return [
    ...boxes.flatMap(({ key, box, label, href }): Label[] =>
      label === undefined
        ? []
        : [{ key, text: label, href, look: 'change', place_m: add(box.position_m, times([0, 0, box.size_m[2]], 0.5)) }],
    ),
    ...marks.map(({ key, place_m, text }): Label => ({ key, place_m, text, look: 'mark' })),
  ];
}

function legendOf({ boxes, clouds }: SceneSpec) {
  const kinds = (['added', 'removed', 'discrepancy'] as const).filter((kind) => boxes.some((box) => box.kind === kind));
  return [
    ...kinds,
    'unchanged' as const,
    ...(clouds.some(({ from }) => from.includes('unseen')) ? (['unseen'] as const) : []),
  ];
}
