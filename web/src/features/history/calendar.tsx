// A month as a calendar has it: each day coloured by how much happened on it. A day that is chosen becomes the range.

import { useRef, useState } from 'preact/hooks';
import { setQuery, useResource, useSelect } from '../../app/app';
import { address, type Schema } from '../../lib/api';
import { count, counted } from '../../lib/format';
import { Icon } from '../../ui/icon';
import { ErrorState } from '../../ui/states';
import { addDays, addMonths, dateOf, type Range, spanAround, startOf, weekday } from './range';

type Day = Schema<'Calendar'>['days'][number];
const kCounts = [
  { key: 'scans', words: 'scans' },
  { key: 'tracks', words: 'changes' },
  { key: 'alerts', words: 'alerts' },
] as const;
type Count = (typeof kCounts)[number]['key'];

const kWeekdays = ['Mo', 'Tu', 'We', 'Th', 'Fr', 'Sa', 'Su'];

export interface CalendarProps {
  site: string;
  zone: string;
  range: Range | undefined;
  /** In the month that is shown when the link names none. */
  around_ms: number;
}

export function Calendar({ site, zone, range, around_ms }: CalendarProps) {
  const query = useSelect((state) => state.location.query);
  const month = /^\d{4}-\d{2}$/.test(query['month'] ?? '')
    ? `${query['month']}-01`
    : `${dateOf(around_ms, zone).slice(0, 7)}-01`;
  const shownCount = kCounts.find(({ key }) => key === query['count'])?.key ?? 'scans';
  const whole = spanAround(startOf(month, zone), 'month', zone);
  const calendar = useResource(
    address('/api/v1/calendar', {
      query: { site, from: new Date(whole.from_ms).toISOString(), to: new Date(whole.to_ms).toISOString() },
    }),
  );
  const show = (date: string): void => setQuery({ month: date.slice(0, 7) }, { replace: true });
  return (
    <div class="calendar">
      <div class="calendar-head">
        <button type="button" aria-label="Month before" onClick={() => show(addMonths(month, -1))}>
          <Icon name="back" />
        </button>
        <h3 aria-live="polite">{monthWords(month)}</h3>
        <button type="button" aria-label="Next month" onClick={() => show(addMonths(month, 1))}>
          <Icon name="next" />
        </button>
        <select
          aria-label="What is counted"
          value={shownCount}
          onChange={(event) => setQuery({ count: event.currentTarget.value }, { replace: true })}
        >
          {kCounts.map(({ key, words }) => (
            <option key={key} value={key}>
              {words}
            </option>
          ))}
        </select>
      </div>
      {calendar.problem && !calendar.data ? (
        <ErrorState problem={calendar.problem} />
      ) : (
        <Month
          key={month}
          first={month}
          days={calendar.data?.days ?? []}
          counts={shownCount}
          zone={zone}
          range={range}
          onMonth={show}
        />
      )}
    </div>
  );
}

const monthWords = (date: string): string =>
  new Intl.DateTimeFormat('en-GB', { month: 'long', year: 'numeric', timeZone: 'UTC' }).format(new Date(date));

interface MonthProps {
  first: string;
  days: readonly Day[];
  counts: Count;
  zone: string;
  range: Range | undefined;
  onMonth: (date: string) => void;
}

/** The dates of a month by weeks; those of the neighbouring months are left out. */
function weeksOf(first: string): (string | undefined)[][] {
  const end = addMonths(first, 1);
  const weeks: (string | undefined)[][] = [];
  for (let monday = addDays(first, -weekday(first)); monday < end; monday = addDays(monday, 7)) {
    weeks.push(
      Array.from({ length: 7 }, (_, day) => addDays(monday, day)).map((date) =>
        date >= first && date < end ? date : undefined,
      ),
    );
  }
  return weeks;
}

