import { describe, expect, it } from 'vitest';
import { bodyOf, differencesOf, draftOf, faultsOf, newDraft, newThreshold } from './schedule_draft';
import { type Schema } from '../../lib/api';

const schedule: Schema<'SurveySchedule'> = {
  id: 1,
  site: 'pit',
  name: 'nightly',
  enabled: true,
  cron: '0 13 * * *',
  time_zone: 'Australia/Perth',
  window_s: 21600,
  grace_s: 600,
  sensors: ['north'],
  required_sensors: ['north'],
  required_vantages: [2],
  catch_up: 'all',
  survey: {
    zones: [1],
    cell_m: 2,
    core_spacing_m: 1,
    density_t_per_m3: 2.65,
    greatest_slope_deg: 75,
    reference: { policy: 'previous', epoch: null, days: null },
    tolerance: { residual_m: 0.05, position_m: 0.05, angle_deg: 0.114591559 },
    thresholds: [
      {
        figure: 'cut_m3',
        zone: 1,
        yellow: 200,
        orange: null,
        red: 5000,
        clear_share: 0.8,
        raise_after: 1,
        clear_after: 2,
      },
    ],
  },
  next_run_at: null,
  created_at: '2026-11-22T21:38:42Z',
  edited_at: '2026-11-22T21:38:42Z',
};

describe('a schedule that is edited', () => {
  it('goes back as it came, also what the form does not show', () => {
    const body = bodyOf(draftOf(schedule), schedule);
    const { id, next_run_at, created_at, edited_at, ...sent } = schedule;
    expect(body).toEqual({
      ...sent,
      survey: { ...schedule.survey, reference: { policy: 'previous' } },
    });
  });

  it('says what is missing at its field', () => {
    expect(faultsOf(newDraft)).toEqual({});
    const wrong = {
      ...newDraft,
      name: ' ',
      cron: '',
      window_h: '0',
      policy: 'fixed' as const,
      thresholds: [newThreshold, { ...newThreshold, yellow: '500', red: '200' }],
    };
    expect(Object.keys(faultsOf(wrong))).toEqual([
      'name',
      'cron',
      'window_s',
      'survey.reference.epoch',
      'survey.thresholds.0',
      'survey.thresholds.1',
    ]);
  });

  it('shows what somebody else has changed meanwhile', () => {
    const mine = { ...draftOf(schedule), cron: '0 6 * * *' };
    const differing = differencesOf(draftOf(schedule), mine).filter(({ mine, theirs }) => mine !== theirs);
    expect(differing).toEqual([{ name: 'Runs', theirs: 'every day at 13:00', mine: 'every day at 06:00' }]);
  });
});
