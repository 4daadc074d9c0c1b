import { describe, expect, it } from 'vitest';
import { cubicMetres, figureText, interval, referenceInWords, riseMetres, worst } from './words';

describe('figures of surveys', () => {
  it('have their unit, a sign where it matters, and no false precision', () => {
    expect(cubicMetres(1216.17)).toBe('1,216\u00a0m³');
    expect(cubicMetres(1216.17, true)).toBe('+1,216\u00a0m³');
    expect(cubicMetres(-12.34, true)).toBe('−12.3\u00a0m³');
    expect(cubicMetres(-0.01, true)).toBe('0.0\u00a0m³');
    expect(figureText('greatest_fall_m', -7.861)).toBe('−7.86\u00a0m');
    expect(figureText('seen_share', 0.698)).toBe('70\u00a0%');
    expect(riseMetres(0.5)).toBe('+0.50\u00a0m');
  });

  it('have both ends of an interval as exact as the larger one, and say when one is open', () => {
    expect(interval(-41.2, 1279.4, 'm³', true)).toBe('−41 to +1,279\u00a0m³');
    expect(interval(3.21, 8.9, 't')).toBe('3.2 to 8.9\u00a0t');
    expect(interval(null, 40)).toBe('at most 40.0\u00a0m³');
    expect(interval(null, null)).toBe('no bounds');
  });

  it('are as bad as the worst of their levels', () => {
    expect(worst(['green', 'orange', null, 'yellow'])).toBe('orange');
    expect(worst([null])).toBeUndefined();
  });

  it('say what they are compared with', () => {
    expect(referenceInWords({ policy: 'days_ago', days: 7, epoch: null })).toBe('the same time 7 days ago');
  });
});
