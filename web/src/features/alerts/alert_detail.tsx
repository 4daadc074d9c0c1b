// One alert: what to do about it, why it was raised, and what was done.

import { store, useResource, useSelect } from '../../app/app';
import { linkTo } from '../../app/router';
import { address, type Schema } from '../../lib/api';
import { SeverityBadge, StateBadge } from '../../ui/badges';
import { noteLabel } from '../../ui/confirm_dialog';
import { NoteField } from '../../ui/form';
import { Icon } from '../../ui/icon';
import { KeyHint } from '../../ui/key_hint';
import { Loaded } from '../../ui/states';
import { Time } from '../../ui/time';
import { ViewLink } from '../../ui/view_link';
import { AlertHistory } from './alert_history';
import { Why } from './why';
import { noteFor } from './triage';
import { type Act } from './use_actions';

type Detail = Schema<'AlertDetail'>;

export function AlertDetail({ id, back, act }: { id: number; back: string; act: Act }) {
  const alert = useResource(address('/api/v1/alerts/{id}', { path: { id } }));
  return (
    <Loaded of={alert} what="alert">
      {(detail) => (
        <article>
          <Head alert={detail} back={back} />
          {detail.state === 'resolved' ? (
            <p class="alert-over muted">It is over: nothing is left to be done.</p>
          ) : (
            <Actions key={detail.id} alert={detail} act={act} />
          )}
          {detail.why ? <Why alert={detail} why={detail.why} /> : <SystemAlert alert={detail} />}
          <AlertHistory alert={detail} />
        </article>
      )}
    </Loaded>
  );
}

function Head({ alert, back }: { alert: Detail; back: string }) {
  return (
    <header class="panel-head alert-head">
      <a class="button alert-back" href={back} aria-label="Back to the list">
        <Icon name="back" />
      </a>
      <div>
        <h2>{alert.title}</h2>
        <p class="muted">
          Alert {alert.id} at {alert.site}, opened <Time at={alert.opened_at} site={alert.site} whole />
        </p>
        <p class="actions">
          <SeverityBadge severity={alert.severity} />
          <StateBadge tone={alert.state === 'open' ? 'bad' : alert.state === 'resolved' ? 'good' : 'busy'}>
            {alert.state}
          </StateBadge>
          {alert.snoozed_until && (
            <span class="muted">
              until <Time at={alert.snoozed_until} site={alert.site} />
            </span>
          )}
        </p>
      </div>
    </header>
  );
}

function Actions({ alert, act }: { alert: Detail; act: Act }) {
  const note = useSelect((state) => noteFor(state.triage, [alert.id]));
  const setNote = (text: string): void => store.dispatch({ type: 'triage/drafted', id: alert.id, note: text });
  const again = alert.state === 'acknowledged';
  return (
    <div class="alert-actions">
      <NoteField label={noteLabel()} value={note} onValue={setNote} />
      <div class="actions">
        <button
          type="button"
          class={again ? '' : 'primary'}
          disabled={again && note === ''}
          onClick={() => act('acknowledge', [alert])}
        >
          <Icon name="check" /> {again ? 'Add the note' : 'Acknowledge'} <KeyHint keys="a" />
        </button>
        <button type="button" onClick={() => act('snooze', [alert])}>
          <Icon name="clock" /> Snooze <KeyHint keys="s" />
        </button>
        <button type="button" onClick={() => act('resolve', [alert])}>
          Resolve <KeyHint keys="r" />
        </button>
        {alert.track !== null && (
          <button type="button" onClick={() => act('accept', [alert])}>
            Accept as normal <KeyHint keys="n" />
          </button>
        )}
      </div>
    </div>
  );
}

function SystemAlert({ alert }: { alert: Detail }) {
  return (
    <section class="alert-part">
      <h3>Why</h3>
      <p>
        The system itself raised this alert ({alert.cause}). It resolves by itself when the cause is gone.
        {alert.sensor !== null && (
          <>
            {' '}
            It is about the sensor{' '}
            <ViewLink to={`/sensors/${encodeURIComponent(alert.sensor)}`}>{alert.sensor}</ViewLink>.
          </>
        )}
        {alert.scan !== null && (
          <>
            {' '}
            It was raised by <ViewLink to={`/scans/${alert.scan}`}>scan {alert.scan}</ViewLink>.
          </>
        )}
        {alert.cause.startsWith('survey-') && (
          <>
            {' '}
            It is about <a href={linkTo('/surveys', { site: alert.site })}>the surveys of {alert.site}</a>.
          </>
        )}
      </p>
    </section>
  );
}
