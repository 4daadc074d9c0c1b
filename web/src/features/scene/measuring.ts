// Measuring between two points: a state and what clicks and keys make of it.

import { type Vector3 } from '../../lib/points/quantised';
import { length, minus } from './vectors';

export type Measuring =
  | { step: 'off' }
  | { step: 'first' }
  | { step: 'second'; from_m: Vector3 }
  | { step: 'done'; from_m: Vector3; to_m: Vector3 };

export const kNotMeasuring: Measuring = { step: 'off' };

export const toggled = (measuring: Measuring): Measuring =>
  measuring.step === 'off' ? { step: 'first' } : kNotMeasuring;

/** A point was chosen; a third begins anew. */
export function chosen(measuring: Measuring, place_m: Vector3): Measuring {
  switch (measuring.step) {
    case 'off':
      return measuring;
    case 'second':
      return { step: 'done', from_m: measuring.from_m, to_m: place_m };
    default:
      return { step: 'second', from_m: place_m };
  }
}

export interface Measure {
  readonly length_m: number;
  /** Without the difference in height. */
  readonly level_m: number;
  readonly rise_m: number;
}

export function measureOf({ from_m, to_m }: { from_m: Vector3; to_m: Vector3 }): Measure {
  const between = minus(to_m, from_m);
  return { length_m: length(between), level_m: Math.hypot(between[0], between[1]), rise_m: between[2] };
}
