// Why an alert was raised: the rule as it was then, the change's figures, who saw it, and what it was compared with.

import { type Schema } from '../../lib/api';
import { count, counted, duration, percent, placeMetres, sizeMetres, volume } from '../../lib/format';
import { historyLink, pointPlace } from '../../lib/place';
import { KindBadge } from '../../ui/badges';
import { Icon } from '../../ui/icon';
import { SightStrip } from '../../ui/sight_strip';
import { Time } from '../../ui/time';
import { ViewLink } from '../../ui/view_link';
import { AlertPicture } from './alert_picture';
import { ruleInWords } from './rule_words';

type Reason = Schema<'AlertReason'>;

export function Why({ alert, why }: { alert: Schema<'Alert'>; why: Reason }) {
  return (
    <>
      <section class="alert-part">
        <h3>Why</h3>
        <p>
          By the rule{' '}
          <b>
            {alert.rule === null ? why.rule.name : <ViewLink to={`/rules/${alert.rule}`}>{why.rule.name}</ViewLink>}
          </b>
          : {ruleInWords(why.rule)}.
        </p>
        <Figures alert={alert} track={why.track} />
        <p class="actions">
          {why.changes.map((change) => (
            <a key={change} class="button" href={`/changes/${change}`}>
              <Icon name="change" /> {why.changes.length === 1 ? 'Show in 3D' : `Change ${change} in 3D`}
            </a>
          ))}
          <a href={`/tracks/${why.track.id}`}>Track {why.track.id}</a>
          <a href={historyLink(alert.site, pointPlace(why.track.centroid_m))}>History of this place</a>
        </p>
      </section>
      {why.changes[0] !== undefined && <AlertPicture change={why.changes[0]} />}
      <section class="alert-part">
        <h3>Who saw it</h3>
        <SightStrip observations={why.observations} site={alert.site} />
        {why.priors.length > 0 && (
          <p class="muted">
            Compared with{' '}
            {[...why.priors]
              .sort((one, other) => one - other)
              .map((scan, index) => (
                <span key={scan}>
                  {index > 0 && ', '}
                  <ViewLink to={`/scans/${scan}`}>scan {scan}</ViewLink>
                </span>
              ))}
            {alert.scan !== null && (
              <>
                ; opened by <ViewLink to={`/scans/${alert.scan}`}>scan {alert.scan}</ViewLink>
              </>
            )}
            .
          </p>
        )}
      </section>
    </>
  );
}

function Figures({ alert, track }: { alert: Schema<'Alert'>; track: Schema<'Track'> }) {
  return (
    <dl class="figures">
      <div>
        <dt>Kind</dt>
        <dd>
          <KindBadge kind={track.kind} />
        </dd>
      </div>
      <div>
        <dt>Size</dt>
        <dd>{sizeMetres(track.size_m)}</dd>
      </div>
      <div>
        <dt>Volume of its box</dt>
        <dd>{volume(track.volume_m3)}</dd>
      </div>
      <div>
        <dt>Place</dt>
        <dd>{placeMetres(track.centroid_m)}</dd>
      </div>
      <div>
        <dt>Points</dt>
        <dd>{counted(track.points, 'point')}</dd>
      </div>
      <div>
        <dt>Confidence</dt>
        <dd
          title={`seen free ${percent(track.confidence.free)}, supported ${percent(track.confidence.supported)}, could not tell ${percent(track.confidence.unknown)}`}
        >
          {percent(track.confidence.value)}
        </dd>
      </div>
      <div>
        <dt>First seen</dt>
        <dd>
          <Time at={track.first_seen_at} site={alert.site} />
        </dd>
      </div>
      <div>
        <dt>Last seen</dt>
        <dd>
          <Time at={track.last_seen_at} site={alert.site} />
        </dd>
      </div>
      <div>
        <dt>Lasted</dt>
        <dd>
          {duration((Date.parse(track.last_seen_at) - Date.parse(track.first_seen_at)) / 1000)}, in{' '}
          {counted(track.seen, 'scan')}
          {track.absent > 0 && `; absent in ${count(track.absent)}`}
        </dd>
      </div>
    </dl>
  );
}
