// The inbox: a list to work through, by hand or by keys, with one alert beside it.

import './alerts.css';
import { useEffect } from 'preact/hooks';
import { navigate, store, useKeys, useResource, useSelect } from '../../app/app';
import { linkTo } from '../../app/router';
import { address, type Schema } from '../../lib/api';
import { type KeyBinding } from '../../lib/keys';
import { EmptyState, Loaded } from '../../ui/states';
import { AlertDetail } from './alert_detail';
import { AlertList } from './alert_list';
import { Filters, useFilter } from './filters';
import { bySeverity } from './order';
import { currentOf, targetsOf } from './triage';
import { type Act, useActions } from './use_actions';

export function AlertsView({ id }: { id?: string }) {
  const filter = useFilter();
  const { state, site, severity, cursor } = filter;
  const page = useResource(address('/api/v1/alerts', { query: { state, site, severity, limit: 200, cursor } }));
  const alerts = bySeverity(page.data?.items ?? []);
  const shown = id === undefined ? undefined : Number(id);
  const { act, dialog } = useActions();
  useTriageKeys(alerts, shown, act);
  const query = useSelect((state) => state.location.query);
  return (
    <div class={shown === undefined ? 'inbox' : 'inbox inbox-open'}>
      <section class="inbox-list" aria-labelledby="inbox">
        <div class="view-head">
          <h1 id="inbox">Alerts</h1>
          <Filters filter={filter} />
        </div>
        <Loaded of={page} what="alerts">
          {({ next }) =>
            alerts.length === 0 ? (
              <NoAlerts state={filter.state} />
            ) : (
              <AlertList alerts={alerts} shown={shown} query={query} next={next} act={act} />
            )
          }
        </Loaded>
      </section>
      {shown !== undefined && (
        <section class="inbox-detail panel" aria-label={`Alert ${shown}`}>
          <AlertDetail id={shown} back={linkTo('/alerts', query)} act={act} />
        </section>
      )}
      {dialog}
    </div>
  );
}

function NoAlerts({ state }: { state: Schema<'AlertState'> | undefined }) {
  return (
    <div class="panel">
      <EmptyState title={state === 'open' ? 'Nothing is open.' : 'No alert is like this.'}>
        <p>A new one stands here at once; there is no need to load the page again.</p>
      </EmptyState>
    </div>
  );
}

/** Keys that work in the list and beside it. With an alert open, going up and down opens the next one. */
function useTriageKeys(alerts: readonly Schema<'Alert'>[], shown: number | undefined, act: Act): void {
  const ids = alerts.map((alert) => alert.id);
  const { dispatch } = store;
  useEffect(() => {
    if (shown !== undefined && ids.includes(shown)) dispatch({ type: 'triage/pointed', ids, id: shown });
  }, [shown, ids.includes(shown ?? -1)]);
  const link = (id: number): string => linkTo(`/alerts/${id}`, store.state().location.query);
  const move = (by: 1 | -1): void => {
    dispatch({ type: 'triage/moved', ids, by });
    const current = store.state().triage.current;
    if (current === undefined) return;
    if (shown !== undefined) navigate(link(current), { replace: true });
    document.querySelector<HTMLElement>(`#alert-${current} a`)?.focus();
  };
  const targets = (): Schema<'Alert'>[] => {
    const { triage, resources } = store.state();
    const chosen = targetsOf(triage, ids);
    const marked = triage.marked.length > 0 && chosen.length > 0;
    if (shown === undefined || marked || chosen[0] === shown)
      return alerts.filter((alert) => chosen.includes(alert.id));
    // The one that is open may have left the list.
    const open = resources[address('/api/v1/alerts/{id}', { path: { id: shown } })]?.data as
      Schema<'Alert'> | undefined;
    return open && open.state !== 'resolved' ? [open] : [];
  };
  const keys: KeyBinding[] = [
    { key: 'j', does: 'next alert', run: () => move(1) },
    { key: 'k', does: 'alert before', run: () => move(-1) },
    {
      key: 'Enter',
      does: 'open the alert',
      run: () => {
        const current = currentOf(store.state().triage, ids);
        if (current !== undefined) navigate(link(current));
      },
    },
    {
      key: 'x',
      does: 'mark or unmark',
      run: () => {
        const current = currentOf(store.state().triage, ids);
        if (current !== undefined) dispatch({ type: 'triage/marked', id: current });
      },
    },
    { key: '*', does: 'mark all that are listed', run: () => dispatch({ type: 'triage/marked-all', ids }) },
    { key: 'a', does: 'acknowledge', run: () => act('acknowledge', targets()) },
    { key: 'r', does: 'resolve', run: () => act('resolve', targets()) },
    { key: 's', does: 'snooze', run: () => act('snooze', targets()) },
    { key: 'n', does: 'accept as normal', run: () => act('accept', targets()) },
    {
      key: 'Escape',
      does: 'back to the list; take marks away',
      run: () => {
        dispatch({ type: 'triage/cleared' });
        if (shown !== undefined) navigate(linkTo('/alerts', store.state().location.query));
      },
    },
  ];
  useKeys(keys);
}
