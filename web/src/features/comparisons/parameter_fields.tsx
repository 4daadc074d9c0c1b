// The parameters: what the profile has stands in each empty field, with its unit.

import { useResource } from '../../app/app';
import { address } from '../../lib/api';
import { SelectField, TextField } from '../../ui/form';
import { type ComparePart } from './compare_form';
import { type Field, type Grouping, kFieldGroups, kFields, type Parameters, shownValue } from './parameters';
import { valueOf } from './parameters_of';

const kGroupings: readonly { value: Grouping; words: string }[] = [
  { value: 'consensus', words: 'Consensus – what a prior supports speaks against a change; poses are refined' },
  { value: 'union', words: 'Union – changed if free in any prior, as published; nothing is weighed' },
];

export function ParameterFields(props: ComparePart & { site: string | undefined }) {
  const { draft, set, field, site } = props;
  const defaults = useResource(
    site === undefined
      ? undefined
      : address('/api/v1/sites/{name}/parameters', { path: { name: site }, query: { grouping: draft.grouping } }),
  ).data;
  const own = kFields.filter(({ key }) => (draft.texts[key] ?? '') !== '').length;
  return (
    <div class="panel-body compare-part">
      <div class="grouping">
        <SelectField label="Grouping" options={kGroupings} {...field('grouping', 'parameters.grouping')} />
        <button type="button" disabled={own === 0} onClick={() => set({ texts: {} })}>
          All as the profile has it
        </button>
      </div>
      {kFieldGroups.map(({ title, fields }) => (
        <fieldset key={title} class="parameter-group">
          <legend>{title}</legend>
          {fields
            .filter(({ onlyConsensus }) => !onlyConsensus || draft.grouping === 'consensus')
            .map((about) => (
              <OneParameter key={about.key} {...props} about={about} defaults={defaults} />
            ))}
        </fieldset>
      ))}
    </div>
  );
}

function OneParameter({
  draft,
  error,
  set,
  about,
  defaults,
}: ComparePart & { about: Field; defaults: Parameters | undefined }) {
  const { key, words, unit, help, kind } = about;
  const value = draft.texts[key] ?? '';
  const usual = defaults ? shownValue(defaults, key) : '';
  const tied = {
    label: unit === '' ? words : `${words} (${unit})`,
    hint: value !== '' && defaults ? `${help} Else ${valueOf(defaults, about)}.` : help,
    class: value === '' ? '' : 'own-parameter',
    value,
    error: error(`parameters.${key}`),
    onValue: (text: string) => set({ texts: { ...draft.texts, [key]: text } }),
  };
  return kind === 'flag' ? (
    <SelectField
      {...tied}
      options={[
        { value: '', words: usual === '' ? 'as the profile' : `${usual}, as the profile` },
        { value: 'yes', words: 'yes' },
        { value: 'no', words: 'no' },
      ]}
    />
  ) : (
    <TextField {...tied} inputMode="decimal" placeholder={usual} />
  );
}