function Month({ first, days, counts, zone, range, onMonth }: MonthProps) {
  const grid = useRef<HTMLTableElement>(null);
  const chosen = (date: string): boolean => {
    const start_ms = startOf(date, zone);
    return range !== undefined && start_ms >= range.from_ms && start_ms < range.to_ms;
  };
  const weeks = weeksOf(first);
  const dates = weeks.flat().filter((date) => date !== undefined);
  const [focused, setFocused] = useState(() => dates.find(chosen) ?? first);
  const most = Math.max(1, ...days.map((day) => day[counts]));
  const go = (date: string): void => {
    if (date.slice(0, 7) !== first.slice(0, 7)) return onMonth(date);
    setFocused(date);
    grid.current?.querySelector<HTMLElement>(`[data-date="${date}"]`)?.focus();
  };
  const onKeyDown = (event: KeyboardEvent): void => {
    const to = {
      ArrowLeft: () => addDays(focused, -1),
      ArrowRight: () => addDays(focused, 1),
      ArrowUp: () => addDays(focused, -7),
      ArrowDown: () => addDays(focused, 7),
      Home: () => first,
      End: () => dates.at(-1) ?? first,
      PageUp: () => addMonths(focused, -1),
      PageDown: () => addMonths(focused, 1),
    }[event.key];
    if (!to) return;
    event.preventDefault();
    go(to());
  };
  return (
    <table ref={grid} class="calendar-days" aria-label={monthWords(first)} onKeyDown={onKeyDown}>
      <thead>
        <tr>
          {kWeekdays.map((day) => (
            <th key={day} scope="col">
              {day}
            </th>
          ))}
        </tr>
      </thead>
      <tbody>
        {weeks.map((week, index) => (
          <tr key={index}>
            {week.map((date, place) => (
              <td key={place}>
                {date !== undefined && (
                  <DayButton
                    date={date}
                    day={days.find((candidate) => candidate.date === date)}
                    counts={counts}
                    most={most}
                    chosen={chosen(date)}
                    reachable={date === focused}
                    onFocus={() => setFocused(date)}
                    zone={zone}
                  />
                )}
              </td>
            ))}
          </tr>
        ))}
      </tbody>
    </table>
  );
}

interface DayButtonProps {
  date: string;
  day: Day | undefined;
  counts: Count;
  most: number;
  chosen: boolean;
  reachable: boolean;
  onFocus: () => void;
  zone: string;
}

/** How much, in four steps of colour beside none; the number stands in the day, too. */
const levelOf = (value: number, most: number): number => (value === 0 ? 0 : Math.ceil((value / most) * 4));

function DayButton({ date, day, counts, most, chosen, reachable, onFocus, zone }: DayButtonProps) {
  const value = day?.[counts] ?? 0;
  const words = day
    ? `${counted(day.scans, 'scan')}, ${counted(day.tracks, 'change')}, ${counted(day.alerts, 'alert')}`
    : 'not known yet';
  const choose = (): void => {
    const { from_ms, to_ms } = spanAround(startOf(date, zone), 'day', zone);
    setQuery({
      from: new Date(from_ms).toISOString(),
      to: new Date(to_ms).toISOString(),
      interval: undefined,
      month: undefined,
    });
  };
  return (
    <button
      type="button"
      class={`day day-${levelOf(value, most)}`}
      data-date={date}
      aria-pressed={chosen}
      title={words}
      tabIndex={reachable ? 0 : -1}
      onFocus={onFocus}
      onClick={choose}
    >
      <span>{Number(date.slice(8))}</span>
      <span class="visually-hidden">
        {' '}
        {monthWords(date)}: {words}
      </span>
      <small aria-hidden="true">{value > 0 ? short(value) : ''}</small>
    </button>
  );
}

/** Fits into a day: "288", "12k". */
const short = (value: number): string =>
  value < 1000 ? count(value) : value < 1_000_000 ? `${count(value / 1000)}k` : `${count(value / 1_000_000)}M`;
