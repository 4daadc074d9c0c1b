// Levels of detail: how many of the points that are there are drawn. Points come from coarse to fine, so any beginning of
// them shows the whole place; while the view moves it is as long as the machine draws fluidly, and at rest it is all.

export interface Detail {
  /** How many points are drawn while the view moves. */
  readonly moving: number;
}

export const kFirstDetail: Detail = { moving: 400_000 };

const kLeast = 40_000;
const kMost = 10_000_000;
const kSlow_ms = 28;
const kFast_ms = 14;

/** Learns from the time between two frames in motion. */
export function learn(detail: Detail, frame_ms: number): Detail {
  const factor = frame_ms > kSlow_ms ? 0.7 : frame_ms < kFast_ms ? 1.15 : 1;
  const moving = Math.round(Math.min(kMost, Math.max(kLeast, detail.moving * factor)));
  return moving === detail.moving ? detail : { moving };
}

/** What a layer has, and whether it is what the view is about. */
export interface Share {
  readonly loaded: number;
  readonly important: boolean;
}

/** How many points of each layer are drawn: all that are important, and as many of the others as the budget leaves. */
export function share(layers: readonly Share[], budget: number): number[] {
  const sum = (important: boolean): number =>
    layers.reduce((total, layer) => total + (layer.important === important ? layer.loaded : 0), 0);
  const left = Math.max(kLeast / 2, budget - sum(true));
  const part = Math.min(1, left / Math.max(1, sum(false)));
  return layers.map(({ loaded, important }) => (important ? loaded : Math.ceil(loaded * part)));
}

/** How many points of a part that begins at `first` belong to the first `drawn` of all. */
export const partOf = (drawn: number, first: number, count: number): number =>
  Math.max(0, Math.min(count, drawn - first));
