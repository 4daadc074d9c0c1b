import { setQuery, useSelect } from '../../app/app';
import { useSites } from '../../app/sites';
import { type Schema } from '../../lib/api';
import { kSeverities } from './order';

type State = Schema<'AlertState'>;
const kStates: readonly State[] = ['open', 'acknowledged', 'snoozed', 'resolved'];

/** What the link says about which alerts are listed. Without a word they are the open ones. */
export interface Filter {
  readonly state: State | undefined;
  readonly site: string | undefined;
  readonly severity: Schema<'Severity'> | undefined;
  readonly cursor: string | undefined;
}

export function useFilter(): Filter {
  const query = useSelect((state) => state.location.query);
  const state = query['state'] ?? 'open';
  return {
    state: kStates.find((candidate) => candidate === state),
    site: query['site'],
    severity: kSeverities.find((severity) => severity === query['severity']),
    cursor: query['cursor'],
  };
}

export function Filters({ filter }: { filter: Filter }) {
  const sites = useSites();
  const set = (change: Record<string, string>): void =>
    setQuery({ cursor: undefined, ...Object.fromEntries(Object.entries(change).map(([k, v]) => [k, v || undefined])) });
  return (
    <div class="actions">
      <select
        aria-label="State"
        value={filter.state ?? 'all'}
        onChange={(event) => set({ state: event.currentTarget.value === 'open' ? '' : event.currentTarget.value })}
      >
        {kStates.map((state) => (
          <option key={state} value={state}>
            {state}
          </option>
        ))}
        <option value="all">all states</option>
      </select>
      <select
        aria-label="Severity"
        value={filter.severity ?? ''}
        onChange={(event) => set({ severity: event.currentTarget.value })}
      >
        <option value="">any severity</option>
        {kSeverities.map((severity) => (
          <option key={severity} value={severity}>
            {severity}
          </option>
        ))}
      </select>
      {sites.length > 1 && (
        <select
          aria-label="Site"
          value={filter.site ?? ''}
          onChange={(event) => set({ site: event.currentTarget.value })}
        >
          <option value="">all sites</option>
          {sites.map((site) => (
            <option key={site.name} value={site.name}>
              {site.name}
            </option>
          ))}
        </select>
      )}
    </div>
  );
}
