// The sites, which nearly every view needs for their time zones.

import { address, type Schema } from '../lib/api';
import { useResource } from './app';

export const kSites = address('/api/v1/sites', { query: { limit: 1000 } });

export function useSites(): readonly Schema<'Site'>[] {
  return useResource(kSites).data?.items ?? [];
}

/** The zone in which a site's times are shown: its own; UTC until it is known. */
export function useZone(site: string | undefined): string {
  return useSites().find((candidate) => candidate.name === site)?.time_zone ?? 'UTC';
}
