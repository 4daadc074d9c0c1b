// States in a word with a shape: colour is never the only difference.

import { type Schema } from '../lib/api';
import { Icon } from './icon';

const kSeverityShape: Record<Schema<'Severity'>, string> = { critical: '▲', warning: '◆', advisory: '●', info: '○' };

export function SeverityBadge({ severity }: { severity: Schema<'Severity'> }) {
  return (
    <span class={`badge severity-${severity}`}>
      <span aria-hidden="true">{kSeverityShape[severity]}</span> {severity}
    </span>
  );
}

const kKind: Record<Schema<'ChangeKind'>, string> = { added: 'added', removed: 'removed', discrepancy: 'discrepancy' };

export function KindBadge({ kind }: { kind: Schema<'ChangeKind'> }) {
  return (
    <span class={`badge kind-${kind}`}>
      <Icon name={kind} /> {kKind[kind]}
    </span>
  );
}

/** Any other state in a word: `good`, `bad`, `busy` or plain. */
export function StateBadge({
  tone = 'plain',
  children,
}: {
  tone?: 'plain' | 'good' | 'bad' | 'busy';
  children: string;
}) {
  return <span class={`badge tone-${tone}`}>{children}</span>;
}
