// One scan: where and when it was taken, how its pose fits, what comparisons found, and why its priors were chosen.

import './scans.css';
import { useResource } from '../../app/app';
import { type Schema } from '../../lib/api';
import { bytes, count, counted, degrees, metres, percent, placeMetres } from '../../lib/format';
import { Icon } from '../../ui/icon';
import { Loaded } from '../../ui/states';
import { Time } from '../../ui/time';
import { ViewLink } from '../../ui/view_link';
import { ScanPanorama } from '../panorama/scan_panorama';
import { RegistrationBadge, ScanStateBadge } from './badges';
import { Comparisons } from './comparisons';
import { Keeping, scanAddress } from './keeping';

type Scan = Schema<'Scan'>;

export function ScanView({ id }: { id: string }) {
  const scan = useResource(scanAddress(Number(id)));
  return (
    <Loaded of={scan} what="scan">
      {(data) => (
        <>
          <div class="view-head">
            <h1>Scan {data.id}</h1>
            <ScanStateBadge scan={data} />
            <span class="muted">
              by <ViewLink to={`/sensors/${encodeURIComponent(data.sensor)}`}>{data.sensor}</ViewLink> at {data.site},{' '}
              <Time at={data.captured_at} site={data.site} whole />
            </span>
            <span class="spacer" />
            <a class="button" href={`/scans/${data.id}/3d`}>
              <Icon name="change" /> Show in 3D
            </a>
          </div>
          <div class="panels">
            <Facts scan={data} />
            <Keeping key={data.id} scan={data} resource={scan} />
            <ScanPanorama scan={data} />
            <Comparisons scan={data} />
          </div>
        </>
      )}
    </Loaded>
  );
}

function Facts({ scan }: { scan: Scan }) {
  const { registration } = scan;
  return (
    <section class="panel" aria-labelledby="facts">
      <header class="panel-head">
        <h2 id="facts">What was taken</h2>
      </header>
      <dl class="figures panel-body">
        <div>
          <dt>Points</dt>
          <dd>
            {counted(scan.points, 'point')}
            {scan.intensity && ', with intensity'}
          </dd>
        </div>
        {scan.grid && (
          <div>
            <dt>Grid of shots</dt>
            <dd>
              {count(scan.grid.rows)} × {count(scan.grid.columns)}
            </dd>
          </div>
        )}
        <div>
          <dt>Kept in</dt>
          <dd>{bytes(scan.stored_bytes)}</dd>
        </div>
        <div>
          <dt>Received</dt>
          <dd>
            <Time at={scan.received_at} site={scan.site} />
          </dd>
        </div>
        <div>
          <dt>Taken from</dt>
          <dd>
            {placeMetres(scan.pose.position_m)}, vantage {scan.vantage}
          </dd>
        </div>
        <div>
          <dt>Fit of its pose</dt>
          <dd>
            <RegistrationBadge registration={registration} />{' '}
            {registration.against !== null && (
              <>
                on <a href={`/scans/${registration.against}`}>scan {registration.against}</a>
              </>
            )}
          </dd>
        </div>
        {registration.state !== 'none' && (
          <div>
            <dt>Corrected by</dt>
            <dd>
              {metres(registration.shift_m, 4)}, {degrees(registration.turn_deg, 4)}
            </dd>
          </div>
        )}
        {registration.inliers !== null && (
          <div>
            <dt>Surfaces that agree</dt>
            <dd>
              {percent(registration.inliers, 1)}
              {registration.residual_m !== null && `, to ${metres(registration.residual_m, 4)}`}
            </dd>
          </div>
        )}
        <div>
          <dt>SHA-256 of the file</dt>
          <dd>
            <code title={scan.sha256}>{scan.sha256.slice(0, 16)}…</code>
          </dd>
        </div>
        <div>
          <dt>The raw observation</dt>
          <dd class="actions">
            {(['pcd', 'ply', 'csv'] as const).map((format) => (
              <a
                key={format}
                href={`/api/v1/scans/${scan.id}/points?format=${format}`}
                download={`scan-${scan.id}.${format}`}
              >
                {format.toUpperCase()}
              </a>
            ))}
          </dd>
        </div>
      </dl>
      {scan.failure !== null && <p class="panel-body scan-failure">{scan.failure}</p>}
    </section>
  );
}
