// Scan files by drag and drop, or chosen; each with its progress, and in the daemon's words why it was not taken.

import { useEffect, useRef, useState } from 'preact/hooks';
import { store, useResource, useSelect } from '../../app/app';
import { address } from '../../lib/api';
import { bytes, percent } from '../../lib/format';
import { momentOf } from '../../lib/zone';
import { StateBadge } from '../../ui/badges';
import { Icon } from '../../ui/icon';
import { sendFiles } from './send_files';
import { type Upload } from './uploads';
import { useZone } from '../../app/sites';

export function UploadPanel() {
  const uploads = useSelect((state) => state.uploads);
  const sensors = useResource(address('/api/v1/sensors', { query: { limit: 1000 } })).data?.items ?? [];
  const [sensor, setSensor] = useState('');
  const [captured, setCaptured] = useState('');
  const chosen = sensors.find((candidate) => candidate.name === sensor) ?? sensors[0];
  const zone = useZone(chosen?.site);
  const input = useRef<HTMLInputElement>(null);
  const take = (files: readonly File[]): void => {
    if (files.length === 0) return;
    const captured_at = captured === '' ? undefined : momentOf(captured, zone).toISOString();
    sendFiles(files, { sensor: chosen?.name ?? '', ...(captured_at === undefined ? {} : { captured_at }) });
  };
  const over = useDropAnywhere(take);
  return (
    <section class={over ? 'panel upload upload-over' : 'panel upload'} aria-labelledby="upload">
      <header class="panel-head">
        <h2 id="upload">
          <Icon name="upload" /> Upload scans
        </h2>
        <span class="muted">Drop files anywhere on this page, with their side-cars (.json) if they have any.</span>
      </header>
      <div class="panel-body upload-hints">
        <label class="field">
          Sensor, where no side-car names it
          <select value={chosen?.name ?? ''} onChange={(event) => setSensor(event.currentTarget.value)}>
            {sensors.length === 0 && <option value="">there is no sensor yet</option>}
            {sensors.map(({ name, site }) => (
              <option key={name} value={name}>
                {name} ({site})
              </option>
            ))}
          </select>
        </label>
        <label class="field">
          Taken at, where neither file nor side-car says it ({zone})
          <input
            type="datetime-local"
            step={1}
            value={captured}
            onInput={(event) => setCaptured(event.currentTarget.value)}
          />
        </label>
        <button type="button" class="primary" onClick={() => input.current?.click()}>
          Choose files
        </button>
        <input
          ref={input}
          class="visually-hidden"
          type="file"
          multiple
          tabIndex={-1}
          aria-label="Scan files"
          onChange={(event) => {
            take([...(event.currentTarget.files ?? [])]);
            event.currentTarget.value = '';
          }}
        />
      </div>
      {uploads.length > 0 && <UploadList uploads={uploads} />}
    </section>
  );
}

/** Whether files are held over the page. */
function useDropAnywhere(take: (files: readonly File[]) => void): boolean {
  const [over, setOver] = useState(false);
  const latest = useRef(take);
  latest.current = take;
  useEffect(() => {
    const onDrag = (event: DragEvent): void => {
      if (!event.dataTransfer?.types.includes('Files')) return;
      event.preventDefault();
      setOver(true);
    };
    const onLeave = (event: DragEvent): void => {
      if (event.relatedTarget === null) setOver(false);
    };
    const onDrop = (event: DragEvent): void => {
      event.preventDefault();
      setOver(false);
      latest.current([...(event.dataTransfer?.files ?? [])]);
    };
    document.addEventListener('dragover', onDrag);
    document.addEventListener('dragleave', onLeave);
    document.addEventListener('drop', onDrop);
    return () => {
      document.removeEventListener('dragover', onDrag);
      document.removeEventListener('dragleave', onLeave);
      document.removeEventListener('drop', onDrop);
    };
  }, []);
  return over;
}

function UploadList({ uploads }: { uploads: readonly Upload[] }) {
  const over = uploads.some(({ state }) => state !== 'waiting' && state !== 'sending');
  return (
    <div class="upload-list">
      <ul aria-label="Uploads">
        {uploads.map((upload) => (
          <li key={upload.id}>
            <span class="upload-name">{upload.name}</span>
            <span class="muted">{bytes(upload.size_bytes)}</span>
            <UploadState upload={upload} />
          </li>
        ))}
      </ul>
      {over && (
        <button type="button" class="quiet" onClick={() => store.dispatch({ type: 'upload/forgotten' })}>
          Forget those that are over
        </button>
      )}
    </div>
  );
}

function UploadState({ upload }: { upload: Upload }) {
  switch (upload.state) {
    case 'waiting':
      return <span class="muted">waits</span>;
    case 'sending': {
      const share = upload.size_bytes > 0 ? upload.sent_bytes / upload.size_bytes : 0;
      return (
        <span class="share">
          <progress max={1} value={share} aria-label={`${upload.name} sent`} />
          {share < 1 ? percent(share) : 'is being stored'}
        </span>
      );
    }
    case 'failed':
      return (
        <span class="upload-problem" role="alert">
          <StateBadge tone="bad">not taken</StateBadge> {upload.problem}
        </span>
      );
    default:
      return (
        <span>
          <StateBadge tone="good">stored</StateBadge>{' '}
          {upload.scan !== undefined && <a href={`/scans/${upload.scan}`}>scan {upload.scan}</a>}
        </span>
      );
  }
}
