import { useEffect } from 'preact/hooks';
import { loader, useResource } from '../../app/app';
import { address, type Schema } from '../../lib/api';
import { bytes, count, counted, percent } from '../../lib/format';
import { Loaded } from '../../ui/states';
import { kMetrics, parseMetrics } from './metrics';

const kStorage = address('/api/v1/storage');

/** No event tells that the disk fills or that a worker died. */
const kAskEveryMs = 30_000;

/** Disk, queue and memory, in the daemon's own figures. */
export function DaemonFigures() {
  useEffect(() => {
    const timer = setInterval(() => loader.invalidate((key) => key === kMetrics || key === kStorage), kAskEveryMs);
    return () => clearInterval(timer);
  }, []);
  return (
    <section class="panel overview-daemon" aria-labelledby="daemon">
      <header class="panel-head">
        <h2 id="daemon">The daemon</h2>
      </header>
      <div class="panel-body">
        <Loaded of={useResource(kMetrics)} what="figures of the daemon">
          {(text) => <Figures of={parseMetrics(text)} />}
        </Loaded>
      </div>
    </section>
  );
}

function Figures({ of }: { of: Readonly<Record<string, number>> }) {
  const value = (name: string): number => of[`raywatch_${name}`] ?? 0;
  const waiting = value('queue_length');
  const asked = value('index_cache_hits_total') + value('index_cache_misses_total');
  return (
    <dl class="figures">
      <div>
        <dt>Disk</dt>
        <dd>
          <Disk storage={useResource(kStorage).data} />
          {value('store_writable') !== 1 && <strong class="overview-bad">, nothing can be stored</strong>}
        </dd>
      </div>
      <div>
        <dt>Queue</dt>
        <dd>
          {waiting === 0
            ? 'nothing waits'
            : `${counted(waiting, 'comparison')} of at most ${count(value('queue_limit'))}`}
        </dd>
      </div>
      <div>
        <dt>Workers</dt>
        <dd>
          {count(value('workers_alive'))} of {count(value('workers_expected'))} at work
        </dd>
      </div>
      <div>
        <dt>Since its start</dt>
        <dd>
          {counted(value('scans_ingested_total'), 'scan')}, {counted(value('comparisons_finished_total'), 'comparison')}
          {value('comparisons_failed_total') > 0 && `, ${count(value('comparisons_failed_total'))} failed`}
        </dd>
      </div>
      <div>
        <dt>Memory</dt>
        <dd>{bytes(value('resident_memory_bytes'))}</dd>
      </div>
      <div>
        <dt>Earlier scans from memory</dt>
        <dd>{asked === 0 ? 'none asked yet' : percent(value('index_cache_hits_total') / asked)}</dd>
      </div>
    </dl>
  );
}

/** How much is left of the disk, for how long at the rate of late, and what the store takes of it. */
function Disk({ storage }: { storage: Schema<'Storage'> | undefined }) {
  if (!storage) return null;
  const { disk } = storage;
  const kept = storage.metadata_bytes + storage.sites.reduce((sum, site) => sum + site.payload_bytes, 0);
  return (
    <>
      {bytes(disk.free_bytes)} free of {bytes(disk.bytes)}
      {disk.days_to_full !== null && `, full in ${counted(Math.floor(disk.days_to_full), 'day')}`}; {bytes(kept)} kept
    </>
  );
}
