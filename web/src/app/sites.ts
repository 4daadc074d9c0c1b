// The sites, which nearly every view needs for their time zones.

import { address, type Schema } from '../lib/api';
import { useResource, useSelect } from './app';

export const kSites = address('/api/v1/sites', { query: { limit: 1000 } });

export const siteAt = (name: string) => address('/api/v1/sites/{name}', { path: { name } });

export function useSites(): readonly Schema<'Site'>[] {
  return useResource(kSites).data?.items ?? [];
}

/** The site of the link; else the first with a profile, else the first. */
export function useChosenSite(profile?: Schema<'Profile'>): string | undefined {
  const asked = useSelect((state) => state.location.query['site']);
  const sites = useSites();
  return asked ?? (sites.find((site) => site.profile === profile) ?? sites[0])?.name;
}

/** The zone in which a site's times are shown: its own; UTC until it is known. */
export function useZone(site: string | undefined): string {
  return useSites().find((candidate) => candidate.name === site)?.time_zone ?? 'UTC';
}
