// Times on the clock of a zone, for what a person types in.

const formats = new Map<string, Intl.DateTimeFormat>();

/** What a clock in the zone shows, as if it were UTC. */
function clockOf(moment_ms: number, zone: string): number {
  let format = formats.get(zone);
  if (!format) {
    format = new Intl.DateTimeFormat('en-GB', {
      timeZone: zone,
      hourCycle: 'h23',
      year: 'numeric',
      month: '2-digit',
      day: '2-digit',
      hour: '2-digit',
      minute: '2-digit',
      second: '2-digit',
    });
    formats.set(zone, format);
  }
  const part = Object.fromEntries(format.formatToParts(moment_ms).map(({ type, value }) => [type, Number(value)]));
  const { year = 0, month = 1, day = 1, hour = 0, minute = 0, second = 0 } = part;
  return Date.UTC(year, month - 1, day, hour, minute, second);
}

/** The moment at which a clock in the zone shows `local`, such as "2026-03-29T06:00". An hour that the clock leaves out
    in spring is the one after it; one that comes twice in autumn is the first. */
export function momentOf(local: string, zone: string): Date {
  const wanted = Date.parse(`${local}Z`);
  const early = wanted - (clockOf(wanted - 86_400_000, zone) - (wanted - 86_400_000));
  if (clockOf(early, zone) === wanted) return new Date(early);
  const late = wanted - (clockOf(wanted + 86_400_000, zone) - (wanted + 86_400_000));
  return new Date(clockOf(late, zone) === wanted ? late : early);
}

/** What a clock in the zone shows, as an <input type="datetime-local"> takes it: "2026-03-29T06:00". */
export function localOf(moment: Date, zone: string): string {
  return new Date(clockOf(moment.getTime(), zone)).toISOString().slice(0, 16);
}

/** The next time at which it is so late ("06:00") in the zone. */
export function nextTimeOfDay(time: string, zone: string, now_ms: number): Date {
  for (let days = 0; ; ++days) {
    const day = new Date(clockOf(now_ms, zone) + days * 86_400_000).toISOString().slice(0, 10);
    const moment = momentOf(`${day}T${time}`, zone);
    if (moment.getTime() > now_ms) return moment;
  }
}
