import { describe, expect, it } from 'vitest';
import { cronInWords } from './cron_words';

describe('a cron expression', () => {
  it.each([
    ['0 13 * * *', 'every day at 13:00'],
    ['30 5,17 * * *', 'every day at 05:30 and 17:30'],
    ['30 5 * * 1-5', 'Monday to Friday at 05:30'],
    ['30 5 * * mon-fri', 'Monday to Friday at 05:30'],
    ['0 6 * * 1,4', 'every Monday and Thursday at 06:00'],
    ['15 2 1 * *', 'on day 1 of every month at 02:15'],
    ['0 0 1 1 *', 'on day 1 of January at 00:00'],
    ['*/15 * * * *', 'every 15 minutes'],
    ['5 * * * *', 'every hour at :05'],
    ['0 */6 * * *', 'every 6 hours at :00'],
    ['@weekly', 'every Sunday at 00:00'],
    ['@hourly', 'every hour at :00'],
  ])('%s is %s', (cron, words) => expect(cronInWords(cron)).toBe(words));

  it('of another shape, or a broken one, is left as it is', () => {
    for (const cron of ['', '0 13 * *', '0 25 * * *', '1-5 13 * * *', '0 0 13 * 5', '0 5 * foo *'])
      expect(cronInWords(cron)).toBeUndefined();
  });
});
