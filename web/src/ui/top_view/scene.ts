// What a site looks like from above: points of the latest scan of each place that scans are taken from, and the sensors.

import { useEffect, useMemo, useState } from 'preact/hooks';
import { useResource } from '../../app/app';
import { useSites } from '../../app/sites';
import { address, type Schema } from '../../lib/api';
import { Problem } from '../../lib/problem';
import { type Cloud, extentOf, HeightMap, heightsOf } from './clouds';
import { type Bounds, widened } from './frame';
import { loadCloud } from './load_cloud';

export interface ShownSensor {
  readonly name: string;
  readonly at_m: readonly [number, number, number];
}

export interface Scene {
  readonly site: string;
  readonly clouds: readonly Cloud[];
  readonly sensors: readonly ShownSensor[];
  /** Undefined as long as there are no points. */
  readonly extent_m: Bounds | undefined;
  readonly heights_m: readonly [number, number];
  readonly ground: HeightMap | undefined;
  readonly state: 'loading' | 'empty' | 'ready' | 'failed';
  readonly problem: Problem | undefined;
}

/** So far around the extent the heights are known, too. */
const kBeyond_m = 30;
/** So many scans are shown together at most. */
const kMostClouds = 4;
/** How far points lie apart at least; enough to tell what is where. */
const kSpacing_m: Readonly<Record<Schema<'Profile'>, number>> = { indoor: 0.05, outdoor: 0.1, survey: 0.5 };

/** The latest scan of each vantage among the given, which are the latest first. */
export function latestOfVantages(scans: readonly Schema<'Scan'>[]): Schema<'Scan'>[] {
  const byVantage = new Map<number, Schema<'Scan'>>();
  for (const scan of scans) if (!byVantage.has(scan.vantage)) byVantage.set(scan.vantage, scan);
  return [...byVantage.values()].slice(0, kMostClouds);
}

/** The site as of when the view was opened: a new scan every second must not redraw what somebody draws on. */
export function useScene(site: string | undefined): Scene {
  const profile = useSites().find(({ name }) => name === site)?.profile;
  const page = useResource(site === undefined ? undefined : address('/api/v1/scans', { query: { site, limit: 50 } }));
  const scans = useHeld(site, page.data?.items);
  const { clouds, problem } = useClouds(scans, profile);
  const sensors = useMemo(() => sensorsOf(scans ?? []), [scans]);
  return useMemo(() => {
    const extent_m = clouds && extentOf(clouds);
    const failure = page.problem ?? problem;
    const waiting = scans === undefined || clouds === undefined;
    return {
      site: site ?? '',
      clouds: clouds ?? [],
      sensors,
      extent_m,
      heights_m: clouds && extent_m ? heightsOf(clouds) : [0, 1],
      ground: clouds && extent_m ? new HeightMap(clouds, widened(extent_m, kBeyond_m)) : undefined,
      state: failure ? 'failed' : waiting ? 'loading' : extent_m ? 'ready' : 'empty',
      problem: failure,
    };
  }, [site, scans, clouds, sensors, page.problem, problem]);
}

/** The first answer for a site, kept as long as the site stays. */
function useHeld<T>(site: string | undefined, value: T | undefined): T | undefined {
  const [held, setHeld] = useState<{ site: string | undefined; value: T } | undefined>();
  const known = held && held.site === site ? held.value : undefined;
  useEffect(() => {
    if (known === undefined && value !== undefined) setHeld({ site, value });
  }, [site, known, value]);
  return known ?? value;
}

function useClouds(scans: readonly Schema<'Scan'>[] | undefined, profile: Schema<'Profile'> | undefined) {
  const [loaded, setLoaded] = useState<{ of: unknown; clouds?: Cloud[]; problem?: Problem } | undefined>();
  useEffect(() => {
    if (!scans || !profile) return;
    let wanted = true;
    Promise.all(latestOfVantages(scans).map(({ id }) => loadCloud(id, kSpacing_m[profile]))).then(
      (clouds) => wanted && setLoaded({ of: scans, clouds }),
      (failure: unknown) => {
        if (!(failure instanceof Problem)) throw failure;
        if (wanted) setLoaded({ of: scans, problem: failure });
      },
    );
    return () => void (wanted = false);
  }, [scans, profile]);
  const current = loaded?.of === scans ? loaded : undefined;
  return { clouds: current?.clouds, problem: current?.problem };
}

function sensorsOf(scans: readonly Schema<'Scan'>[]): ShownSensor[] {
  const byName = new Map<string, ShownSensor>();
  for (const { sensor, pose } of scans) {
    const [x = 0, y = 0, z = 0] = pose.position_m;
    if (!byName.has(sensor)) byName.set(sensor, { name: sensor, at_m: [x, y, z] });
  }
  return [...byName.values()];
}
