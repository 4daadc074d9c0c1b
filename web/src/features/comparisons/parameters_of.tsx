import { useResource } from '../../app/app';
import { address, type Schema } from '../../lib/api';
import { type Field, kFieldGroups, shownValue } from './parameters';

type Comparison = Schema<'Comparison'>;

/** What a comparison was made with; what differs from the profile of its site stands out. */
export function ParametersOf({ comparison }: { comparison: Comparison }) {
  const { parameters, site } = comparison;
  const defaults = useResource(
    address('/api/v1/sites/{name}/parameters', { path: { name: site }, query: { grouping: parameters.grouping } }),
  ).data;
  const isOwn = ({ key }: Field): boolean => defaults !== undefined && parameters[key] !== defaults[key];
  return (
    <section class="panel" aria-labelledby="parameters">
      <header class="panel-head">
        <h2 id="parameters">Parameters</h2>
        <span class="muted">{parameters.grouping}</span>
      </header>
      {kFieldGroups.map(({ title, fields }) => (
        <div key={title} class="panel-body parameters">
          <h3>{title}</h3>
          <dl class="figures">
            {fields
              .filter(({ onlyConsensus }) => !onlyConsensus || parameters.grouping === 'consensus')
              .map((field) => (
                <div key={field.key} class={isOwn(field) ? 'own-parameter' : ''}>
                  <dt title={field.help}>{field.words}</dt>
                  <dd>
                    {valueOf(parameters, field)}
                    {isOwn(field) && <span class="muted"> (else {defaults && valueOf(defaults, field)})</span>}
                  </dd>
                </div>
              ))}
          </dl>
        </div>
      ))}
    </section>
  );
}

export function valueOf(parameters: Comparison['parameters'], { key, kind, unit }: Field): string {
  const shown = shownValue(parameters, key);
  const hasUnit = kind === 'number' && /^\d/.test(shown);
  return hasUnit ? `${shown}${unit === '°' ? '' : '\u00a0'}${unit}` : shown;
}
