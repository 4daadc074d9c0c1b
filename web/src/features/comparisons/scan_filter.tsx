import { setQuery, useSelect } from '../../app/app';

/** The number of the scan whose comparisons are listed. */
export function ScanFilter() {
  const scan = useSelect((state) => state.location.query['scan']);
  return (
    <label class="inline-field">
      of scan
      <input
        class="scan-number"
        type="number"
        min={1}
        step={1}
        placeholder="any"
        value={scan ?? ''}
        onChange={(event) => {
          const { value, validity } = event.currentTarget;
          if (validity.valid) setQuery({ cursor: undefined, scan: value === '' ? undefined : value });
        }}
      />
    </label>
  );
}
