import { type Schema } from '../../lib/api';
import { counted, percent, placeMetres, sizeMetres, volume } from '../../lib/format';
import { ViewLink } from '../../ui/view_link';

type Change = Schema<'Change'>;

export interface ChangeFiguresProps {
  change: Change;
  comparison: Schema<'Comparison'> | undefined;
  scan: Schema<'Scan'> | undefined;
}

/** What is known of a change in numbers, and where it leads. */
export function ChangeFigures({ change, comparison, scan }: ChangeFiguresProps) {
  const { confidence } = change;
  const facts: readonly (readonly [string, string])[] = [
    ['Size', sizeMetres(change.size_m)],
    ['Volume of its box', volume(change.volume_m3)],
    ['Place', placeMetres(change.centroid_m)],
    ['Points', counted(change.points, 'point')],
    ['Confidence', percent(confidence.value)],
    ['Priors that saw it free', percent(confidence.free)],
    ['Priors that supported it', percent(confidence.supported)],
    ['Priors that could not tell', percent(confidence.unknown)],
  ];
  return (
    <section class="panel" aria-labelledby="figures">
      <header class="panel-head">
        <h2 id="figures">Figures</h2>
      </header>
      <dl class="figures panel-body">
        {facts.map(([name, value]) => (
          <div key={name}>
            <dt>{name}</dt>
            <dd>{value}</dd>
          </div>
        ))}
      </dl>
      <ul class="change-links panel-body">
        <li>
          Found in <ViewLink to={`/scans/${change.scan}`}>scan {change.scan}</ViewLink>
          {scan && (
            <>
              {' '}
              by <ViewLink to={`/sensors/${encodeURIComponent(scan.sensor)}`}>{scan.sensor}</ViewLink>
            </>
          )}
        </li>
        {comparison && <Priors change={change} comparison={comparison} />}
        <li>
          <a href={`/comparisons/${change.comparison}/3d`}>All changes of the comparison in 3D</a>
        </li>
        {change.track !== null && (
          <li>
            <ViewLink to={`/tracks/${change.track}`}>Track {change.track}: the change through time</ViewLink>
          </li>
        )}
        <li>
          <ViewLink to={`/history?site=${encodeURIComponent(change.site)}&point=${change.centroid_m.join(',')}`}>
            This place through time
          </ViewLink>
        </li>
      </ul>
    </section>
  );
}

/** The scans before, and how many of the comparison's changed points each of them speaks for. */
function Priors({ change, comparison }: { change: Change; comparison: Schema<'Comparison'> }) {
  return (
    <>
      {comparison.priors.map((prior) => (
        <li key={prior.scan}>
          Compared with <ViewLink to={`/scans/${prior.scan}`}>scan {prior.scan}</ViewLink>
          <span class="muted">
            , {percent(prior.overlap)} overlap
            {change.kind === 'removed' && `, ${counted(prior.removed, 'removed point')}`}
          </span>
        </li>
      ))}
    </>
  );
}
