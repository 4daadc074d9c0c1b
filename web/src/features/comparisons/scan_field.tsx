import { useState } from 'preact/hooks';
import { type Schema } from '../../lib/api';
import { counted } from '../../lib/format';
import { type Resource } from '../../lib/resources';
import { TextField } from '../../ui/form';
import { Time } from '../../ui/time';
import { type ComparePart } from './compare_form';
import { ScanPicker } from './scan_picker';

export interface ScanFieldProps extends ComparePart {
  scan: Resource<Schema<'Scan'>>;
  /** The number was typed to its end. */
  onAsk: () => void;
  onPick: (id: string) => void;
}

export function ScanField({ field, scan, onAsk, onPick }: ScanFieldProps) {
  const [picking, setPicking] = useState(false);
  const tied = field('scan');
  const error = tied.error ?? (scan.problem?.status === 404 ? scan.problem.message : undefined);
  return (
    <div class="panel-body compare-part">
      <div class="with-button">
        <TextField label="Number of the scan" inputMode="numeric" onDone={onAsk} {...tied} error={error} />
        <button type="button" onClick={() => setPicking(true)}>
          Choose …
        </button>
      </div>
      {scan.data && (
        <p class="muted">
          By {scan.data.sensor} at {scan.data.site}, <Time at={scan.data.captured_at} site={scan.data.site} />,{' '}
          {counted(scan.data.points, 'point')}.
        </p>
      )}
      {picking && (
        <ScanPicker
          title="Which scan"
          site={scan.data?.site}
          onClose={() => setPicking(false)}
          onPick={(picked) => {
            onPick(String(picked.id));
            setPicking(false);
          }}
        />
      )}
    </div>
  );
}
