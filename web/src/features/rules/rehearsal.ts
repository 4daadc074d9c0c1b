// What came out of trying a rule on the past, by days of the site.

import type { Schema } from '../../lib/api';
import { localOf } from '../../lib/zone';

export type Rehearsed = NonNullable<Schema<'RuleTestResult'>['alerts']>[number];

/** How many would have opened on each day on which any did, in the site's time zone: "2026-03-01". */
export function perDay(alerts: readonly Rehearsed[], time_zone: string): { day: string; count: number }[] {
  const counts = new Map<string, number>();
  for (const { at } of alerts) {
    const day = localOf(new Date(at), time_zone).slice(0, 10);
    counts.set(day, (counts.get(day) ?? 0) + 1);
  }
  return [...counts].map(([day, count]) => ({ day, count })).sort((one, other) => one.day.localeCompare(other.day));
}
