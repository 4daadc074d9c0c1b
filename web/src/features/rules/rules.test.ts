import { describe, expect, it } from 'vitest';
import { bodyOf, draftOf, faultsOf, newDraft, wholeWeek } from './draft';
import { perDay } from './rehearsal';
import { daysInWords, ruleSentence, scheduleInWords } from './rule_words';

const plain = (text: string): string => text.replaceAll('\u00a0', ' ');

describe('a rule in words', () => {
  it('says what, where and how long', () => {
    const rule = {
      kinds: ['added' as const],
      min_points: 20,
      persistence: { scans: 3, of: 4, seconds: 60 },
      severity: 'warning' as const,
    };
    expect(plain(ruleSentence(rule, 'Fence'))).toBe(
      'Warns when something of at least 20 points is added in Fence, seen in 3 of the last 4 scans that could see the place, for at least 1 min.',
    );
  });

  it('says the default as it is', () => {
    expect(ruleSentence({}, undefined)).toBe('Warns when anything is added or removed anywhere, at once.');
  });

  it('says hours of the week, also those that run on into the next day', () => {
    const night = { days: ['mon', 'tue', 'wed', 'thu', 'fri'] as const, from: '20:00', to: '06:00' };
    expect(scheduleInWords([{ ...night, days: [...night.days] }, { days: ['sat', 'sun'] }])).toBe(
      'Mon to Fri from 20:00 to 06:00 (the next day); Sat and Sun all day',
    );
    expect(scheduleInWords([])).toBe('at all hours');
    expect(daysInWords(['mon', 'tue', 'wed', 'sun'])).toBe('Mon to Wed and Sun');
    expect(daysInWords(wholeWeek.days)).toBe('every day');
  });
});

describe('a rule that is filled in', () => {
  it('comes back as it was sent', () => {
    const draft = {
      ...newDraft,
      name: 'gate by night',
      zone: '4',
      removed: false,
      min_points: '20',
      min_extent_m: '0.25',
      schedule: [{ days: ['mon', 'sun'] as const, from: '20:00', to: '06:00' }],
    };
    const body = bodyOf(draft, 'yard');
    expect(body).toMatchObject({ site: 'yard', zone: 4, kinds: ['added'], min_points: 20, min_volume_m3: 0 });
    const stored = { id: 1, created_at: '', edited_at: '', ...body } as Parameters<typeof draftOf>[0];
    expect(draftOf(stored)).toEqual(draft);
  });

  it('shows an end at midnight as fields for times take it', () => {
    const body = bodyOf({ ...newDraft, name: 'x' }, 'yard');
    const stored = { id: 1, created_at: '', edited_at: '', ...body, schedule: [{ to: '24:00' }] };
    expect(draftOf(stored as Parameters<typeof draftOf>[0]).schedule).toEqual([
      { days: wholeWeek.days, from: '00:00', to: '00:00' },
    ]);
  });

  it('says what is wrong by the names of its fields', () => {
    const draft = {
      ...newDraft,
      added: false,
      removed: false,
      scans: '3',
      of: '2',
      schedule: [{ ...wholeWeek, days: [] }],
    };
    expect(Object.keys(faultsOf(draft))).toEqual(['name', 'kinds', 'persistence.of', 'schedule.0']);
  });
});

describe('what would have alerted', () => {
  it('is counted by days of the site', () => {
    const at = (time: string) => ({ track: 1, scan: 1, at: time, severity: 'info' as const, resolved_at: null });
    const alerts = [at('2026-03-01T22:59:00Z'), at('2026-03-01T23:01:00Z'), at('2026-03-01T10:00:00Z')];
    expect(perDay(alerts, 'Europe/Berlin')).toEqual([
      { day: '2026-03-01', count: 2 },
      { day: '2026-03-02', count: 1 },
    ]);
  });
});
