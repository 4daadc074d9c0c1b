// What the disk is full of, by class.

import type { Schema } from '../../lib/api';

export interface Share {
  readonly name: string;
  readonly bytes: number;
  /** The class of its colour in storage.css. */
  readonly look: 'points' | 'metadata' | 'copies' | 'spool' | 'others' | 'free';
}

/** All of the disk; what is not of the store is `others`. Points of each site come first. */
export function sharesOf(storage: Schema<'Storage'>): Share[] {
  const { disk, sites } = storage;
  const own: Share[] = [
    ...sites.map(({ site, payload_bytes }): Share => ({
      name: `points of ${site}`,
      bytes: payload_bytes,
      look: 'points',
    })),
    { name: 'all but the points', bytes: storage.metadata_bytes, look: 'metadata' },
    { name: 'copies made before upgrades', bytes: storage.metadata_copies_bytes, look: 'copies' },
    { name: 'uploads that are under way', bytes: storage.spool_bytes, look: 'spool' },
  ];
  const kept = own.reduce((sum, { bytes }) => sum + bytes, 0);
  return [
    ...own,
    { name: 'others on this disk', bytes: Math.max(0, disk.bytes - disk.free_bytes - kept), look: 'others' },
    { name: 'free', bytes: disk.free_bytes, look: 'free' },
  ];
}
