// Layers that follow what a scene tells: each comes with its part of the telling, and goes with it.

import { useEffect, useState } from 'preact/hooks';
import { type LoadedPoints, pointStore } from '../../lib/points/point_store';
import { Problem } from '../../lib/problem';
import { type Layer } from './layer';
import { edgesOf, LinesLayer, pieces, type Segment } from './lines_layer';
import { PointsLayer } from './points_layer';
import { type Cloud, type RayBundle, type SceneBox, type SceneSpec } from './scene_spec';
import { type Viewer } from './viewer';

/** Adds a layer for as long as `keys` are the same. */
function useLayer(viewer: Viewer | undefined, make: (viewer: Viewer) => Layer | undefined, keys: readonly unknown[]) {
  useEffect(() => {
    const layer = viewer && make(viewer);
    if (!layer) return;
    viewer.add(layer);
    return () => viewer.remove(layer);
  }, [viewer, ...keys]);
}

/** How far the points of a scene are loaded. */
export interface Loading {
  readonly loaded: number;
  readonly total: number;
  /** Points of which some address has not told anything yet. */
  readonly waiting: boolean;
  readonly problems: readonly { readonly what: string; readonly problem: Problem }[];
}

type Told = Readonly<Record<string, LoadedPoints | Problem>>;

/** @param options.budget how many points of each cloud are loaded at most */
export function useClouds(
  viewer: Viewer | undefined,
  spec: SceneSpec,
  options: { budget: number; swiped: boolean },
  onContext: (points: LoadedPoints) => void,
): Loading {
  const [told, setTold] = useState<Told>({});
  const clouds = spec.clouds.filter((cloud) => options.swiped || !cloud.onlySwiped);
  useEffect(() => {
    if (!viewer) return;
    const ends = clouds.map((cloud) =>
      showCloud(viewer, cloud, spec, options.budget, (points) => {
        if (!(points instanceof Problem) && !cloud.important) onContext(points);
        setTold((before) => ({ ...before, [cloud.from]: points }));
      }),
    );
    return () => ends.forEach((end) => end());
  }, [viewer, options.budget, ...[JSON.stringify(clouds)]]);
  return summaryOf(clouds, told);
}

/** Loads the points of a cloud and shows them as they come. @returns what ends that */
function showCloud(
  viewer: Viewer,
  cloud: Cloud,
  spec: SceneSpec,
  budget: number,
  tell: (points: LoadedPoints | Problem) => void,
): () => void {
  const { side, important } = cloud;
  const layer = new PointsLayer(viewer.shared, viewer.palette, { side, important, focus: spec.focus });
  viewer.add(layer);
  const ending = new AbortController();
  const show = (points: LoadedPoints): void => {
    layer.update(points);
    viewer.invalidate();
    tell(points);
  };
  pointStore.load(cloud.from, budget, show, ending.signal).catch((failure: unknown) => {
    if (!(failure instanceof Problem)) throw failure;
    if (!ending.signal.aborted) tell(failure);
  });
  return () => {
    ending.abort();
    viewer.remove(layer);
  };
}

function summaryOf(clouds: readonly Cloud[], told: Told): Loading {
  const answers = clouds.map(({ from, what }) => ({ what, answer: told[from] }));
  const points = answers.flatMap(({ answer }) => (answer && !(answer instanceof Problem) ? [answer] : []));
  return {
    loaded: points.reduce((sum, { loaded }) => sum + loaded, 0),
    total: points.reduce((sum, { total }) => sum + (total ?? 0), 0),
    waiting: answers.some(({ answer }) => answer === undefined),
    problems: answers.flatMap(({ what, answer }) => (answer instanceof Problem ? [{ what, problem: answer }] : [])),
  };
}

const kClassOfKind = { added: 1, removed: 2, discrepancy: 3 } as const;

export function useBoxes(viewer: Viewer | undefined, boxes: readonly SceneBox[]): void {
  for (const kind of ['added', 'removed', 'discrepancy'] as const) {
    const own = boxes.filter((box) => box.kind === kind);
    useLayer(
      viewer,
      ({ shared, palette }) => {
        const colour = palette.classes[kClassOfKind[kind]];
        if (own.length === 0 || !colour) return undefined;
        return new LinesLayer(
          shared.anchor_m,
          own.flatMap(({ box }) => edgesOf(box)),
          { colour },
        );
      },
      [own.map(({ key }) => key).join()],
    );
  }
}

/** The rays that prove a change, faint, because there are many. */
export function useRays(viewer: Viewer | undefined, bundles: readonly RayBundle[] | undefined): void {
  useLayer(
    viewer,
    ({ shared, palette }) =>
      bundles &&
      new LinesLayer(
        shared.anchor_m,
        bundles.flatMap(({ from_m, to_m }) => to_m.flatMap((end) => pieces(from_m, end))),
        { colour: palette.ray, opacity: 0.4 },
      ),
    [bundles],
  );
}

/** What is measured, seen through everything. */
export function useLine(viewer: Viewer | undefined, segment: Segment | undefined): void {
  useLayer(
    viewer,
    ({ shared, palette }) =>
      segment && new LinesLayer(shared.anchor_m, [segment], { colour: palette.line, above: true }),
    [segment],
  );
}
