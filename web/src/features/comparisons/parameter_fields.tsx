// The parameters: what the profile has stands in each empty field, with its unit.

import { useResource } from '../../app/app';
import { address } from '../../lib/api';
import { FieldError, type PartProps } from './compare_form';
import { type Field, type Grouping, kFieldGroups, kFields, type Parameters, shownValue } from './parameters';
import { valueOf } from './parameters_of';

const kGroupings: readonly { grouping: Grouping; words: string }[] = [
  { grouping: 'consensus', words: 'Consensus – what a prior supports speaks against a change; poses are refined' },
  { grouping: 'union', words: 'Union – changed if free in any prior, as published; nothing is weighed' },
];

export function ParameterFields(props: PartProps & { site: string | undefined }) {
  const { draft, onChange, site } = props;
  const defaults = useResource(
    site === undefined
      ? undefined
      : address('/api/v1/sites/{name}/parameters', { path: { name: site }, query: { grouping: draft.grouping } }),
  ).data;
  const own = kFields.filter(({ key }) => (draft.texts[key] ?? '') !== '').length;
  return (
    <div class="panel-body compare-part">
      <div class="grouping">
        <label class="field">
          Grouping
          <select
            value={draft.grouping}
            onChange={(event) => onChange({ grouping: event.currentTarget.value as Grouping })}
          >
            {kGroupings.map(({ grouping, words }) => (
              <option key={grouping} value={grouping}>
                {words}
              </option>
            ))}
          </select>
        </label>
        <button type="button" disabled={own === 0} onClick={() => onChange({ texts: {} })}>
          All as the profile has it
        </button>
      </div>
      {kFieldGroups.map(({ title, fields }) => (
        <fieldset key={title} class="parameter-group">
          <legend>{title}</legend>
          {fields
            .filter(({ onlyConsensus }) => !onlyConsensus || draft.grouping === 'consensus')
            .map((field) => (
              <OneParameter key={field.key} {...props} field={field} defaults={defaults} />
            ))}
        </fieldset>
      ))}
    </div>
  );
}

function OneParameter({
  draft,
  errors,
  onChange,
  field,
  defaults,
}: PartProps & { field: Field; defaults: Parameters | undefined }) {
  const { key, words, unit, help, kind } = field;
  const error = errors.get(`parameters.${key}`);
  const value = draft.texts[key] ?? '';
  const set = (text: string): void => onChange({ texts: { ...draft.texts, [key]: text } });
  const usual = defaults ? shownValue(defaults, key) : '';
  return (
    <label class={value === '' ? 'field' : 'field own-parameter'}>
      <span>
        {words}
        {unit !== '' && ` (${unit})`}
      </span>
      {kind === 'flag' ? (
        <select value={value} aria-invalid={error !== undefined} onChange={(event) => set(event.currentTarget.value)}>
          <option value="">{usual === '' ? 'as the profile' : `${usual}, as the profile`}</option>
          <option value="yes">yes</option>
          <option value="no">no</option>
        </select>
      ) : (
        <input
          inputMode="decimal"
          value={value}
          placeholder={usual}
          aria-invalid={error !== undefined}
          onInput={(event) => set(event.currentTarget.value)}
        />
      )}
      <FieldError message={error} />
      <small>
        {help}
        {value !== '' && defaults && ` Else ${valueOf(defaults, field)}.`}
      </small>
    </label>
  );
}
