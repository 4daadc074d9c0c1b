// The latest scans to choose from, by sensor.

import { useState } from 'preact/hooks';
import { useResource } from '../../app/app';
import { address, type Schema } from '../../lib/api';
import { count } from '../../lib/format';
import { Dialog } from '../../ui/dialog';
import { SelectField } from '../../ui/form';
import { EmptyState, Loaded } from '../../ui/states';
import { Time } from '../../ui/time';

export interface ScanPickerProps {
  title: string;
  site: string | undefined;
  onClose: () => void;
  onPick: (scan: Schema<'Scan'>) => void;
}

/** So many are offered; older ones are found in the list of scans. */
const kMost = 100;

export function ScanPicker({ title, site, onClose, onPick }: ScanPickerProps) {
  const [sensor, setSensor] = useState('');
  const sensors = useResource(address('/api/v1/sensors', { query: { site, limit: 1000 } })).data?.items ?? [];
  const page = useResource(address('/api/v1/scans', { query: { site, sensor, limit: kMost } }));
  return (
    <Dialog title={title} onClose={onClose}>
      <SelectField
        label="Sensor"
        first
        options={[{ value: '', words: 'any' }, ...sensors.map(({ name }) => ({ value: name, words: name }))]}
        value={sensor}
        onValue={setSensor}
      />
      <Loaded of={page} what="scans">
        {({ items, next }) =>
          items.length === 0 ? (
            <EmptyState title="There is no such scan." />
          ) : (
            <>
              <ul class="scan-choices" tabIndex={0} aria-label="Scans">
                {items.map((scan) => (
                  <li key={scan.id}>
                    <button type="button" onClick={() => onPick(scan)}>
                      <b>{scan.id}</b>
                      <span>{scan.sensor}</span>
                      <Time at={scan.captured_at} site={scan.site} />
                      <span class="muted not-narrow">{count(scan.points)} points</span>
                    </button>
                  </li>
                ))}
              </ul>
              {next !== null && (
                <p class="muted">
                  These are the latest {kMost}. Older ones stand in the <a href="/scans">list of scans</a>.
                </p>
              )}
            </>
          )
        }
      </Loaded>
    </Dialog>
  );
}
