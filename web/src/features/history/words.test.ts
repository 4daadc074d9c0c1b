import { describe, expect, it } from 'vitest';
import { historyInWords, type Interval } from './words';

const clock = (time: string): string => time.slice(11, 16);
const interval = (state: Interval['state'], from: string, to: string, scans = 2, not_seen = 0): Interval => ({
  state,
  from: `2026-03-01T${from}:00Z`,
  to: `2026-03-01T${to}:00Z`,
  first_scan: 1,
  last_scan: 2,
  scans,
  not_seen,
});

describe('the history of a place in words', () => {
  it('says when it changed, and how many scans between could not see it', () => {
    const intervals = [
      interval('free', '00:00', '02:10'),
      interval('not_seen', '02:15', '02:30', 3),
      interval('occupied', '02:40', '03:10'),
    ];
    expect(historyInWords(intervals, clock)).toEqual([
      'Free until 02:10, occupied since 02:40; 3 scans between could not see it.',
    ]);
  });

  it('tells the latest of many changes', () => {
    const intervals = Array.from({ length: 6 }, (_, hour) =>
      interval(hour % 2 ? 'occupied' : 'free', `0${hour}:00`, `0${hour}:50`),
    );
    expect(historyInWords(intervals, clock)).toEqual([
      'It changed 5 times; these are the latest.',
      'Free until 02:50, occupied since 03:00.',
      'Occupied until 03:50, free since 04:00.',
      'Free until 04:50, occupied since 05:00.',
    ]);
  });

  it('says what never changed, and what nobody saw', () => {
    expect(historyInWords([interval('free', '00:00', '05:00', 12, 2)], clock)).toEqual([
      'Free in all 12 scans that saw it; 2 scans between could not see it.',
    ]);
    expect(historyInWords([interval('not_seen', '00:00', '05:00', 12)], clock)).toEqual([
      'None of 12 scans could see this place.',
    ]);
    expect(historyInWords([], clock)).toEqual(['No scan was taken in this time.']);
  });

  it('says where the story is not seen to begin or end', () => {
    const intervals = [
      interval('not_seen', '00:00', '00:30'),
      interval('occupied', '01:00', '01:00', 1),
      interval('not_seen', '01:30', '02:00'),
    ];
    expect(historyInWords(intervals, clock)).toEqual([
      'Occupied in the one scan that saw it.',
      'Not seen before 01:00.',
      'Not seen since 01:30.',
    ]);
  });
});
