import { loader, store } from '../../app/app';
import { type ScanHints, uploadScan } from '../../lib/api';
import { Problem } from '../../lib/problem';
import { type Upload, withSideCars } from './uploads';

let lastId = 0;
let queue: Promise<void> = Promise.resolve();

/** Sends files one after the other. What a side-car says wins over `hints`, which hold for all. */
export function sendFiles(files: readonly File[], hints: ScanHints): void {
  const all = withSideCars(files).map(({ file, sideCar }) => ({ id: ++lastId, file, sideCar }));
  store.dispatch({
    type: 'upload/added',
    uploads: all.map(({ id, file }) => ({
      id,
      name: file.name,
      size_bytes: file.size,
      sent_bytes: 0,
      state: 'waiting',
    })),
  });
  for (const { id, file, sideCar } of all) queue = queue.then(() => sendOne(id, file, sideCar, hints));
}

async function sendOne(id: number, file: File, sideCar: File | undefined, hints: ScanHints): Promise<void> {
  const change = (part: Partial<Upload>): void => store.dispatch({ type: 'upload/changed', id, change: part });
  change({ state: 'sending' });
  try {
    const all = { ...hints, ...(sideCar ? await readSideCar(sideCar) : {}) };
    const answer = await uploadScan(file, all, (sent_bytes) => change({ sent_bytes }));
    const scan = 'items' in answer ? answer.items[0]?.id : answer.id;
    change({ state: 'stored', sent_bytes: file.size, ...(scan === undefined ? {} : { scan }) });
    loader.invalidate((key) => key.startsWith('/api/v1/scans?'));
  } catch (failure) {
    if (!(failure instanceof Problem)) throw failure;
    const fields = failure.fields.map(({ field, message }) => `${field} ${message}`).join('; ');
    change({ state: 'failed', problem: [failure.message, fields].filter(Boolean).join(' ') });
  }
}

/** What `raywatch ingest` reads from a side-car, as the query of an upload. @throws Problem */
async function readSideCar(file: File): Promise<Partial<ScanHints>> {
  interface SideCar {
    captured_at?: string;
    sensor?: string;
    frame?: 'sensor' | 'world';
    pose?: { position_m: number[]; orientation_xyzw: number[] };
  }
  let json: SideCar;
  try {
    json = JSON.parse(await file.text()) as SideCar;
  } catch {
    throw new Problem({
      kind: 'side-car',
      status: 0,
      title: 'The side-car is no JSON',
      detail: `${file.name} is no JSON.`,
    });
  }
  const { captured_at, sensor, frame, pose } = json;
  return {
    ...(captured_at === undefined ? {} : { captured_at }),
    ...(sensor === undefined ? {} : { sensor }),
    ...(frame === undefined ? {} : { frame }),
    ...(pose === undefined ? {} : { pose: [...pose.position_m, ...pose.orientation_xyzw].join(',') }),
  };
}
