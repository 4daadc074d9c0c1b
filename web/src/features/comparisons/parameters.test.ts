import { describe, expect, it } from 'vitest';
import { type Parameters, parametersFrom, scansIn, textsFor } from './parameters';

const kDefaults: Parameters = {
  grouping: 'consensus',
  angle_deg: null,
  range_m: 0.15,
  clustering: true,
  cluster_min_points: 5,
  align: true,
};

describe('the parameters of a comparison', () => {
  it('are only sent where something is given', () => {
    const { parameters, errors } = parametersFrom('consensus', { angle_deg: '0.5', range_m: ' ', clustering: 'no' });
    expect(parameters).toEqual({ grouping: 'consensus', angle_deg: 0.5, clustering: false });
    expect(errors.size).toBe(0);
  });

  it('say which of them is no number', () => {
    const { parameters, errors } = parametersFrom('consensus', { angle_deg: 'wide', range_m: '0,2', min_range_m: '1' });
    expect(parameters).toEqual({ grouping: 'consensus', min_range_m: 1 });
    expect([...errors.keys()]).toEqual(['angle_deg', 'range_m']);
  });

  it('leave out what a union does not know', () => {
    const texts = { align: 'yes', growth_distance_m: '1', foliage_distance_m: 'x', range_m: '0.1' };
    expect(parametersFrom('union', texts)).toEqual({
      parameters: { grouping: 'union', range_m: 0.1 },
      errors: new Map(),
    });
  });

  it('are typed again from those of an earlier comparison', () => {
    const earlier = { ...kDefaults, angle_deg: 0.4, align: false };
    const texts = textsFor(earlier, kDefaults);
    expect(texts).toEqual({ angle_deg: '0.4', align: 'no' });
    expect(parametersFrom('consensus', texts).parameters).toEqual({
      grouping: 'consensus',
      angle_deg: 0.4,
      align: false,
    });
  });

  it('name scans in any way of writing a list', () => {
    expect(scansIn('3, 5 8;9')).toEqual([3, 5, 8, 9]);
    expect(scansIn('')).toEqual([]);
    for (const wrong of ['3-5', '0', 'three', '-1', '1.5']) expect(scansIn(wrong)).toBeUndefined();
  });
});
