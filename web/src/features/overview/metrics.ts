// The figures of /metrics that the overview shows.

import { type Address } from '../../lib/api';

export const kMetrics = '/metrics' as Address<string>;

/** The values of a Prometheus text by name; those with labels are left out. */
export function parseMetrics(text: string): Readonly<Record<string, number>> {
  const values: Record<string, number> = {};
  for (const line of text.split('\n')) {
    const match = /^(\w+) (\S+)$/.exec(line);
    if (match?.[1] !== undefined) values[match[1]] = Number(match[2]);
  }
  return values;
}
