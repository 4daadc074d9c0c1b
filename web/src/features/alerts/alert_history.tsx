import { type Schema } from '../../lib/api';
import { Time } from '../../ui/time';

/** Everything that happened with an alert, the latest first. */
export function AlertHistory({ alert }: { alert: Schema<'AlertDetail'> }) {
  return (
    <section class="alert-part">
      <h3>History</h3>
      <ol class="steps">
        {[...alert.history].reverse().map((step, index) => (
          <li key={alert.history.length - index}>
            <p>
              <b>{step.action}</b>
              {step.by !== '' && ` by ${step.by}`}
              <span class="muted">
                {' · '}
                <Time at={step.at} site={alert.site} />
              </span>
            </p>
            {step.note !== '' && <p class="step-note">{step.note}</p>}
          </li>
        ))}
      </ol>
    </section>
  );
}
