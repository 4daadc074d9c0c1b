import { type Schema } from '../../lib/api';
import { degrees, metres } from '../../lib/format';
import { StateBadge } from '../../ui/badges';

export function ScanStateBadge({ scan }: { scan: Pick<Schema<'Scan'>, 'state'> }) {
  const tone = { queued: 'busy', comparing: 'busy', compared: 'good', failed: 'bad' } as const;
  return <StateBadge tone={tone[scan.state]}>{scan.state}</StateBadge>;
}

const kFit: Record<Schema<'Registration'>['state'], { tone: 'plain' | 'good' | 'bad' | 'busy'; words: string }> = {
  none: { tone: 'plain', words: 'as reported' },
  good: { tone: 'good', words: 'fits' },
  moved: { tone: 'busy', words: 'moved' },
  bad: { tone: 'bad', words: 'does not fit' },
};

export function RegistrationBadge({ registration }: { registration: Schema<'Registration'> }) {
  const { tone, words } = kFit[registration.state];
  return (
    <span title={`corrected by ${metres(registration.shift_m, 3)} and ${degrees(registration.turn_deg, 3)}`}>
      <StateBadge tone={tone}>{words}</StateBadge>
    </span>
  );
}
