// The frame of a form that makes or edits something: its fields, tied to a draft, and what is wrong, said at each field.

import { type ComponentChildren } from 'preact';
import { useEffect, useRef, useState } from 'preact/hooks';
import { type Problem } from '../lib/problem';
import { useSaving } from './use_saving';

/** What is said about a field, by the daemon's name of it. */
export type Errors = (field: string) => string | undefined;

/** What each part of a form is given. */
export interface PartProps<Draft> {
  readonly draft: Draft;
  readonly error: Errors;
  readonly set: (change: Partial<Draft>) => void;
  /** What ties a field to a part of the draft, where the daemon calls it otherwise by that name: `<TextField {...field('cron')} />`. */
  readonly field: <Key extends keyof Draft & string>(
    key: Key,
    name?: string,
  ) => { value: Draft[Key]; error: string | undefined; onValue: (value: Draft[Key]) => void };
}

export const partOf = <Draft extends object>(
  draft: Draft,
  error: Errors,
  set: (change: Partial<Draft>) => void,
): PartProps<Draft> => ({
  draft,
  error,
  set,
  field: (key, name = key) => ({
    value: draft[key],
    error: error(name),
    onValue: (value) => set({ [key]: value } as unknown as Partial<Draft>),
  }),
});

/** A part of a form about one member of its draft. */
export const partWithin = <Outer extends object, Key extends keyof Outer & string>(
  { draft, error, set }: PartProps<Outer>,
  key: Key,
): PartProps<Outer[Key] & object> =>
  partOf(draft[key] as Outer[Key] & object, error, (change) =>
    set({ [key]: { ...draft[key], ...change } } as unknown as Partial<Outer>),
  );

/** What is filled in, and what becomes of saving it; `form` is what `EditForm` is given of that. */
export function useEditing<Draft extends object>(initial: Draft | (() => Draft)) {
  const [draft, onDraft] = useState(initial);
  const { saving, problem, run } = useSaving();
  return { draft, problem, run, form: { draft, onDraft, problem, saving } };
}

export interface EditFormProps<Draft> {
  draft: Draft;
  onDraft: (draft: Draft) => void;
  problem: Problem | undefined;
  saving: boolean;
  onSave: () => void;
  /** Above the fields. */
  notice?: ComponentChildren;
  /** Beside the button that saves. */
  actions?: ComponentChildren;
}

export function EditForm<Draft extends object>({
  draft,
  onDraft,
  problem,
  saving,
  onSave,
  notice,
  actions,
  faults = {},
  class: looks = 'panel panel-body',
  words = 'Save',
  children,
}: EditFormProps<Draft> & {
  /** What is wrong before anything is sent, by the daemon's names of fields. */
  faults?: Readonly<Record<string, string>>;
  class?: string;
  /** Of the button that saves. */
  words?: string;
  children: (part: PartProps<Draft>) => ComponentChildren;
}) {
  const [tries, setTries] = useState(0);
  const form = useRef<HTMLFormElement>(null);
  useEffect(() => form.current?.querySelector<HTMLElement>('[aria-invalid="true"]')?.focus(), [tries, problem]);
  // The fields that say themselves what is wrong with them: those that asked. They are drawn before what says the rest.
  const asked = new Set<string>();
  const error: Errors = (field) => {
    asked.add(field);
    return (tries > 0 ? faults[field] : undefined) ?? problem?.about(field);
  };
  return (
    <form
      ref={form}
      class={looks}
      noValidate
      onSubmit={(event) => {
        event.preventDefault();
        setTries(tries + 1);
        if (Object.keys(faults).length === 0) onSave();
      }}
    >
      {notice}
      {children(partOf(draft, error, (change) => onDraft({ ...draft, ...change })))}
      <FormProblem problem={problem} isShown={(field) => asked.has(field)} />
      <div class="actions">
        <button type="submit" class="primary" disabled={saving}>
          {words}
        </button>
        {actions}
      </div>
    </form>
  );
}

/** What the daemon said about a form, as far as no field of the form says it. */
export function FormProblem({
  problem,
  isShown = () => false,
}: {
  problem: Problem | undefined;
  isShown?: (field: string) => boolean;
}) {
  if (!problem) return null;
  const rest = problem.fields.filter(({ field }) => !isShown(field));
  if (problem.fields.length > 0 && rest.length === 0) return null;
  return (
    <p class="field-bad" role="alert">
      {problem.fields.length === 0
        ? `${problem.title}. ${problem.message}`
        : rest.map(({ field, message }) => `${field} ${message}`).join('; ')}
    </p>
  );
}
