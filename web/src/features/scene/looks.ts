// Where the camera stands for what is shown.

import { type Schema } from '../../lib/api';
import { type Box, type Vector3 } from '../../lib/points/quantised';
import { besideSight, frame, kFromAbove, lookFrom } from './camera';
import { type TurnedBox } from './points_layer';
import { type Looks } from './scene_spec';
import { vectorOf } from './told';
import { add, times } from './vectors';

type Pose = Schema<'Pose'>;

/** The daemon's vectors, which the contract knows as lists. */
export const boxOfChange = ({ box }: Pick<Schema<'Change'>, 'box'>): TurnedBox => box as unknown as TurnedBox;

export function changeLooks(
  { bounds_m, centroid_m }: Pick<Schema<'Change'>, 'bounds_m' | 'centroid_m'>,
  { pose }: { pose: Pose },
): Looks {
  const box = bounds_m as unknown as Box;
  const [eye_m, target_m] = [vectorOf(pose.position_m), vectorOf(centroid_m)];
  return (look, viewport) => {
    switch (look) {
      case 'top':
        return frame(box, kFromAbove, viewport, 5);
      case 'sensor':
        return lookFrom(eye_m, target_m);
      default:
        return frame(box, besideSight(eye_m, target_m), viewport, 2.6);
    }
  };
}

const kBeforeKnown_m = 15;
const kOverview = { azimuth_rad: -Math.PI / 2, elevation_rad: 0.6 };

/** A whole scan, from outside, from above, or from where it was taken. */
export function scanLooks({ pose }: { pose: Pose }): Looks {
  const eye_m = vectorOf(pose.position_m);
  const half: Vector3 = [kBeforeKnown_m, kBeforeKnown_m, 1];
  const usual: Box = { min: add(eye_m, [-half[0], -half[1], -half[2]]), max: add(eye_m, half) };
  return (look, viewport, around = usual) => {
    if (look === 'top') return frame(around, kFromAbove, viewport, 1);
    if (look === 'frame') return frame(around, kOverview, viewport, 0.85);
    return lookFrom(eye_m, times(add(around.min, around.max), 0.5));
  };
}
