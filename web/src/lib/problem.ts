// What went wrong with a request: the daemon's own words (RFC 9457), or that it could not be reached.

/** As `errors[]` of the daemon's problems: which field of what was sent, and what would be right. */
export interface FieldMessage {
  readonly field: string;
  readonly message: string;
}

export class Problem extends Error {
  /** The last word of the problem's type, such as `invalid-input`; `unreachable` when there was no answer. */
  readonly kind: string;
  readonly status: number;
  readonly title: string;
  readonly fields: readonly FieldMessage[];

  constructor(given: {
    kind: string;
    status: number;
    title: string;
    detail: string;
    fields?: readonly FieldMessage[];
  }) {
    super(given.detail);
    this.name = 'Problem';
    this.kind = given.kind;
    this.status = given.status;
    this.title = given.title;
    this.fields = given.fields ?? [];
  }

  /** What is said about one field of a form. */
  about(field: string): string | undefined {
    return this.fields.find((entry) => entry.field === field)?.message;
  }
}

export function unreachable(): Problem {
  return new Problem({
    kind: 'unreachable',
    status: 0,
    title: 'The daemon does not answer',
    detail: 'The connection failed. What is shown may be out of date; it is tried again by itself.',
  });
}

interface ProblemJson {
  type?: unknown;
  title?: unknown;
  detail?: unknown;
  errors?: unknown;
}

function isFieldMessage(value: unknown): value is FieldMessage {
  const entry = value as Partial<FieldMessage> | null;
  return typeof entry?.field === 'string' && typeof entry.message === 'string';
}

/** The problem that an answer tells; also when it comes from something in between and is no problem document. */
export function problemOf(status: number, body: string): Problem {
  let json: ProblemJson = {};
  try {
    json = JSON.parse(body) as ProblemJson;
  } catch {
    // Not the daemon's own words.
  }
  return new Problem({
    kind: typeof json.type === 'string' ? (json.type.split(':').pop() ?? 'unknown') : 'unknown',
    status,
    title: typeof json.title === 'string' ? json.title : `The request failed (HTTP ${status})`,
    detail: typeof json.detail === 'string' ? json.detail : 'The answer says no more.',
    fields: Array.isArray(json.errors) ? json.errors.filter(isFieldMessage) : [],
  });
}
