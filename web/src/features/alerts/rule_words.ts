import { type Schema } from '../../lib/api';
import { count, counted, duration, metres, volume } from '../../lib/format';

type Rule = Pick<
  Schema<'Rule'>,
  'kinds' | 'min_points' | 'min_volume_m3' | 'min_extent_m' | 'persistence' | 'zone' | 'schedule'
>;

/** A rule as a sentence without its end: "what was added or removed, anywhere, seen in 2 of the last 3 scans …". */
export function ruleInWords(rule: Rule): string {
  const { scans = 1, of = 1, seconds = 0 } = rule.persistence;
  const least = [
    rule.min_points > 0 ? counted(rule.min_points, 'point') : '',
    rule.min_volume_m3 > 0 ? volume(rule.min_volume_m3) : '',
    rule.min_extent_m > 0 ? `${metres(rule.min_extent_m)} in extent` : '',
  ].filter(Boolean);
  return [
    `what was ${rule.kinds.join(' or ')}`,
    rule.zone === null ? 'anywhere' : `in zone ${rule.zone}`,
    least.length > 0 ? `of at least ${least.join(', ')}` : '',
    of > 1 || scans > 1 ? `seen in ${count(scans)} of the last ${count(of)} scans that could see the place` : 'at once',
    seconds > 0 ? `for at least ${duration(seconds)}` : '',
    rule.schedule.length > 0 ? 'at its hours of the week' : '',
  ]
    .filter(Boolean)
    .join(', ');
}
