import { describe, expect, it } from 'vitest';
import { groupsOf } from './menu_groups';

describe('the menu', () => {
  it('has each view once, in groups, and those that no group names in the end', () => {
    const views = ['/storage', '/new-kind', '/alerts', '/'].map((pattern) => ({ pattern }));
    expect(groupsOf(views).map(({ title, entries }) => [title, ...entries.map(({ pattern }) => pattern)])).toEqual([
      ['Watch', '/', '/alerts'],
      ['Tell and keep', '/storage'],
      ['More', '/new-kind'],
    ]);
  });
});
