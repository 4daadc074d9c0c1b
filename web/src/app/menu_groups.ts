interface Entry {
  readonly pattern: string;
}

const kGroups: readonly { readonly title: string; readonly patterns: readonly string[] }[] = [
  { title: 'Watch', patterns: ['/', '/alerts', '/history', '/tracks'] },
  { title: 'Observe', patterns: ['/scans', '/comparisons', '/sensors', '/surveys'] },
  { title: 'Decide', patterns: ['/zones', '/rules', '/baselines', '/silences'] },
  { title: 'Tell and keep', patterns: ['/channels', '/deliveries', '/storage'] },
];

/** Groups in the order of the menu, without those that would be empty. */
export function groupsOf<View extends Entry>(views: readonly View[]): { title: string; entries: View[] }[] {
  const named = new Set(kGroups.flatMap(({ patterns }) => patterns));
  const groups = kGroups.map(({ title, patterns }) => ({
    title,
    entries: patterns.flatMap((pattern) => views.filter((view) => view.pattern === pattern)),
  }));
  const others = { title: 'More', entries: views.filter(({ pattern }) => !named.has(pattern)) };
  return [...groups, others].filter(({ entries }) => entries.length > 0);
}
