import { describe, expect, it } from 'vitest';
import { bodyOf, draftOf, faultsOf, hundredAlongX } from './coordinates_draft';

const grid = {
  site_origin_m: [391000, 6460000, 310] as [number, number, number],
  grid_origin_m: [5000, 10000, 1310] as [number, number, number],
  rotation_deg: 23.5,
  scale: 0.9996,
};

describe('the coordinates of a site', () => {
  it('go back as they came', () => {
    for (const given of [
      { epsg: 28350, mine_grid: null },
      { epsg: null, mine_grid: grid },
      { epsg: null, mine_grid: null },
    ])
      expect(bodyOf(draftOf({ ...given, origin_m: [1, 2, 3] }))).toEqual(given);
  });

  it('are of one kind: what is filled in of another is not sent', () => {
    const draft = draftOf({ epsg: 28350, mine_grid: null, origin_m: null });
    expect(bodyOf({ ...draft, kind: 'own' })).toEqual({ epsg: null, mine_grid: null });
    expect(faultsOf({ ...draft, kind: 'own' })).toEqual({});
  });

  it('begin a mine grid at the place from which the site is measured', () => {
    const draft = draftOf({ epsg: null, mine_grid: null, origin_m: [391000, 6460000, 310] });
    expect(draft.site_origin_m).toEqual(['391000', '6460000', '310']);
    expect(faultsOf({ ...draft, kind: 'mine_grid' })).toEqual({ 'mine_grid.grid_origin_m': 'needs three numbers' });
  });

  it('say where the x of the site leads: counter-clockwise from the x of the grid', () => {
    const draft = draftOf({ epsg: null, mine_grid: { ...grid, rotation_deg: 90, scale: 1.1 }, origin_m: null });
    const [east, north] = hundredAlongX(draft) ?? [NaN, NaN];
    expect(east).toBeCloseTo(0);
    expect(north).toBeCloseTo(110);
    expect(hundredAlongX({ ...draft, scale: '' })).toBeUndefined();
  });
});
