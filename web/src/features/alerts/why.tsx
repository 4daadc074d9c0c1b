// Why an alert was raised: the rule as it was then, the change's figures, who saw it, and what it was compared with.

import { type Schema } from '../../lib/api';
import { historyLink, pointPlace } from '../../lib/place';
import { KindBadge } from '../../ui/badges';
import { Icon } from '../../ui/icon';
import { SightStrip } from '../../ui/sight_strip';
import { Time } from '../../ui/time';
import { TrackFigures } from '../../ui/track_figures';
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
      <TrackFigures track={track} />
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
    </dl>
  );
}
