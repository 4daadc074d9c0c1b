import { useState } from 'preact/hooks';
import { loader, navigate, showToast } from '../../app/app';
import { attempt } from '../../app/attempt';
import { address, type Schema, send } from '../../lib/api';
import { type Resource } from '../../lib/resources';
import { StateBadge } from '../../ui/badges';
import { DeleteDialog } from '../../ui/delete_dialog';
import { NoteField } from '../../ui/form';

type Scan = Schema<'Scan'>;

export const scanAddress = (id: number) => address('/api/v1/scans/{id}', { path: { id } });

/** Pinned scans are never deleted; a note says why. Tied to the version that is shown. */
export function Keeping({ scan, resource }: { scan: Scan; resource: Resource<Scan> }) {
  const [note, setNote] = useState(scan.note);
  const [asking, setAsking] = useState(false);
  const edit = async (body: Schema<'ScanEdit'>): Promise<void> => {
    const isKept = await attempt(async () => {
      const path = { id: scan.id };
      loader.put(scanAddress(scan.id), await send('patch', '/api/v1/scans/{id}', { path, body, etag: resource.etag }));
      loader.invalidate((key) => key.startsWith('/api/v1/scans?'));
      showToast('good', 'Kept.');
    });
    if (!isKept) loader.invalidate((key) => key === scanAddress(scan.id));
  };
  const remove = async (): Promise<void> => {
    await send('delete', '/api/v1/scans/{id}', { path: { id: scan.id } });
    loader.invalidate((key) => key.startsWith('/api/v1/scans?'));
    showToast('good', `Scan ${scan.id} was deleted.`);
    navigate('/scans');
  };
  return (
    <section class="panel" aria-labelledby="keeping">
      <header class="panel-head">
        <h2 id="keeping">Keeping</h2>
        {scan.pinned && <StateBadge tone="good">pinned</StateBadge>}
      </header>
      <form
        class="panel-body"
        onSubmit={(event) => {
          event.preventDefault();
          void edit({ note });
        }}
      >
        <NoteField label="Note" value={note} onValue={setNote} />
        <div class="actions">
          <button type="submit" disabled={note === scan.note}>
            Keep the note
          </button>
          <button type="button" onClick={() => void edit({ pinned: !scan.pinned })}>
            {scan.pinned ? 'Unpin' : 'Pin: never delete it'}
          </button>
          <button type="button" disabled={scan.pinned} onClick={() => setAsking(true)}>
            Delete
          </button>
        </div>
      </form>
      {asking && (
        <DeleteDialog what={`scan ${scan.id}`} onClose={() => setAsking(false)} onDelete={remove}>
          <p>Its points, its comparisons and their changes are gone for good.</p>
        </DeleteDialog>
      )}
    </section>
  );
}
