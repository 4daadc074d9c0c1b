import { type Schema } from '../../lib/api';
import { count, counted, duration, metres, volume } from '../../lib/format';

type Rule = Pick<
  Schema<'Rule'>,
  'kinds' | 'min_points' | 'min_volume_m3' | 'min_extent_m' | 'persistence' | 'zone' | 'schedule'
>;

/** "20 points, 0.40 m in extent"; empty when anything is large enough. */
export const leastInWords = (rule: Pick<Rule, 'min_points' | 'min_volume_m3' | 'min_extent_m'>): string =>
  [
    rule.min_points > 0 ? counted(rule.min_points, 'point') : '',
    rule.min_volume_m3 > 0 ? volume(rule.min_volume_m3) : '',
    rule.min_extent_m > 0 ? `${metres(rule.min_extent_m)} in extent` : '',
  ]
    .filter(Boolean)
    .join(', ');

/** "seen in 2 of the last 3 scans that could see the place, for at least 20 s". */
export function lastingInWords({ scans = 1, of = 1, seconds = 0 }: Rule['persistence']): string {
  const seen =
    of > 1 || scans > 1 ? `seen in ${count(scans)} of the last ${count(of)} scans that could see the place` : 'at once';
  return seconds > 0 ? `${seen}, for at least ${duration(seconds)}` : seen;
}

/** A rule as a sentence without its end: "what was added or removed, anywhere, seen in 2 of the last 3 scans …". */
export function ruleInWords(rule: Rule): string {
  const least = leastInWords(rule);
  return [
    `what was ${rule.kinds.join(' or ')}`,
    rule.zone === null ? 'anywhere' : `in zone ${rule.zone}`,
    least === '' ? '' : `of at least ${least}`,
    lastingInWords(rule.persistence),
    rule.schedule.length > 0 ? 'at its hours of the week' : '',
  ]
    .filter(Boolean)
    .join(', ');
}
