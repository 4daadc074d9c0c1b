// Every view has a link: the path says which, the query how it is filtered. Nothing else decides what is shown.

export interface Location {
  readonly path: string;
  readonly query: Readonly<Record<string, string>>;
}

export type RouterAction = { type: 'location/changed'; location: Location };

export const reduceLocation = (_: Location, action: RouterAction): Location => action.location;

export function parseLocation(href: string): Location {
  const url = new URL(href, 'http://dashboard');
  return { path: url.pathname, query: Object.fromEntries(url.searchParams) };
}

/** A link to a view; parameters without a value are left out. */
export function linkTo(path: string, query: Readonly<Record<string, string | number | undefined>> = {}): string {
  const given = Object.entries(query).filter(([, value]) => value !== undefined && value !== '');
  const text = new URLSearchParams(given.map(([name, value]) => [name, String(value)])).toString();
  return text === '' ? path : `${path}?${text}`;
}

/** What the placeholders of a pattern such as "/alerts/:id" stand for in a path; nothing when it does not match. */
export function matchPath(pattern: string, path: string): Record<string, string> | undefined {
  const parts = pattern.split('/');
  const segments = path.replace(/\/+$/, '').split('/');
  if (parts.length !== segments.length && pattern !== '/') return undefined;
  if (pattern === '/') return path === '/' ? {} : undefined;
  const values: Record<string, string> = {};
  for (const [index, part] of parts.entries()) {
    const segment = segments[index] ?? '';
    if (part.startsWith(':')) values[part.slice(1)] = decode(segment);
    else if (part !== segment) return undefined;
  }
  return values;
}

function decode(segment: string): string {
  try {
    return decodeURIComponent(segment);
  } catch {
    return segment;
  }
}
