// One change: where it is in the scan, what stands before it in time, and the rays that prove it.

import './changes.css';
import { useResource, useSelect } from '../../app/app';
import { useZone } from '../../app/sites';
import { address, type Schema } from '../../lib/api';
import { dateTime } from '../../lib/format';
import { KindBadge } from '../../ui/badges';
import { Loaded } from '../../ui/states';
import { Time } from '../../ui/time';
import { PanoramaPanel } from '../panorama/panorama';
import { LazyStage } from '../scene/lazy_stage';
import { boxOfChange, changeLooks } from '../scene/looks';
import { comparisonClouds, marksOf, vectorOf } from '../scene/told';
import { type RayBundle, type SceneSpec } from '../scene/scene_spec';
import { ChangeFigures } from './change_figures';

type Change = Schema<'Change'>;

export function ChangeView({ id }: { id: string }) {
  const change = useResource(address('/api/v1/changes/{id}', { path: { id: Number(id) } }));
  return (
    <Loaded of={change} what="change">
      {(data) => <OneChange key={data.id} change={data} />}
    </Loaded>
  );
}

function OneChange({ change }: { change: Change }) {
  const comparison = useResource(address('/api/v1/comparisons/{id}', { path: { id: change.comparison } }));
  const scan = useResource(address('/api/v1/scans/{id}', { path: { id: change.scan } }));
  return (
    <>
      <div class="view-head">
        <h1>Change {change.id}</h1>
        <KindBadge kind={change.kind} />
        <span class="muted">
          at {change.site}, <Time at={change.captured_at} site={change.site} whole />
        </span>
      </div>
      <div class="beside-scene">
        <div class="scene-and-below">
          <Loaded of={scan} what="scan">
            {(shown) => (
              <Loaded of={comparison} what="comparison">
                {(data) => <Picture change={change} comparison={data} scan={shown} />}
              </Loaded>
            )}
          </Loaded>
          <PanoramaPanel scan={change.scan} changes={[change]} />
        </div>
        <ChangeFigures change={change} comparison={comparison.data} scan={scan.data} />
      </div>
    </>
  );
}

interface PictureProps {
  change: Change;
  comparison: Schema<'Comparison'>;
  scan: Schema<'Scan'>;
}

function Picture({ change, comparison, scan }: PictureProps) {
  const zone = useZone(change.site);
  const asksRays = useSelect((state) => state.location.query['rays'] === '1');
  // Its own points are in the picture already: one is the least that can be asked for.
  const evidence = useResource(
    asksRays
      ? address('/api/v1/changes/{id}/evidence', { path: { id: change.id }, query: { points: 1, margin_m: 0 } })
      : undefined,
  );
  const spec: SceneSpec = {
    site: change.site,
    anchor_m: vectorOf(change.centroid_m),
    radius_m: 500,
    clouds: comparisonClouds(comparison),
    boxes: [{ key: String(change.id), box: boxOfChange(change), kind: change.kind }],
    marks: marksOf(scan),
    focus: boxOfChange(change),
    ...(comparison.priors.length > 0
      ? {
          before: `Before: scan ${comparison.priors.map((prior) => prior.scan).join(', ')}`,
          after: `After: scan ${scan.id}, ${dateTime(scan.captured_at, zone)}`,
        }
      : {}),
  };
  return (
    <LazyStage
      spec={spec}
      label={`Change ${change.id} in 3D. The arrow keys turn it, with Shift they move it, plus and minus come nearer.`}
      looksAvailable={['frame', 'top', 'sensor']}
      looks={changeLooks(change, scan)}
      hasRays
      rays={evidence.data?.rays as readonly RayBundle[] | undefined}
    />
  );
}
