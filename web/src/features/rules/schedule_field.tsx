import { Icon } from '../../ui/icon';
import { wholeWeek, type WindowDraft } from './draft';
import { kDays } from './rule_words';

/** The hours of the week in which a rule holds, in the site's time zone. */
export function ScheduleField({
  schedule,
  time_zone,
  error,
  onSchedule,
}: {
  schedule: readonly WindowDraft[];
  time_zone: string;
  error: (field: string) => string | undefined;
  onSchedule: (schedule: readonly WindowDraft[]) => void;
}) {
  return (
    <fieldset class="form-part">
      <legend>Hours</legend>
      <p class="field-hint">
        {schedule.length === 0
          ? 'It holds at all hours.'
          : `It holds in these hours only, on the clock of ${time_zone}. An end that is not after its start is on the next day.`}
      </p>
      {schedule.map((window, index) => (
        <WindowField
          key={index}
          number={index + 1}
          window={window}
          error={
            error(`schedule.${index}`) ??
            error(`schedule.${index}.days`) ??
            error(`schedule.${index}.from`) ??
            error(`schedule.${index}.to`)
          }
          onWindow={(changed) =>
            onSchedule(schedule.flatMap((each, at) => (at !== index ? [each] : changed ? [changed] : [])))
          }
        />
      ))}
      <div class="actions">
        <button type="button" onClick={() => onSchedule([...schedule, wholeWeek])}>
          {schedule.length === 0 ? 'Only at certain hours' : 'Add hours'}
        </button>
      </div>
    </fieldset>
  );
}

function WindowField({
  number,
  window: { days, from, to },
  error,
  onWindow,
}: {
  number: number;
  window: WindowDraft;
  error: string | undefined;
  onWindow: (window: WindowDraft | undefined) => void;
}) {
  const toggled = (day: WindowDraft['days'][number]): WindowDraft['days'] =>
    kDays.map((each) => each.day).filter((each) => days.includes(each) !== (each === day));
  const time = (name: 'from' | 'to', value: string) => (
    <label class="inline-field">
      {name}
      <input
        type="time"
        required
        aria-label={`${name}, hours ${number}`}
        value={value}
        onChange={(event) => onWindow({ days, from, to, [name]: event.currentTarget.value })}
      />
    </label>
  );
  return (
    <div class="rule-window" role="group" aria-label={`Hours ${number}`}>
      <div class="rule-days">
        {kDays.map(({ day, word }) => (
          <button
            key={day}
            type="button"
            aria-pressed={days.includes(day)}
            onClick={() => onWindow({ days: toggled(day), from, to })}
          >
            {word}
          </button>
        ))}
      </div>
      <div class="actions">
        {time('from', from)}
        {time('to', to)}
        <button
          type="button"
          class="quiet"
          aria-label={`Take hours ${number} away`}
          onClick={() => onWindow(undefined)}
        >
          <Icon name="close" />
        </button>
      </div>
      {error && <span class="field-bad">{error}</span>}
    </div>
  );
}
