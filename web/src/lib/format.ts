// Numbers with their units and times with their zone, as people read them. A number never stands alone, and its unit
// stays in its line (\u00a0).

const numbers = new Map<string, Intl.NumberFormat>();

/** What rounds to zero has no sign. */
function number(value: number, options: Intl.NumberFormatOptions): string {
  const key = JSON.stringify(options);
  let format = numbers.get(key);
  if (!format) numbers.set(key, (format = new Intl.NumberFormat('en-GB', options)));
  const text = format.format(value);
  return /[1-9]/.test(text) ? text : text.replace('-', '');
}

export const count = (value: number): string => number(value, { maximumFractionDigits: 0 });

/** "1 scan", "3,214 scans". */
export const counted = (value: number, one: string, many = `${one}s`): string =>
  `${count(value)} ${value === 1 ? one : many}`;

/** "1.25 m", "0.031 m". */
export const metres = (value: number, digits = 2): string =>
  `${number(value, { minimumFractionDigits: digits, maximumFractionDigits: digits })}\u00a0m`;

/** "24.0 m²", "1,250 m²". */
export const squareMetres = (value: number): string =>
  `${number(value, value < 100 ? { minimumFractionDigits: 1, maximumFractionDigits: 1 } : { maximumFractionDigits: 0 })}\u00a0m²`;

/** "0.42 × 0.31 × 0.55 m". */
export const sizeMetres = (size: readonly number[]): string =>
  `${size.map((side) => side.toFixed(2)).join(' × ')}\u00a0m`;

/** "(3.20, 1.50, 0.40) m". */
export const placeMetres = (place: readonly number[]): string =>
  `(${place.map((part) => part.toFixed(2)).join(', ')})\u00a0m`;

/** Litres below a tenth of a cubic metre: "71.6 L", "1.20 m³". */
export const volume = (cubicMetres: number): string =>
  cubicMetres < 0.1
    ? `${number(cubicMetres * 1000, { maximumSignificantDigits: 3 })}\u00a0L`
    : `${number(cubicMetres, { maximumSignificantDigits: 3 })}\u00a0m³`;

export const percent = (share: number, digits = 0): string =>
  `${number(share * 100, { minimumFractionDigits: digits, maximumFractionDigits: digits })}\u00a0%`;

export const degrees = (value: number, digits = 2): string => `${value.toFixed(digits)}°`;

export function bytes(value: number): string {
  const units = ['B', 'kB', 'MB', 'GB', 'TB', 'PB'];
  const power = Math.min(units.length - 1, value > 0 ? Math.floor(Math.log10(value) / 3) : 0);
  return `${number(value / 1000 ** power, { maximumSignificantDigits: 3 })}\u00a0${units[power]}`;
}

/** "340 ms", "42 s", "3 min", "2 h 05 min", "4 d 3 h". */
export function duration(seconds: number): string {
  if (seconds < 1) return `${Math.round(seconds * 1000)}\u00a0ms`;
  if (seconds < 60) return `${number(seconds, { maximumFractionDigits: seconds < 10 ? 1 : 0 })}\u00a0s`;
  const minutes = Math.floor(seconds / 60);
  if (minutes < 60) return `${minutes}\u00a0min`;
  const hours = Math.floor(minutes / 60);
  if (hours < 24) return `${hours}\u00a0h\u00a0${String(minutes % 60).padStart(2, '0')}\u00a0min`;
  return `${Math.floor(hours / 24)}\u00a0d\u00a0${hours % 24}\u00a0h`;
}

/** "just now", "3 min ago", "in 2 h 00 min". */
export function ago(time: string, now_ms: number): string {
  const seconds = (now_ms - Date.parse(time)) / 1000;
  if (Math.abs(seconds) < 5) return 'just now';
  return seconds > 0 ? `${duration(seconds)} ago` : `in ${duration(-seconds)}`;
}

const times = new Map<string, Intl.DateTimeFormat>();

function timeFormat(zone: string, options: Intl.DateTimeFormatOptions): Intl.DateTimeFormat {
  const key = zone + JSON.stringify(options);
  let format = times.get(key);
  if (!format) times.set(key, (format = new Intl.DateTimeFormat('en-GB', { timeZone: zone, ...options })));
  return format;
}

/** "22 Nov 2026, 14:03:05 CET": in the site's zone, which is named. */
export function dateTime(time: string, zone: string): string {
  return timeFormat(zone, {
    day: 'numeric',
    month: 'short',
    year: 'numeric',
    hour: '2-digit',
    minute: '2-digit',
    second: '2-digit',
    timeZoneName: 'short',
  }).format(new Date(time));
}

/** As much of the date as is needed: "14:03:05 CET", "21 Nov, 23:10:00 CET", "31 Dec 2025, 23:10:00 CET". */
export function shortTime(time: string, zone: string, now_ms: number): string {
  const moment = new Date(time);
  const now = new Date(now_ms);
  const same = (options: Intl.DateTimeFormatOptions): boolean =>
    timeFormat(zone, options).format(moment) === timeFormat(zone, options).format(now);
  if (!same({ year: 'numeric' })) return dateTime(time, zone);
  const clock: Intl.DateTimeFormatOptions = {
    hour: '2-digit',
    minute: '2-digit',
    second: '2-digit',
    timeZoneName: 'short',
  };
  if (same({ month: 'numeric', day: 'numeric' })) return timeFormat(zone, clock).format(moment);
  return timeFormat(zone, { day: 'numeric', month: 'short', ...clock }).format(moment);
}

/** "Fri 20 Nov", "Fri 20 Nov 2020": the year where it is not that of now. */
export function dayOf(time: string, zone: string, now_ms: number): string {
  const parts = (moment: Date): Partial<Record<string, string>> =>
    Object.fromEntries(
      timeFormat(zone, { weekday: 'short', day: 'numeric', month: 'short', year: 'numeric' })
        .formatToParts(moment)
        .map(({ type, value }) => [type, value]),
    );
  const { weekday, day, month, year } = parts(new Date(time));
  // Put together here: where commas stand is not the same everywhere.
  return `${weekday} ${day} ${month}${year === parts(new Date(now_ms))['year'] ? '' : ` ${year}`}`;
}

/** "13:00 GMT+8". */
export const clockOf = (time: string, zone: string): string =>
  timeFormat(zone, { hour: '2-digit', minute: '2-digit', timeZoneName: 'short' }).format(new Date(time));
