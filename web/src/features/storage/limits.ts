// The limits of retention as they are filled in: days, and gigabytes.

import type { Schema } from '../../lib/api';

type Limits = Schema<'RetentionLimits'>;

export interface LimitsDraft {
  readonly max_age_days: string;
  readonly max_gb: string;
  readonly min_free_gb: string;
}

const kGigabyte = 1e9;

const inGigabytes = (bytes: number | null | undefined): string =>
  bytes === null || bytes === undefined ? '' : String(bytes / kGigabyte);

export const draftOf = ({ max_age_days, max_bytes, min_free_bytes }: Limits): LimitsDraft => ({
  max_age_days: max_age_days === null || max_age_days === undefined ? '' : String(max_age_days),
  max_gb: inGigabytes(max_bytes),
  min_free_gb: inGigabytes(min_free_bytes),
});

/** An empty field is left to what is configured for all sites. */
export const limitsOf = ({ max_age_days, max_gb, min_free_gb }: LimitsDraft): Required<Limits> => ({
  max_age_days: max_age_days === '' ? null : Number(max_age_days),
  max_bytes: max_gb === '' ? null : Math.round(Number(max_gb) * kGigabyte),
  min_free_bytes: min_free_gb === '' ? null : Math.round(Number(min_free_gb) * kGigabyte),
});
