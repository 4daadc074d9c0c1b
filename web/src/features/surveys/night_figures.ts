// What stands in the list of nights, from lists: of surveys for the total, of the series of its figures for a zone.

import { useResources, useSelect } from '../../app/app';
import { type Address, address, type Schema } from '../../lib/api';
import { type Run } from './data';
import { type Figure } from './words';

type Survey = Schema<'Survey'>;
type SurveyPage = Schema<'SurveyPage'>;

interface Volume {
  readonly value_m3: number;
  readonly low_m3: number | null;
  readonly high_m3: number | null;
}

export interface NightFigures extends Readonly<Record<'net' | 'cut' | 'fill', Volume>> {
  readonly seen_share: number;
}

/** So many surveys are asked for at once. */
const kListed = 30;

/** The surveys of some runs, by their ids: as many pages of the list as it takes. */
export function useListedSurveys(
  runs: readonly Run[],
  of: { site: string } | { schedule: number },
): ReadonlyMap<number, Survey> {
  const known = useSelect((state) => state.resources);
  const oldest = Math.min(...runs.map(({ survey }) => survey ?? Infinity));
  const asked: Address<SurveyPage>[] = [];
  const found = new Map<number, Survey>();
  for (let cursor: string | null | undefined; oldest < Infinity && cursor !== null;) {
    const from = address('/api/v1/surveys', { query: { ...of, cursor, limit: kListed } });
    asked.push(from);
    const page = known[from]?.data as SurveyPage | undefined;
    for (const survey of page?.items ?? []) found.set(survey.id, survey);
    const last = page?.items.at(-1);
    cursor = last && last.id > oldest ? (page?.next ?? null) : null;
  }
  useResources(asked);
  return found;
}

const kFigures = ['net_m3', 'cut_m3', 'fill_m3', 'seen_share'] as const satisfies readonly Figure[];

/** The figures of a zone in each survey, by schedules; those by hand have none. Without a zone nothing is asked. */
export function useZoneFigures(
  runs: readonly Run[],
  site: string,
  zone: number | undefined,
): (survey: number) => NightFigures | undefined {
  const schedules = zone === undefined ? [] : [...new Set(runs.map(({ schedule }) => schedule))];
  const series = useResources(
    schedules.flatMap((schedule) =>
      kFigures.map((figure) =>
        address('/api/v1/surveys/series', {
          query: { ...(schedule === null ? { site } : { schedule }), figure, zone },
        }),
      ),
    ),
  );
  const valueOf = (figure: Figure, survey: number) =>
    series
      .filter(({ data }) => data?.figure === figure)
      .flatMap(({ data }) => data?.values ?? [])
      .find((value) => value.survey === survey);
  return (survey) => {
    const [net, cut, fill, seen] = kFigures.map((figure) => valueOf(figure, survey));
    const volume = ({ value, low, high }: NonNullable<typeof net>): Volume => ({
      value_m3: value,
      low_m3: low,
      high_m3: high,
    });
    if (!net || !cut || !fill || !seen) return undefined;
    return { net: volume(net), cut: volume(cut), fill: volume(fill), seen_share: seen.value };
  };
}
