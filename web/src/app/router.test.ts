import { describe, expect, it } from 'vitest';
import { linkTo, matchPath, parseLocation } from './router';

describe('links', () => {
  it('name views with their parameters', () => {
    expect(matchPath('/alerts/:id', '/alerts/7')).toEqual({ id: '7' });
    expect(matchPath('/alerts/:id', '/alerts/7/')).toEqual({ id: '7' });
    expect(matchPath('/alerts/:id', '/alerts')).toBeUndefined();
    expect(matchPath('/', '/')).toEqual({});
    expect(matchPath('/', '/alerts')).toBeUndefined();
    expect(matchPath('/sensors/:name', '/sensors/north%20mast')).toEqual({ name: 'north mast' });
    expect(matchPath('/sensors/:name', '/sensors/50%')).toEqual({ name: '50%' });
  });

  it('read back as they were written', () => {
    const link = linkTo('/alerts', { state: 'open', site: 'yard & gate', cursor: undefined, sensor: '' });
    expect(link).toBe('/alerts?state=open&site=yard+%26+gate');
    expect(parseLocation(link)).toEqual({ path: '/alerts', query: { state: 'open', site: 'yard & gate' } });
  });
});
