// The colours of the scene, from the tokens of the styles, so that they stand in one place.

import { Color } from 'three';
import { kPointClasses, type PointClass } from '../../lib/points/quantised';

export interface Palette {
  readonly ground: Color;
  readonly classes: readonly Color[];
  readonly ray: Color;
  readonly line: Color;
}

const kTokens: Readonly<Record<PointClass, string>> = {
  unchanged: '--scene-point',
  added: '--scene-added',
  removed: '--scene-removed',
  discrepancy: '--scene-discrepancy',
  occluded: '--scene-unseen',
  unseen: '--scene-unseen',
  invalid: '--scene-unseen',
};

export function readPalette(): Palette {
  const style = getComputedStyle(document.documentElement);
  const colour = (token: string): Color => new Color().setStyle(style.getPropertyValue(token).trim() || '#888');
  return {
    ground: colour('--scene-ground'),
    classes: kPointClasses.map((name) => colour(kTokens[name])),
    ray: colour('--scene-ray'),
    line: colour('--scene-line'),
  };
}
