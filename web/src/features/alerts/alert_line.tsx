import { type Schema } from '../../lib/api';
import { SeverityBadge, StateBadge } from '../../ui/badges';
import { Ago } from '../../ui/time';

/** An alert in a line that leads to it. */
export function AlertLine({
  alert,
  href = `/alerts/${alert.id}`,
  site = true,
}: {
  alert: Schema<'Alert'>;
  href?: string;
  site?: boolean;
}) {
  const where = [site ? alert.site : '', alert.sensor ?? ''].filter(Boolean).join(' · ');
  return (
    <a class="alert-line" href={href}>
      <SeverityBadge severity={alert.severity} />
      <span class="alert-title">{alert.title}</span>
      <span class="alert-where muted">
        {where}
        {where !== '' && ' · '}
        <Ago at={alert.opened_at} site={alert.site} />
      </span>
      {alert.state !== 'open' && (
        <StateBadge tone={alert.state === 'acknowledged' ? 'busy' : 'plain'}>{alert.state}</StateBadge>
      )}
    </a>
  );
}
