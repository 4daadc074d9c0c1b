import { setQuery, store, useSelect } from '../../app/app';
import { linkTo } from '../../app/router';
import { useSites } from '../../app/sites';
import { type Schema } from '../../lib/api';
import { counted } from '../../lib/format';
import { KeyHint } from '../../ui/key_hint';
import { AlertLine } from './alert_line';
import { currentOf } from './triage';
import { type Act } from './use_actions';

export interface AlertListProps {
  alerts: readonly Schema<'Alert'>[];
  /** The one that is open beside the list. */
  shown: number | undefined;
  /** The link's parameters, which an opened alert keeps. */
  query: Readonly<Record<string, string>>;
  next: string | null;
  act: Act;
}

export function AlertList({ alerts, shown, query, next, act }: AlertListProps) {
  const triage = useSelect((state) => state.triage);
  const manySites = useSites().length > 1;
  const ids = alerts.map((alert) => alert.id);
  const current = currentOf(triage, ids);
  const marked = alerts.filter((alert) => triage.marked.includes(alert.id));
  return (
    <>
      <BulkBar alerts={alerts} marked={marked} act={act} />
      <ul class="alert-lines panel">
        {alerts.map((alert) => (
          <li
            key={alert.id}
            id={`alert-${alert.id}`}
            class={alert.id === current ? 'alert-row alert-current' : 'alert-row'}
            aria-current={alert.id === shown ? 'true' : undefined}
          >
            <input
              type="checkbox"
              aria-label={`Mark alert ${alert.id}`}
              checked={triage.marked.includes(alert.id)}
              onChange={() => store.dispatch({ type: 'triage/marked', id: alert.id })}
            />
            <AlertLine alert={alert} href={linkTo(`/alerts/${alert.id}`, query)} site={manySites} />
          </li>
        ))}
      </ul>
      {(next !== null || query['cursor'] !== undefined) && (
        <nav class="pages" aria-label="Pages">
          <button
            type="button"
            disabled={query['cursor'] === undefined}
            onClick={() => setQuery({ cursor: undefined })}
          >
            Latest
          </button>
          <button type="button" disabled={next === null} onClick={() => setQuery({ cursor: next ?? undefined })}>
            Older
          </button>
        </nav>
      )}
    </>
  );
}

function BulkBar({
  alerts,
  marked,
  act,
}: Pick<AlertListProps, 'alerts' | 'act'> & { marked: readonly Schema<'Alert'>[] }) {
  const standing = marked.filter((alert) => alert.state !== 'resolved');
  const all = marked.length === alerts.length;
  return (
    <div class="bulk">
      <label>
        <input
          type="checkbox"
          checked={all}
          ref={(box) => {
            if (box) box.indeterminate = marked.length > 0 && !all;
          }}
          onChange={() =>
            store.dispatch(
              all ? { type: 'triage/cleared' } : { type: 'triage/marked-all', ids: alerts.map(({ id }) => id) },
            )
          }
        />
        {marked.length === 0 ? counted(alerts.length, 'alert') : `${marked.length} marked`}
      </label>
      {standing.length > 0 && (
        <div class="actions">
          <button type="button" onClick={() => act('acknowledge', standing)}>
            Acknowledge <KeyHint keys="a" />
          </button>
          <button type="button" onClick={() => act('snooze', standing)}>
            Snooze <KeyHint keys="s" />
          </button>
          <button type="button" onClick={() => act('resolve', standing)}>
            Resolve <KeyHint keys="r" />
          </button>
        </div>
      )}
    </div>
  );
}
