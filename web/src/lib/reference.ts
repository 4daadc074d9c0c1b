import { type Schema } from './api';
import { counted, dateTime } from './format';

/** What a comparison is made with, after "with": "what is normal", "2 named scans". */
export function referenceInWords(reference: Schema<'Reference'>, zone: string): string {
  if (reference === 'previous') return 'what was before';
  if (reference === 'baseline') return 'what is normal';
  if ('scans' in reference)
    return reference.scans.length <= 3
      ? `scan ${reference.scans.join(', ')}`
      : counted(reference.scans.length, 'named scan');
  return `scans from ${dateTime(reference.from, zone)} to ${dateTime(reference.to, zone)}`;
}
