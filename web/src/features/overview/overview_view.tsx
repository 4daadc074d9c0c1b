// All at a glance: what stands open, how the sensors fare, and whether the daemon keeps up.

import './overview.css';
import { useResource, useSelect } from '../../app/app';
import { kOpenAlerts } from '../../app/alert_count';
import { kSites } from '../../app/sites';
import { address, type Schema } from '../../lib/api';
import { count, counted, duration, percent } from '../../lib/format';
import { FirstScan } from '../../ui/at_site';
import { SeverityBadge, StateBadge } from '../../ui/badges';
import { EmptyState, Loaded } from '../../ui/states';
import { Ago } from '../../ui/time';
import { ViewLink } from '../../ui/view_link';
import { AlertLine } from '../alerts/alert_line';
import { bySeverity } from '../alerts/order';
import { DaemonFigures } from './daemon_figures';
import { healthOf } from './health';

export function OverviewView() {
  return (
    <>
      <div class="view-head">
        <h1>Overview</h1>
      </div>
      <div class="overview">
        <OpenAlerts />
        <DaemonFigures />
        <Sites />
      </div>
    </>
  );
}

const kShownAlerts = 6;

function OpenAlerts() {
  const alerts = useResource(kOpenAlerts);
  return (
    <section class="panel overview-alerts" aria-labelledby="open-alerts">
      <header class="panel-head">
        <h2 id="open-alerts">Open alerts</h2>
        <SeverityCounts alerts={alerts.data?.items ?? []} />
        <span class="spacer" />
        <a href="/alerts">Go to the inbox</a>
      </header>
      <Loaded of={alerts} what="alerts">
        {({ items }) =>
          items.length === 0 ? (
            <EmptyState title="Nothing is open.">
              <p>What lasts and what a rule asks for will stand here at once.</p>
            </EmptyState>
          ) : (
            <ul class="alert-lines">
              {bySeverity(items)
                .slice(0, kShownAlerts)
                .map((alert) => (
                  <li key={alert.id}>
                    <AlertLine alert={alert} />
                  </li>
                ))}
              {items.length > kShownAlerts && (
                <li class="overview-more">
                  <a href="/alerts">and {count(items.length - kShownAlerts)} more</a>
                </li>
              )}
            </ul>
          )
        }
      </Loaded>
    </section>
  );
}

function SeverityCounts({ alerts }: { alerts: readonly Schema<'Alert'>[] }) {
  const severities: Schema<'Severity'>[] = ['critical', 'warning', 'advisory', 'info'];
  return (
    <>
      {severities.map((severity) => {
        const number = alerts.filter((alert) => alert.severity === severity).length;
        return number > 0 ? (
          <span key={severity} class="overview-count">
            {count(number)} <SeverityBadge severity={severity} />
          </span>
        ) : null;
      })}
    </>
  );
}

function Sites() {
  const sites = useResource(kSites);
  const sensors = useResource(address('/api/v1/sensors', { query: { limit: 1000 } }));
  return (
    <Loaded of={sites} what="sites">
      {({ items }) =>
        items.length === 0 ? (
          <section class="panel overview-sites">
            <EmptyState title="There is no site yet.">
              <FirstScan of="A site" />
            </EmptyState>
          </section>
        ) : (
          <>
            {items.map((site) => (
              <SitePanel
                key={site.name}
                site={site}
                sensors={(sensors.data?.items ?? []).filter((sensor) => sensor.site === site.name)}
              />
            ))}
          </>
        )
      }
    </Loaded>
  );
}

function SitePanel({ site, sensors }: { site: Schema<'Site'>; sensors: readonly Schema<'Sensor'>[] }) {
  return (
    <section class="panel overview-sites" aria-label={`Site ${site.name}`}>
      <header class="panel-head">
        <h2>
          <a href={`/sites/${encodeURIComponent(site.name)}`}>{site.name}</a>
        </h2>
        <span class="muted">
          {site.profile} · times in {site.time_zone}
          {site.epsg !== null && ` · EPSG:${site.epsg}`}
          {site.mine_grid !== null && ' · local mine grid'}
        </span>
        <span class="spacer" />
        <span class="muted">{counted(sensors.length, 'sensor')}</span>
      </header>
      {sensors.length === 0 ? (
        <EmptyState title="This site has no sensor yet." />
      ) : (
        <div class="overview-sensors" role="table" aria-label={`Sensors of ${site.name}`}>
          <div role="row" class="overview-sensor overview-sensor-head">
            <span role="columnheader">Sensor</span>
            <span role="columnheader">Health</span>
            <span role="columnheader">Last scan</span>
            <span role="columnheader">Coverage</span>
            <span role="columnheader">Changes</span>
          </div>
          {sensors.map((sensor) => (
            <SensorRow key={sensor.name} sensor={sensor} />
          ))}
        </div>
      )}
    </section>
  );
}

function SensorRow({ sensor }: { sensor: Schema<'Sensor'> }) {
  const scans = useResource(address('/api/v1/scans', { query: { sensor: sensor.name, limit: 1 } }));
  const alerts = useResource(kOpenAlerts);
  const now_ms = useSelect((state) => state.now_ms);
  const latest = scans.data?.items[0];
  const comparison = useResource(
    latest?.comparison ? address('/api/v1/comparisons/{id}', { path: { id: latest.comparison } }) : undefined,
  ).data;
  const health = healthOf(sensor, latest, alerts.data?.items ?? [], now_ms);
  const shown = comparison?.state === 'done' ? comparison : undefined;
  return (
    <div role="row" class="overview-sensor">
      <span role="cell" class="overview-name">
        <ViewLink to={`/sensors/${encodeURIComponent(sensor.name)}`}>{sensor.name}</ViewLink>
        {sensor.interval_s !== null && <span class="muted"> every {duration(sensor.interval_s)}</span>}
      </span>
      <span role="cell">
        {scans.data && <StateBadge tone={health.tone}>{health.word}</StateBadge>}
        {health.why !== '' && <span class="overview-why">{health.why}</span>}
      </span>
      <span role="cell" data-label="Last scan">
        {latest ? (
          <ViewLink to={`/scans/${latest.id}`}>
            <Ago at={latest.captured_at} site={sensor.site} />
          </ViewLink>
        ) : (
          <span class="muted">none</span>
        )}
      </span>
      <span
        role="cell"
        data-label="Coverage"
        title="The share of the latest scan's points that an earlier scan could judge"
      >
        {shown ? <Share value={shown.testable} /> : <span class="muted">–</span>}
      </span>
      <span role="cell" data-label="Changes">
        {shown ? counted(shown.changes, 'change') : <span class="muted">–</span>}
      </span>
    </div>
  );
}

function Share({ value }: { value: number }) {
  return (
    <span class="share">
      <span class="bar" aria-hidden="true">
        <span style={{ width: `${100 * value}%` }} />
      </span>
      {percent(value)}
    </span>
  );
}
