// What the views of surveys ask for.

import { loader, useResource, useResources } from '../../app/app';
import { address, type Schema } from '../../lib/api';
import { type Figure, type Level } from './words';

export type Schedule = Schema<'SurveySchedule'>;
export type Run = Schema<'SurveyRun'>;
export type ZoneFigures = Schema<'ZoneFigures'>;
export type Zone = Schema<'Zone'>;
type Thresholds = Schema<'Thresholds'>;

export const surveyAt = (id: number) => address('/api/v1/surveys/{id}', { path: { id } });
export const volumesAt = (id: number) => address('/api/v1/surveys/{id}/volumes', { path: { id } });

/** What came of it, else what is known of it. */
export const linkToRun = ({ id, survey }: Run): string =>
  survey === null ? `/surveys/runs/${id}` : `/surveys/${survey}`;

export const isUnfinished = ({ state }: Run): boolean => state === 'queued' || state === 'running';
/** The end of a run is told by an event; that it began is asked for this often. */
export const kAskRunsMs = 1500;

export const surveysAreOld = (): void => loader.invalidate((key) => /^\/api\/v1\/(surveys|schedules|epochs)/.test(key));

export const useSchedules = (site: string | undefined) =>
  useResource(site === undefined ? undefined : address('/api/v1/schedules', { query: { site, limit: 200 } }));

/** The zones of a site in which volumes are measured. */
export const useVolumeZones = (site: string | undefined): readonly Zone[] =>
  useResource(
    site === undefined ? undefined : address('/api/v1/zones', { query: { site, limit: 1000 } }),
  ).data?.items.filter(({ kind }) => kind === 'volume') ?? [];

export const seriesAt = (schedule: number, figure: Figure, zone: number | null, window_h?: number) =>
  address('/api/v1/surveys/series', { query: { schedule, figure, zone: zone ?? undefined, window_h } });

/** A figure that has levels, and what it came to. */
export interface Judged {
  readonly thresholds: Thresholds;
  readonly value: number;
  readonly level: Level;
}

export interface HasLevels {
  /** Null: by hand, where nothing has levels. */
  readonly schedule: number | null;
  readonly thresholds: readonly Thresholds[];
}

export const levelsOf = ({ id, survey }: Schedule): HasLevels => ({ schedule: id, thresholds: survey.thresholds });

/** What the levels of figures were in each of the schedules' surveys. */
export function useLevels(of: readonly HasLevels[]): (survey: number) => Judged[] {
  const judged = of.flatMap(({ schedule, thresholds }) =>
    schedule === null ? [] : thresholds.map((each) => ({ schedule, thresholds: each })),
  );
  const series = useResources(
    judged.map(({ schedule, thresholds: { figure, zone } }) => seriesAt(schedule, figure, zone)),
  );
  return (survey) =>
    judged.flatMap(({ thresholds }, index) => {
      const found = series[index]?.data?.values.find((value) => value.survey === survey);
      return found?.level ? [{ thresholds, value: found.value, level: found.level }] : [];
    });
}
