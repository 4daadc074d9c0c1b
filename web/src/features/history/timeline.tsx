// The intervals of a place on a line of time. Each piece is a button; the arrow keys go from one to the next.

import { useRef } from 'preact/hooks';
import { counted, dateTime } from '../../lib/format';
import { type Range } from './range';
import { type Piece, piecesOf, type Tick, ticksOf } from './timeline_scale';
import { type Interval, stateWords } from './words';

/** Later ticks would be cut off. */
const kLastTick = 0.94;
/** Pieces with less than this share of the line have no room for a word. */
const kRoomForWord = 0.09;
const percentOf = (share: number): string => `${(share * 100).toFixed(3)}%`;

export interface TimelineProps {
  readonly intervals: readonly Interval[];
  readonly range: Range;
  readonly zone: string;
  /** The first scan of the interval that is looked at. */
  readonly selected: number | undefined;
  readonly onSelect: (firstScan: number) => void;
}

export function Timeline({ intervals, range, zone, selected, onSelect }: TimelineProps) {
  const line = useRef<HTMLDivElement>(null);
  const pieces = piecesOf(intervals, range);
  const isSelected = (piece: Piece): boolean => piece.intervals.some(({ first_scan }) => first_scan === selected);
  const current = Math.max(0, pieces.findIndex(isSelected));
  const go = (index: number): void => {
    const piece = pieces[index]?.intervals[0];
    if (!piece) return;
    onSelect(piece.first_scan);
    line.current?.querySelectorAll('button')[index]?.focus();
  };
  const onKeyDown = (event: KeyboardEvent): void => {
    const to = {
      ArrowRight: Math.min(pieces.length - 1, current + 1),
      ArrowLeft: Math.max(0, current - 1),
      Home: 0,
      End: pieces.length - 1,
    }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    go(to);
  };
  return (
    <div class="timeline">
      <div ref={line} class="timeline-line" role="group" aria-label="Timeline" onKeyDown={onKeyDown}>
        {pieces.map((piece, index) => (
          <button
            key={piece.intervals[0]?.first_scan}
            type="button"
            class={`piece piece-${stateOf(piece)}`}
            style={{ left: percentOf(piece.from), width: percentOf(piece.to - piece.from) }}
            aria-pressed={isSelected(piece)}
            aria-label={inWords(piece, zone)}
            title={inWords(piece, zone)}
            tabIndex={index === current ? 0 : -1}
            onClick={() => go(index)}
          >
            {piece.to - piece.from > kRoomForWord && <span aria-hidden="true">{shortWords(piece)}</span>}
          </button>
        ))}
      </div>
      <div class="timeline-ticks" aria-hidden="true">
        {ticksOf(range, zone)
          .filter(({ share }) => share < kLastTick)
          .map((tick, index) => (
            <span
              key={tick.moment_ms}
              class={index % 2 ? 'tick tick-odd' : 'tick'}
              style={{ left: percentOf(tick.share) }}
            >
              {tickWords(tick, zone)}
            </span>
          ))}
      </div>
    </div>
  );
}

const stateOf = ({ intervals }: Piece): Interval['state'] | 'several' =>
  intervals.length === 1 && intervals[0] ? intervals[0].state : 'several';

const shortWords = (piece: Piece): string => {
  const state = stateOf(piece);
  return state === 'several' ? 'changing' : stateWords(state);
};

function inWords(piece: Piece, zone: string): string {
  const first = piece.intervals[0];
  const last = piece.intervals.at(-1);
  if (!first || !last) return '';
  const time = `${dateTime(first.from, zone)} to ${dateTime(last.to, zone)}`;
  return piece.intervals.length > 1
    ? `${counted(piece.intervals.length, 'interval')}, ${time}`
    : `${stateWords(first.state)}, ${time}, ${counted(first.scans, 'scan')}`;
}

const clocks = new Map<string, Intl.DateTimeFormat>();

/** "09:30", "09:30:10" or "1 Mar"; the zone is named beside the timeline. */
function tickWords({ moment_ms, step }: Tick, zone: string): string {
  const key = zone + step;
  let clock = clocks.get(key);
  if (!clock) {
    const options: Intl.DateTimeFormatOptions =
      step === 'day'
        ? { day: 'numeric', month: 'short' }
        : { hour: '2-digit', minute: '2-digit', ...(step === 'second' ? { second: '2-digit' } : {}) };
    clocks.set(key, (clock = new Intl.DateTimeFormat('en-GB', { timeZone: zone, ...options })));
  }
  return clock.format(moment_ms);
}
