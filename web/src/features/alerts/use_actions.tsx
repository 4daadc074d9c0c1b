// The way from a key or button to an action: who does it, on what, and the question that comes before.

import { type ComponentChildren } from 'preact';
import { useState } from 'preact/hooks';
import { store } from '../../app/app';
import { withOperator } from '../../app/operator';
import { type Schema } from '../../lib/api';
import { counted } from '../../lib/format';
import { type ActionKind, actOn } from './actions';
import { noteFor } from './triage';
import { ConfirmDialog, SnoozeDialog } from './dialogs';

export type Act = (kind: ActionKind, alerts: readonly Schema<'Alert'>[]) => void;

interface Asked {
  readonly kind: ActionKind;
  readonly alerts: readonly Schema<'Alert'>[];
}

/** @returns what begins an action, and the dialog that it may need. */
export function useActions(): { act: Act; dialog: ComponentChildren } {
  const [asked, setAsked] = useState<Asked | undefined>();
  const carryOut = ({ kind, alerts }: Asked, note: string, until?: string): void => {
    setAsked(undefined);
    store.dispatch({ type: 'triage/cleared' });
    withOperator((by) => void actOn(alerts, { kind, by, note, ...(until === undefined ? {} : { until }) }));
  };
  const act: Act = (kind, alerts) => {
    if (alerts.length === 0) return;
    const needsQuestion = kind === 'snooze' || kind === 'accept' || (kind === 'resolve' && alerts.length > 1);
    if (needsQuestion) setAsked({ kind, alerts });
    else
      carryOut(
        { kind, alerts },
        noteFor(
          store.state().triage,
          alerts.map((alert) => alert.id),
        ),
      );
  };
  const dialog = asked && <Question asked={asked} onClose={() => setAsked(undefined)} carryOut={carryOut} />;
  return { act, dialog };
}

function Question({
  asked,
  onClose,
  carryOut,
}: {
  asked: Asked;
  onClose: () => void;
  carryOut: (asked: Asked, note: string, until?: string) => void;
}) {
  const number = asked.alerts.length;
  const draft = noteFor(
    store.state().triage,
    asked.alerts.map((alert) => alert.id),
  );
  if (asked.kind === 'snooze') {
    const site = asked.alerts[0]?.site;
    return (
      <SnoozeDialog
        draft={draft}
        number={number}
        site={site}
        onClose={onClose}
        onSnooze={(until, note) => carryOut(asked, note, until)}
      />
    );
  }
  if (asked.kind === 'accept') {
    return (
      <ConfirmDialog
        draft={draft}
        title={`Accept ${counted(number, 'change')} as normal`}
        words="What the scans show there counts as normal from now on: it raises no alert any more, and its later loss does. The baseline keeps who decided this."
        doIt="Accept as normal"
        onClose={onClose}
        onConfirm={(note) => carryOut(asked, note)}
      />
    );
  }
  return (
    <ConfirmDialog
      draft={draft}
      title={`Resolve ${counted(number, 'alert')}`}
      words="A resolved alert cannot be opened again. If the change is seen anew after it was gone, there is a new alert."
      doIt="Resolve"
      onClose={onClose}
      onConfirm={(note) => carryOut(asked, note)}
    />
  );
}
