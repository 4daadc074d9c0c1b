// A whole scan in 3D with everything that a comparison found.

import './changes.css';
import { useResource, useSelect } from '../../app/app';
import { useZone } from '../../app/sites';
import { address, type Schema } from '../../lib/api';
import { counted, dateTime, percent, sizeMetres } from '../../lib/format';
import { KindBadge } from '../../ui/badges';
import { EmptyState, Loaded } from '../../ui/states';
import { Time } from '../../ui/time';
import { ViewLink } from '../../ui/view_link';
import { ScanPanorama } from '../panorama/scan_panorama';
import { LazyStage } from '../scene/lazy_stage';
import { boxOfChange, scanLooks } from '../scene/looks';
import { type SceneSpec } from '../scene/scene_spec';
import { comparisonClouds, marksOf, scanPoints, vectorOf } from '../scene/told';

type Comparison = Schema<'Comparison'>;
type Scan = Schema<'Scan'>;
type Change = Schema<'Change'>;

export function ScanSceneView({ id }: { id: string }) {
  const scan = useResource(address('/api/v1/scans/{id}', { path: { id: Number(id) } }));
  const asked = useSelect((state) => state.location.query['comparison']);
  return (
    <Loaded of={scan} what="scan">
      {(data) => {
        const comparison = asked === undefined ? data.comparison : Number(asked);
        return comparison === null ? <Scene scan={data} /> : <WithComparison scan={data} id={comparison} />;
      }}
    </Loaded>
  );
}

export function ComparisonSceneView({ id }: { id: string }) {
  const comparison = useResource(address('/api/v1/comparisons/{id}', { path: { id: Number(id) } }));
  const scan = useResource(comparison.data && address('/api/v1/scans/{id}', { path: { id: comparison.data.scan } }));
  return (
    <Loaded of={comparison} what="comparison">
      {(data) => (
        <Loaded of={scan} what="scan">
          {(compared) => <WithComparison scan={compared} id={data.id} />}
        </Loaded>
      )}
    </Loaded>
  );
}

/** As many changes as are outlined and listed. */
const kMostChanges = 200;

function WithComparison({ scan, id }: { scan: Scan; id: number }) {
  const comparison = useResource(address('/api/v1/comparisons/{id}', { path: { id } }));
  const changes = useResource(
    address('/api/v1/comparisons/{id}/changes', { path: { id }, query: { limit: kMostChanges } }),
  );
  return (
    <Loaded of={comparison} what="comparison">
      {(data) =>
        data.state === 'done' ? (
          <Loaded of={changes} what="changes">
            {({ items }) => <Scene key={id} scan={scan} comparison={data} changes={items} />}
          </Loaded>
        ) : (
          <Scene key={`${id} ${data.state}`} scan={scan} waitsFor={data} />
        )
      }
    </Loaded>
  );
}

interface SceneProps {
  scan: Scan;
  comparison?: Comparison | undefined;
  changes?: readonly Change[];
  /** A comparison that is not done. */
  waitsFor?: Comparison | undefined;
}

function Scene({ scan, comparison, changes = [], waitsFor }: SceneProps) {
  const zone = useZone(scan.site);
  const spec: SceneSpec = {
    site: scan.site,
    anchor_m: vectorOf(scan.pose.position_m),
    radius_m: 500,
    clouds: comparison
      ? comparisonClouds(comparison)
      : [{ from: scanPoints(scan.id), what: 'The scan', side: 'both', important: false }],
    boxes: changes.map((change) => ({
      key: String(change.id),
      box: boxOfChange(change),
      kind: change.kind,
      label: `${change.id} ${change.kind}`,
      href: `/changes/${change.id}`,
    })),
    marks: marksOf(scan),
    ...(comparison && comparison.priors.length > 0
      ? {
          before: `Before: scan ${comparison.priors.map((prior) => prior.scan).join(', ')}`,
          after: `After: scan ${scan.id}, ${dateTime(scan.captured_at, zone)}`,
        }
      : {}),
  };
  return (
    <>
      <div class="view-head">
        <h1>Scan {scan.id} in 3D</h1>
        <span class="muted">
          by <ViewLink to={`/sensors/${encodeURIComponent(scan.sensor)}`}>{scan.sensor}</ViewLink> at {scan.site},{' '}
          <Time at={scan.captured_at} site={scan.site} whole />
        </span>
        <span class="spacer" />
        <a class="button" href={`/scans/${scan.id}`}>
          Its figures
        </a>
      </div>
      <div class="beside-scene">
        <LazyStage
          spec={spec}
          label={`Scan ${scan.id} in 3D. The arrow keys turn it, with Shift they move it, plus and minus come nearer.`}
          looksAvailable={['frame', 'top', 'sensor']}
          looks={scanLooks(scan)}
          hasRays={false}
          rays={undefined}
          instead={<ScanPanorama scan={scan} />}
        />
        <Changes comparison={comparison} changes={changes} waitsFor={waitsFor} />
      </div>
    </>
  );
}

function Changes({ comparison, changes, waitsFor }: Required<Pick<SceneProps, 'changes'>> & Omit<SceneProps, 'scan'>) {
  return (
    <section class="panel" aria-labelledby="changes">
      <header class="panel-head">
        <h2 id="changes">Changes</h2>
        {comparison && (
          <span class="muted">
            {counted(comparison.changes, 'change')}, {percent(comparison.testable)} could be judged
          </span>
        )}
      </header>
      {changes.length > 0 ? (
        <ul class="change-list">
          {changes.map((change) => (
            <li key={change.id}>
              <a href={`/changes/${change.id}`}>
                <KindBadge kind={change.kind} />
                <span>Change {change.id}</span>
                <span class="muted">{sizeMetres(change.size_m)}</span>
              </a>
            </li>
          ))}
        </ul>
      ) : (
        <EmptyState title={emptyWords(comparison, waitsFor)} />
      )}
    </section>
  );
}

function emptyWords(comparison: Comparison | undefined, waitsFor: Comparison | undefined): string {
  if (waitsFor) return waitsFor.state === 'failed' ? 'The comparison failed.' : 'It is still being compared.';
  if (!comparison || comparison.priors.length === 0) return 'There was no earlier scan to compare it with.';
  return 'Nothing changed here.';
}
