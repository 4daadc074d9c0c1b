// The parts of a scene that the daemon's answers tell.

import { address, type Schema } from '../../lib/api';
import { type PointClass, type Vector3 } from '../../lib/points/quantised';
import { type Cloud, type Mark } from './scene_spec';

type Comparison = Schema<'Comparison'>;

/** A vector of the contract, which knows it as a list. */
export const vectorOf = ([x = 0, y = 0, z = 0]: readonly number[]): Vector3 => [x, y, z];

const ofComparison = (id: number, classes: readonly PointClass[]): string =>
  address('/api/v1/comparisons/{id}/points', { path: { id }, query: { format: 'q16', class: classes.join(',') } });

export const scanPoints = (id: number): string =>
  address('/api/v1/scans/{id}/points', { path: { id }, query: { format: 'q16', frame: 'world' } });

/** A comparison's points: what is as before or was not seen, what is new, what is gone; and its priors, for swiping. */
export function comparisonClouds({ id, priors, counts }: Comparison): Cloud[] {
  const changed = (classes: readonly PointClass[]): boolean =>
    classes.some((name) => name !== 'invalid' && counts[name] > 0);
  const context: Cloud = {
    from: ofComparison(id, ['unchanged', 'occluded', 'unseen']),
    what: 'The scan',
    side: 'after',
    important: false,
  };
  const fresh: Cloud = {
    from: ofComparison(id, ['added', 'discrepancy']),
    what: 'What was added',
    side: 'after',
    important: true,
  };
  const gone: Cloud = {
    from: ofComparison(id, ['removed']),
    what: 'What was removed',
    side: 'before',
    important: true,
  };
  return [
    context,
    ...(changed(['added', 'discrepancy']) ? [fresh] : []),
    ...(changed(['removed']) ? [gone] : []),
    ...priors.map(({ scan }): Cloud => ({
      from: scanPoints(scan),
      what: `Scan ${scan}`,
      side: 'before',
      important: false,
      onlySwiped: true,
    })),
  ];
}

export const marksOf = (scan: Pick<Schema<'Scan'>, 'id' | 'pose' | 'sensor'>): Mark[] => [
  { key: `scan-${scan.id}`, place_m: vectorOf(scan.pose.position_m), text: scan.sensor },
];
