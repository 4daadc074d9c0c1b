// "What would have alerted": a rule, saved or not, tried exactly on what happened.

import { useState } from 'preact/hooks';
import { useResource } from '../../app/app';
import { useZone } from '../../app/sites';
import { address, type Schema, send } from '../../lib/api';
import { counted, duration } from '../../lib/format';
import { Problem } from '../../lib/problem';
import { localOf, momentOf } from '../../lib/zone';
import { SeverityBadge } from '../../ui/badges';
import { EmptyState, ErrorState } from '../../ui/states';
import { Time } from '../../ui/time';
import { ViewLink } from '../../ui/view_link';
import { perDay, type Rehearsed } from './rehearsal';

type Span = '1' | '7' | '30' | 'all' | 'own';

const kSpans: readonly { readonly span: Span; readonly words: string }[] = [
  { span: '1', words: 'the last day of scans' },
  { span: '7', words: 'the last 7 days of scans' },
  { span: '30', words: 'the last 30 days of scans' },
  { span: 'all', words: 'all that is stored' },
  { span: 'own', words: 'a time of my own' },
];
const kMostListed = 100;

interface Outcome {
  readonly tried: readonly Rehearsed[];
  /** By the rule as it is saved, when that is another one. */
  readonly saved: readonly Rehearsed[] | undefined;
}

export interface RehearsalPanelProps {
  site: string;
  /** The rule in whose place it is tried: itself, or for a new one any of the site; undefined where there is none. */
  host: number | undefined;
  /** Whether the host is the rule itself, as it was saved. */
  isOwn: boolean;
  rule: Schema<'NewRule'>;
}

export function RehearsalPanel({ site, host, isOwn, rule }: RehearsalPanelProps) {
  const range = useRange(site);
  const [outcome, setOutcome] = useState<Outcome | undefined>();
  const [problem, setProblem] = useState<Problem | undefined>();
  const [busy, setBusy] = useState(false);
  const tryIt = async (id: number): Promise<void> => {
    setBusy(true);
    setProblem(undefined);
    const test = (body: Schema<'RuleTest'>) =>
      send('post', '/api/v1/rules/{id}/test', { path: { id }, body: { ...range.times(), ...body } });
    try {
      const named = { ...rule, name: rule.name === '' ? 'new rule' : rule.name, enabled: true };
      const [tried, saved] = await Promise.all([test({ rule: named }), isOwn ? test({}) : undefined]);
      setOutcome({ tried: tried.data.alerts ?? [], saved: saved?.data.alerts });
    } catch (failure) {
      if (!(failure instanceof Problem)) throw failure;
      setOutcome(undefined);
      setProblem(failure);
    } finally {
      setBusy(false);
    }
  };
  return (
    <section class="panel" aria-labelledby="rehearsal">
      <header class="panel-head">
        <h2 id="rehearsal">What would have alerted</h2>
      </header>
      <div class="panel-body rehearsal">
        <p class="muted">
          Tries the rule, as it stands in the form, on what happened: exactly, with the zones and silences as they are
          now. Nothing is raised or stored.
        </p>
        <div class="actions">
          {range.fields}
          <button
            type="button"
            disabled={busy || host === undefined}
            onClick={() => host !== undefined && void tryIt(host)}
          >
            {busy ? 'Trying …' : 'Try it'}
          </button>
        </div>
        {host === undefined && <p class="muted">This site has no rule yet; save this one, and it can be tried.</p>}
        {problem && <ErrorState problem={problem} />}
        {outcome && <Outcome outcome={outcome} site={site} />}
      </div>
    </section>
  );
}

