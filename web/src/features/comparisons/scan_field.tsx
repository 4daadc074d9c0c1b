import { useState } from 'preact/hooks';
import { type Schema } from '../../lib/api';
import { counted } from '../../lib/format';
import { type Resource } from '../../lib/resources';
import { Time } from '../../ui/time';
import { FieldError, type PartProps } from './compare_form';
import { ScanPicker } from './scan_picker';

export interface ScanFieldProps extends PartProps {
  scan: Resource<Schema<'Scan'>>;
  /** The number was typed to its end. */
  onAsk: () => void;
  onPick: (id: string) => void;
}

export function ScanField({ draft, errors, onChange, scan, onAsk, onPick }: ScanFieldProps) {
  const [picking, setPicking] = useState(false);
  const error = errors.get('scan') ?? (scan.problem?.status === 404 ? scan.problem.message : undefined);
  return (
    <div class="panel-body compare-part">
      <div class="with-button">
        <label class="field">
          Number of the scan
          <input
            inputMode="numeric"
            value={draft.scan}
            aria-invalid={error !== undefined}
            onInput={(event) => onChange({ scan: event.currentTarget.value })}
            onChange={onAsk}
          />
          <FieldError message={error} />
        </label>
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
