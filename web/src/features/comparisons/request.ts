// The form of a comparison by hand: what stands in it, and what is sent.

import { type Schema } from '../../lib/api';
import { localOf, momentOf } from '../../lib/zone';
import { type Grouping, type Parameters, parametersFrom, scansIn, type Texts, textsFor } from './parameters';

export type ReferenceKind = 'previous' | 'baseline' | 'window' | 'scans';

export interface Draft {
  readonly scan: string;
  readonly kind: ReferenceKind;
  /** On the clock of the site, as <input type="datetime-local"> has it. */
  readonly from: string;
  readonly to: string;
  readonly scans: string;
  readonly grouping: Grouping;
  readonly texts: Texts;
}

const kKinds: readonly ReferenceKind[] = ['previous', 'baseline', 'window', 'scans'];

/** What the link of the form gives. */
export function draftOf(query: Readonly<Record<string, string | undefined>>): Draft {
  return {
    scan: query['scan'] ?? '',
    kind: kKinds.find((kind) => kind === query['reference']) ?? 'previous',
    from: query['from'] ?? '',
    to: query['to'] ?? '',
    scans: query['scans'] ?? '',
    grouping: query['grouping'] === 'union' ? 'union' : 'consensus',
    texts: {},
  };
}

/** The same comparison once more. */
export function draftLike(comparison: Schema<'Comparison'>, defaults: Parameters, zone: string): Draft {
  const { scan, reference, parameters } = comparison;
  const local = (time: string): string => localOf(new Date(time), zone);
  const base: Draft = {
    scan: String(scan),
    kind: 'previous',
    from: '',
    to: '',
    scans: '',
    grouping: parameters.grouping ?? 'consensus',
    texts: textsFor(parameters, defaults),
  };
  if (typeof reference === 'string') return { ...base, kind: reference };
  if ('scans' in reference) return { ...base, kind: 'scans', scans: reference.scans.join(', ') };
  return { ...base, kind: 'window', from: local(reference.from), to: local(reference.to) };
}

/** By the daemon's names of the fields: "scan", "reference.scans", "parameters.angle_deg". */
export type FieldErrors = ReadonlyMap<string, string>;

/** @returns what is sent, or what is wrong before anything is sent. */
export function requestFrom(draft: Draft, zone: string): { request: Schema<'NewComparison'>; errors: FieldErrors } {
  const errors = new Map<string, string>();
  const [scan] = scansIn(draft.scan) ?? [];
  if (scan === undefined || scansIn(draft.scan)?.length !== 1) errors.set('scan', 'must be the number of a scan');
  const { parameters, errors: wrong } = parametersFrom(draft.grouping, draft.texts);
  for (const [key, message] of wrong) errors.set(`parameters.${key}`, message);
  const reference = referenceFrom(draft, zone, errors);
  return { request: { scan: scan ?? 0, reference, parameters }, errors };
}

function referenceFrom(draft: Draft, zone: string, errors: Map<string, string>): Schema<'Reference'> {
  if (draft.kind === 'previous' || draft.kind === 'baseline') return draft.kind;
  if (draft.kind === 'scans') {
    const scans = scansIn(draft.scans) ?? [];
    if (scans.length === 0) errors.set('reference.scans', 'must be numbers of scans, such as 3, 5');
    return { scans };
  }
  const moment = (name: 'from' | 'to'): string => {
    if (draft[name] !== '') return momentOf(draft[name], zone).toISOString();
    errors.set(`reference.${name}`, 'is required');
    return '';
  };
  return { from: moment('from'), to: moment('to') };
}
