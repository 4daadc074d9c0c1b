// Parts of forms: a labelled field with its unit, and what is wrong with it beneath it.

import { type ComponentChildren } from 'preact';
import { useId } from 'preact/hooks';

export interface FieldProps {
  label: string;
  /** What the field is about, in a sentence. */
  hint?: string | undefined;
  /** What is wrong with it. */
  error?: string | undefined;
  /** Something is, which is said elsewhere. */
  wrong?: boolean | undefined;
  class?: string | undefined;
}

/** What ties an input to its label and to its messages. */
export interface Ties {
  id: string;
  'aria-invalid': boolean;
  'aria-describedby': string;
}

/** A label over whatever is filled in, and what is said about it beneath. */
export function Field({
  label,
  hint,
  error,
  wrong,
  class: looks = '',
  children,
}: FieldProps & { children: (ties: Ties) => ComponentChildren }) {
  const id = useId();
  const about = `${id}-about`;
  return (
    <div class={`field ${looks}`}>
      <label for={id}>{label}</label>
      {children({ id, 'aria-invalid': wrong || error !== undefined, 'aria-describedby': about })}
      <span id={about} class={error === undefined ? 'field-hint' : 'field-bad'}>
        {error ?? hint}
      </span>
    </div>
  );
}

interface InputProps extends FieldProps {
  value: string;
  onValue: (value: string) => void;
  disabled?: boolean;
}

export function TextField({
  value,
  onValue,
  type = 'text',
  required,
  max,
  inputMode,
  onDone,
  placeholder,
  disabled,
  first,
  ...field
}: InputProps & {
  type?: 'text' | 'password' | 'url' | 'email' | 'time' | 'datetime-local';
  required?: boolean;
  /** The latest, of times. */
  max?: string;
  inputMode?: 'numeric' | 'decimal';
  /** It was typed to its end. */
  onDone?: () => void;
  placeholder?: string;
  /** Gets the focus when its dialog opens. */
  first?: boolean;
}) {
  return (
    <Field {...field}>
      {(ties) => (
        <input
          {...ties}
          type={type}
          required={required}
          max={max}
          inputMode={inputMode}
          onChange={onDone}
          placeholder={placeholder}
          disabled={disabled}
          data-first={first}
          autocomplete={type === 'password' ? 'new-password' : 'off'}
          value={value}
          onInput={(event) => onValue(event.currentTarget.value)}
        />
      )}
    </Field>
  );
}

/** Some lines of text. */
export const NoteField = ({ value, onValue, ...field }: FieldProps & Pick<InputProps, 'value' | 'onValue'>) => (
  <Field {...field}>
    {(ties) => (
      <textarea
        {...ties}
        rows={2}
        maxLength={2000}
        value={value}
        onInput={(event) => onValue(event.currentTarget.value)}
      />
    )}
  </Field>
);

/** A number as it is typed: a text, so that what is not finished stays as it is. */
export function NumberField({
  value,
  onValue,
  unit,
  min,
  max,
  step = 'any',
  placeholder,
  disabled,
  ...field
}: InputProps & { unit: string; min?: number; max?: number; step?: number | 'any'; placeholder?: string }) {
  return (
    <Field {...field}>
      {(ties) => (
        <span class="with-unit">
          <input
            {...ties}
            aria-describedby={`${ties.id}-unit ${ties['aria-describedby']}`}
            type="number"
            inputMode="decimal"
            min={min}
            max={max}
            step={step}
            placeholder={placeholder}
            disabled={disabled}
            value={value}
            onInput={(event) => onValue(event.currentTarget.value)}
          />
          {unit !== '' && <span id={`${ties.id}-unit`}>{unit}</span>}
        </span>
      )}
    </Field>
  );
}

export function SelectField<Value extends string>({
  value,
  onValue,
  options,
  disabled,
  first,
  ...field
}: FieldProps & {
  value: Value;
  onValue: (value: Value) => void;
  options: readonly { readonly value: Value; readonly words: string }[];
  disabled?: boolean;
  /** Gets the focus when its dialog opens. */
  first?: boolean;
}) {
  return (
    <Field {...field}>
      {(ties) => (
        <select
          {...ties}
          value={value}
          disabled={disabled}
          data-first={first}
          onChange={(event) => onValue(event.currentTarget.value as Value)}
        >
          {options.map((option) => (
            <option key={option.value} value={option.value}>
              {option.words}
            </option>
          ))}
        </select>
      )}
    </Field>
  );
}

export function CheckField({
  label,
  value,
  onValue,
  hint,
  error,
}: FieldProps & { value: boolean; onValue: (value: boolean) => void }) {
  return (
    <label class="check-field">
      <input type="checkbox" checked={value} onChange={(event) => onValue(event.currentTarget.checked)} />
      <span>
        {label}
        {hint && <span class="field-hint"> {hint}</span>}
        {error && <span class="field-bad"> {error}</span>}
      </span>
    </label>
  );
}

/** Three numbers that belong together, as they are typed. */
export function VectorField({
  label,
  error,
  axes,
  value,
  onValue,
}: FieldProps & {
  axes: readonly string[];
  value: readonly [string, string, string];
  onValue: (value: readonly [string, string, string]) => void;
}) {
  const about = useId();
  return (
    <div class="field" role="group" aria-label={label} aria-describedby={about}>
      <span>{label}</span>
      <div class="field-triple">
        {axes.map((axis, index) => (
          <NumberField
            key={axis}
            label={axis}
            unit="m"
            value={value[index] ?? ''}
            wrong={error !== undefined}
            onValue={(text) => {
              const [x, y, z] = value.map((each, at) => (at === index ? text : each));
              onValue([x ?? '', y ?? '', z ?? '']);
            }}
          />
        ))}
      </div>
      <span id={about} class="field-bad">
        {error}
      </span>
    </div>
  );
}

/** Some of several, each with its box. */
export function ChoicesField<Value extends string | number>({
  label,
  error,
  choices,
  value,
  onValue,
}: FieldProps & {
  choices: readonly { readonly value: Value; readonly words: string }[];
  value: readonly Value[];
  onValue: (value: Value[]) => void;
}) {
  return (
    <div class="field" role="group" aria-label={label}>
      <span>{label}</span>
      <div class="actions">
        {choices.map((choice) => (
          <CheckField
            key={choice.value}
            label={choice.words}
            value={value.includes(choice.value)}
            onValue={(chosen) =>
              onValue(chosen ? [...value, choice.value] : value.filter((each) => each !== choice.value))
            }
          />
        ))}
      </div>
      {error && <span class="field-bad">{error}</span>}
    </div>
  );
}

/** Fields that belong together, under a title. */
export function FormPart({ title, children }: { title: string; children: ComponentChildren }) {
  return (
    <fieldset class="form-part">
      <legend>{title}</legend>
      {children}
    </fieldset>
  );
}
