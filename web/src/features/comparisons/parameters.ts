// The parameters of a comparison as a form has them: what is left empty stays as the site's profile has it.

import { type Schema } from '../../lib/api';

export type Parameters = Schema<'Parameters'>;
export type Grouping = NonNullable<Parameters['grouping']>;
export type Key = Exclude<keyof Parameters, 'grouping'>;

export interface Field {
  readonly key: Key;
  readonly words: string;
  readonly unit: string;
  readonly help: string;
  readonly kind: 'number' | 'flag';
  /** `union` takes no notice of it, or refuses it. */
  readonly onlyConsensus?: boolean;
}

export interface FieldGroup {
  readonly title: string;
  readonly fields: readonly Field[];
}

const number = (key: Key, words: string, unit: string, help: string, more: Partial<Field> = {}): Field => ({
  key,
  words,
  unit,
  help,
  kind: 'number',
  ...more,
});

const kConsensus = { onlyConsensus: true };

export const kFieldGroups: readonly FieldGroup[] = [
  {
    title: 'What counts as changed',
    fields: [
      number('angle_deg', 'Angle', '°', 'Half-angle of the cone of earlier returns that are asked about a point.'),
      number('range_m', 'Range', 'm', 'How far returns may differ in range and still support each other.'),
      number(
        'support_distance_m',
        'Roughness',
        'm',
        'Points nearer to a known surface than this belong to it.',
        kConsensus,
      ),
    ],
  },
  {
    title: 'How points become changes',
    fields: [
      { key: 'clustering', words: 'Clusters', unit: '', help: 'Without, every changed point counts.', kind: 'flag' },
      number('cluster_distance_m', 'Distance', 'm', 'Points nearer than this belong together.'),
      number('cluster_min_points', 'Noise up to', 'points', 'Clusters of at most this many points are noise.'),
      number(
        'growth_distance_m',
        'Growth',
        'm',
        'How far a change grows over what no earlier scan supports.',
        kConsensus,
      ),
      number(
        'foliage_distance_m',
        'Foliage',
        'm',
        'How far around a change nothing must sway. 0: not asked.',
        kConsensus,
      ),
    ],
  },
  {
    title: 'What is left out, and poses',
    fields: [
      number('min_range_m', 'Nearest', 'm', 'Nearer returns are left out.'),
      number('max_range_m', 'Farthest', 'm', 'Farther returns are left out.'),
      number('contemporary_s', 'Same time', 's', 'Scans no farther apart in time show the same state of the world.'),
      {
        key: 'align',
        words: 'Refine poses',
        unit: '',
        help: 'Before anything is compared.',
        kind: 'flag',
        ...kConsensus,
      },
    ],
  },
];

export const kFields: readonly Field[] = kFieldGroups.flatMap(({ fields }) => fields);

/** What is typed, by parameter; an empty text leaves it to the profile. */
export type Texts = Readonly<Partial<Record<Key, string>>>;

/** What the daemon takes for "as far as it reaches". */
const kNoLimit_m = 1e9;

/** As people read it: "0.15", "automatic", "yes", "no limit". */
export function shownValue(parameters: Parameters, key: Key): string {
  return key === 'max_range_m' && parameters[key] === kNoLimit_m ? 'no limit' : written(parameters[key]);
}

/** "0.15", "automatic", "yes". */
function written(value: Parameters[Key]): string {
  if (value === undefined || value === null) return 'automatic';
  return typeof value === 'boolean' ? (value ? 'yes' : 'no') : String(value);
}

/** The parameters that are to be sent, and what is wrong with the others. */
export function parametersFrom(
  grouping: Grouping,
  texts: Texts,
): { parameters: Parameters; errors: ReadonlyMap<Key, string> } {
  const errors = new Map<Key, string>();
  const given: Partial<Record<Key, number | boolean>> = {};
  for (const { key, kind, onlyConsensus } of kFields) {
    const text = texts[key]?.trim() ?? '';
    if (text === '' || (onlyConsensus && grouping === 'union')) continue;
    if (kind === 'flag') given[key] = text === 'yes';
    else if (Number.isFinite(Number(text))) given[key] = Number(text);
    else errors.set(key, 'must be a number such as 0.25');
  }
  return { parameters: { grouping, ...(given as Parameters) }, errors };
}

/** What must be typed to get these parameters where those are the defaults. */
export function textsFor(parameters: Parameters, defaults: Parameters): Texts {
  return Object.fromEntries(
    kFields
      .filter(({ key }) => parameters[key] !== undefined && parameters[key] !== defaults[key])
      .map(({ key }) => [key, parameters[key] === null ? '' : written(parameters[key])]),
  );
}

/** The numbers of scans in a text such as "3, 5 8"; undefined where something else stands in it. */
export function scansIn(text: string): number[] | undefined {
  const words = text.split(/[\s,;]+/).filter(Boolean);
  return words.every((word) => /^[1-9]\d{0,15}$/.test(word)) ? words.map(Number) : undefined;
}
