import { describe, expect, it } from 'vitest';
import { historyLink, isPoint, placeOf, placeQuery, pointPlace } from './place';

describe('a place in a link', () => {
  it('reads back as it was written', () => {
    const point = pointPlace([1.5, -2, 0.123456]);
    expect(placeQuery(point)).toEqual({ point: '1.5,-2,0.123' });
    expect(placeOf({ point: '1.5,-2,0.123' })).toEqual(pointPlace([1.5, -2, 0.123]));
    const box = { min_m: [0, 0, -1], max_m: [1, 2, 3] } as const;
    expect(isPoint(box)).toBe(false);
    expect(placeOf(placeQuery(box))).toEqual(box);
  });

  it('keeps the places of sites that lie far from zero', () => {
    expect(placeQuery(pointPlace([423000.5, 5462000.25, 210]))).toEqual({ point: '423000.5,5462000.25,210' });
  });

  it('is none when it is broken', () => {
    for (const point of ['', '1,2', '1,2,x', '1,,3', '1,2,3,4', '1,2,Infinity']) {
      expect(placeOf({ point })).toBeUndefined();
    }
    expect(placeOf({ box: '1,2,3' })).toBeUndefined();
    expect(placeOf({})).toBeUndefined();
  });

  it('is asked about at its site', () => {
    expect(historyLink('yard & gate', pointPlace([1, 2, 3]))).toBe('/history?site=yard+%26+gate&point=1%2C2%2C3');
  });
});
