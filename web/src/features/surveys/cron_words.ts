// A cron expression in words, for the shapes that people use; the others stay as they are written.

const kDays = ['Sunday', 'Monday', 'Tuesday', 'Wednesday', 'Thursday', 'Friday', 'Saturday'];
const kMonths = [
  'January',
  'February',
  'March',
  'April',
  'May',
  'June',
  'July',
  'August',
  'September',
  'October',
  'November',
  'December',
];
const kNamed: Readonly<Record<string, string>> = {
  '@hourly': '0 * * * *',
  '@daily': '0 0 * * *',
  '@midnight': '0 0 * * *',
  '@weekly': '0 0 * * 0',
  '@monthly': '0 0 1 * *',
  '@yearly': '0 0 1 1 *',
  '@annually': '0 0 1 1 *',
};

/** "every day at 13:00"; nothing when it is none of the usual shapes. */
export function cronInWords(cron: string): string | undefined {
  const fields = (kNamed[cron.trim().toLowerCase()] ?? cron.trim()).split(/\s+/);
  if (fields.length !== 5) return undefined;
  const [minute = '', hour = '', day = '', month = '', weekday = ''] = fields;
  const when = clockWords(minute, hour);
  const days = dayWords(day, month, weekday);
  if (when === undefined || days === undefined) return undefined;
  return when.startsWith('every') ? (days === 'every day' ? when : `${when}, ${days}`) : `${days} ${when}`;
}

/** The numbers of a list such as "1,3"; nothing for anything else, or beyond `most`. */
function listed(field: string, least: number, most: number): number[] | undefined {
  if (!/^\d+(,\d+)*$/.test(field)) return undefined;
  const values = field.split(',').map(Number);
  return values.every((value) => value >= least && value <= most) ? values : undefined;
}

const joined = (words: readonly string[]): string =>
  words.length < 2 ? words.join('') : `${words.slice(0, -1).join(', ')} and ${words.at(-1)}`;
const two = (value: number): string => String(value).padStart(2, '0');

function clockWords(minute: string, hour: string): string | undefined {
  const step = /^\*\/(\d+)$/;
  const minuteStep = step.exec(minute)?.[1];
  if (minuteStep && Number(minuteStep) > 0) return hour === '*' ? `every ${minuteStep} minutes` : undefined;
  const minutes = listed(minute, 0, 59);
  if (!minutes) return minute === '*' && hour === '*' ? 'every minute' : undefined;
  const past = joined(minutes.map((value) => `:${two(value)}`));
  if (hour === '*') return `every hour at ${past}`;
  const hourStep = step.exec(hour)?.[1];
  if (hourStep && Number(hourStep) > 0) return `every ${hourStep} hours at ${past}`;
  const hours = listed(hour, 0, 23);
  return hours && `at ${joined(hours.flatMap((h) => minutes.map((m) => `${two(h)}:${two(m)}`)))}`;
}

function dayWords(day: string, month: string, weekday: string): string | undefined {
  const months = month === '*' ? [] : listed(month, 1, 12);
  if (!months) return undefined;
  const of = joined(months.map((value) => kMonths[value - 1]!));
  if (day === '*' && weekday === '*') return of === '' ? 'every day' : `every day of ${of}`;
  if (day === '*') {
    const names = weekdayWords(weekday);
    return names && (of === '' ? names : `${names} in ${of}`);
  }
  const days = weekday === '*' ? listed(day, 1, 31) : undefined;
  return days && `on day ${joined(days.map(String))} of ${of === '' ? 'every month' : of}`;
}

function weekdayWords(field: string): string | undefined {
  const numbered = field.toLowerCase().replace(/[a-z]+/g, (name) => {
    const index = kDays.findIndex((each) => each.slice(0, 3).toLowerCase() === name);
    return index < 0 ? name : String(index);
  });
  const range = /^([0-7])-([0-7])$/.exec(numbered);
  if (range) return `${kDays[Number(range[1]) % 7]} to ${kDays[Number(range[2]) % 7]}`;
  const days = listed(numbered, 0, 7);
  return days && `every ${joined(days.map((value) => kDays[value % 7]!))}`;
}