/** The time range that is tried; days are counted back from the latest scan. */
function useRange(site: string) {
  const time_zone = useZone(site);
  const latest = useResource(address('/api/v1/scans', { query: { site, limit: 1 } })).data?.items[0]?.captured_at;
  const [span, setSpan] = useState<Span>('7');
  const [own, setOwn] = useState<{ from: string; to: string } | undefined>();
  const last = latest === undefined ? new Date() : new Date(latest);
  const shown = own ?? {
    from: localOf(new Date(last.getTime() - 86_400_000), time_zone),
    to: localOf(new Date(last.getTime() + 60_000), time_zone),
  };
  const times = (): Pick<Schema<'RuleTest'>, 'from' | 'to'> => {
    if (span === 'all') return {};
    if (span !== 'own') return { from: new Date(last.getTime() - Number(span) * 86_400_000).toISOString() };
    return { from: momentOf(shown.from, time_zone).toISOString(), to: momentOf(shown.to, time_zone).toISOString() };
  };
  const moment = (name: 'from' | 'to') => (
    <label class="inline-field">
      {name}
      <input
        type="datetime-local"
        required
        value={shown[name]}
        onChange={(event) => setOwn({ ...shown, [name]: event.currentTarget.value })}
      />
    </label>
  );
  const fields = (
    <>
      <select aria-label="On" value={span} onChange={(event) => setSpan(event.currentTarget.value as Span)}>
        {kSpans.map(({ span: value, words }) => (
          <option key={value} value={value}>
            {words}
          </option>
        ))}
      </select>
      {span === 'own' && (
        <>
          {moment('from')}
          {moment('to')}
          <span class="muted">{time_zone}</span>
        </>
      )}
    </>
  );
  return { times, fields };
}

function Outcome({ outcome: { tried, saved }, site }: { outcome: Outcome; site: string }) {
  const time_zone = useZone(site);
  const days = perDay(tried, time_zone);
  const most = Math.max(1, ...days.map(({ count }) => count));
  return (
    <div class="rehearsal" role="status">
      <p>
        <b>{counted(tried.length, 'alert')}</b>
        {days.length > 1 && ` on ${counted(days.length, 'day')}`}
        {saved && `; as it is saved: ${counted(saved.length, 'alert')}`}.
      </p>
      {tried.length === 0 ? (
        <EmptyState title="Nothing would have alerted in that time." />
      ) : (
        <>
          <dl class="day-counts">
            {days.map(({ day, count }) => (
              <div key={day}>
                <dt>{day}</dt>
                <dd>
                  <span class="day-bar" style={{ width: `${(100 * count) / most}%` }} /> {count}
                </dd>
              </div>
            ))}
          </dl>
          <RehearsedTable alerts={tried} site={site} />
        </>
      )}
    </div>
  );
}

function RehearsedTable({ alerts, site }: { alerts: readonly Rehearsed[]; site: string }) {
  return (
    <>
      <div class="table-scroll" tabIndex={0} role="region" aria-label="alerts that would have been raised">
        <table>
          <caption class="visually-hidden">alerts that would have been raised</caption>
          <thead>
            <tr>
              <th scope="col">Opened</th>
              <th scope="col">Severity</th>
              <th scope="col">Of</th>
              <th scope="col">By</th>
              <th scope="col">Resolved</th>
            </tr>
          </thead>
          <tbody>
            {alerts.slice(0, kMostListed).map((alert) => (
              <tr key={`${alert.track}:${alert.scan}`}>
                <td>
                  <Time at={alert.at} site={site} />
                </td>
                <td>
                  <SeverityBadge severity={alert.severity} />
                </td>
                <td>
                  <ViewLink to={`/tracks/${alert.track}`}>track {alert.track}</ViewLink>
                </td>
                <td>
                  <a href={`/scans/${alert.scan}`}>scan {alert.scan}</a>
                </td>
                <td>{resolvedInWords(alert)}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
      {alerts.length > kMostListed && (
        <p class="muted">The first {kMostListed} are listed; a shorter time shows the others.</p>
      )}
    </>
  );
}

const resolvedInWords = ({ at, resolved_at }: Rehearsed): string =>
  resolved_at === null ? 'would still stand' : `after ${duration((Date.parse(resolved_at) - Date.parse(at)) / 1000)}`;
