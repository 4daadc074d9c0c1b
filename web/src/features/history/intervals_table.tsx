// The intervals as a table, the latest first, with the scans at their ends.

import { useState } from 'preact/hooks';
import { counted, duration } from '../../lib/format';
import { StateBadge } from '../../ui/badges';
import { Time } from '../../ui/time';
import { type Interval, stateWords } from './words';

const kRowsAtOnce = 50;
const kTone = { free: 'good', occupied: 'busy', not_seen: 'plain' } as const;

export function PresenceBadge({ state }: { state: Interval['state'] }) {
  return <StateBadge tone={kTone[state]}>{stateWords(state)}</StateBadge>;
}

const lasted = ({ from, to }: Interval): string => {
  const seconds = (Date.parse(to) - Date.parse(from)) / 1000;
  return seconds > 0 ? duration(seconds) : 'one scan';
};

export function IntervalsTable({
  intervals,
  site,
  selected,
  onSelect,
}: {
  intervals: readonly Interval[];
  site: string;
  selected: number | undefined;
  onSelect: (firstScan: number) => void;
}) {
  const [shown, setShown] = useState(kRowsAtOnce);
  const latestFirst = [...intervals].reverse();
  return (
    <>
      <div class="table-scroll" tabIndex={0} role="region" aria-label="intervals">
        <table>
          <caption class="visually-hidden">Intervals of this place</caption>
          <thead>
            <tr>
              <th scope="col">State</th>
              <th scope="col">From</th>
              <th scope="col">To</th>
              <th scope="col" class="numeric not-narrow">
                At least
              </th>
              <th scope="col" class="numeric not-narrow">
                Scans
              </th>
              <th scope="col" class="numeric not-narrow">
                Could not see it
              </th>
            </tr>
          </thead>
          <tbody>
            {latestFirst.slice(0, shown).map((interval) => (
              <tr
                key={interval.first_scan}
                class={interval.first_scan === selected ? 'interval-selected' : ''}
                onClick={() => onSelect(interval.first_scan)}
              >
                <td>
                  <PresenceBadge state={interval.state} />
                </td>
                <td>
                  <Time at={interval.from} site={site} />{' '}
                  <a href={`/scans/${interval.first_scan}`}>scan {interval.first_scan}</a>
                </td>
                <td>
                  <Time at={interval.to} site={site} />{' '}
                  <a href={`/scans/${interval.last_scan}`}>scan {interval.last_scan}</a>
                </td>
                <td class="numeric not-narrow">{lasted(interval)}</td>
                <td class="numeric not-narrow">{interval.scans}</td>
                <td class="numeric not-narrow">{interval.not_seen}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
      {latestFirst.length > shown && (
        <div class="pages">
          <button type="button" onClick={() => setShown(shown + kRowsAtOnce)}>
            Earlier ones: {counted(latestFirst.length - shown, 'interval')} more
          </button>
        </div>
      )}
    </>
  );
}
