// Which time is asked about: a day, a week, a month, everything, or what is typed.

import { setQuery, useKeys } from '../../app/app';
import { type KeyBinding } from '../../lib/keys';
import { TimeFilter } from '../../ui/filters';
import { Icon } from '../../ui/icon';
import { KeyHint } from '../../ui/key_hint';
import { kSpans, neighbour, type Range, type Span, spanAround, spanOf } from './range';

export function setRange(range: Range | undefined): void {
  const text = (moment_ms: number | undefined): string | undefined =>
    moment_ms === undefined ? undefined : new Date(moment_ms).toISOString();
  setQuery({ from: text(range?.from_ms), to: text(range?.to_ms), interval: undefined, month: undefined });
}

export function RangeBar({ range, zone, around_ms }: { range: Range | undefined; zone: string; around_ms: number }) {
  const span = range && spanOf(range, zone);
  const choose = (wanted: Span): void => setRange(spanAround(range?.from_ms ?? around_ms, wanted, zone));
  const move = (by: 1 | -1): void => {
    if (range) setRange(neighbour(range, by, zone));
  };
  const keys: KeyBinding[] = [
    { key: 'd', does: 'show the day', run: () => choose('day') },
    { key: 'w', does: 'show the week', run: () => choose('week') },
    { key: 'm', does: 'show the month', run: () => choose('month') },
    { key: 'e', does: 'show everything', run: () => setRange(undefined) },
    { key: 'p', does: 'the time before', run: () => move(-1) },
    { key: 'n', does: 'the time after', run: () => move(1) },
  ];
  useKeys(keys);
  return (
    <div class="toolbar panel-body range-bar">
      <div class="actions" role="group" aria-label="Zoom">
        <button type="button" aria-label="The time before" disabled={!range} onClick={() => move(-1)}>
          <Icon name="back" />
        </button>
        {kSpans.map((each) => (
          <button key={each} type="button" aria-pressed={span === each} onClick={() => choose(each)}>
            {each} <KeyHint keys={each.charAt(0)} />
          </button>
        ))}
        <button type="button" aria-pressed={range === undefined} onClick={() => setRange(undefined)}>
          everything <KeyHint keys="e" />
        </button>
        <button type="button" aria-label="The time after" disabled={!range} onClick={() => move(1)}>
          <Icon name="next" />
        </button>
      </div>
      <div class="actions">
        <TimeFilter />
      </div>
    </div>
  );
}
