import { describe, expect, it } from 'vitest';
import { reduceUploads, type Upload, withSideCars } from './uploads';

describe('uploads', () => {
  it('go with their side-cars, however they were dropped', () => {
    const files = ['b.pcd.json', 'a.pcd', 'b.pcd', 'lone.json', 'c.las'].map((name) => ({ name }));
    const found = withSideCars(files).map(({ file, sideCar }) => [file.name, sideCar?.name]);
    expect(found).toEqual([
      ['a.pcd', undefined],
      ['b.pcd', 'b.pcd.json'],
      ['lone.json', undefined],
      ['c.las', undefined],
    ]);
  });

  it('are forgotten when they are over', () => {
    const upload = (id: number, state: Upload['state']): Upload => ({
      id,
      name: 'a',
      size_bytes: 1,
      sent_bytes: 0,
      state,
    });
    const all = (['waiting', 'sending', 'stored', 'known', 'failed'] as const).map((state, id) => upload(id, state));
    expect(reduceUploads(all, { type: 'upload/forgotten' }).map(({ state }) => state)).toEqual(['waiting', 'sending']);
    expect(reduceUploads(all, { type: 'upload/changed', id: 1, change: { sent_bytes: 7 } })[1]).toMatchObject({
      sent_bytes: 7,
    });
  });
});
