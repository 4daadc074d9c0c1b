// One site: what is known of it, and in which coordinates its results go out.

import { useResource } from '../../app/app';
import { linkTo } from '../../app/router';
import { siteAt } from '../../app/sites';
import { type Schema } from '../../lib/api';
import { placeMetres } from '../../lib/format';
import { Loaded } from '../../ui/states';
import { Time } from '../../ui/time';
import { CoordinatesPanel } from './coordinates_panel';

export function SiteView({ name }: { name: string }) {
  const site = useResource(siteAt(name));
  return (
    <Loaded of={site} what="site">
      {(data) => (
        <>
          <div class="view-head">
            <h1>{name}</h1>
            <span class="muted">
              site, made <Time at={data.created_at} site={name} />
            </span>
          </div>
          <div class="panels">
            <Facts site={data} />
            <CoordinatesPanel key={name} resource={{ ...site, data }} />
          </div>
        </>
      )}
    </Loaded>
  );
}

function Facts({ site: { name, profile, time_zone, origin_m } }: { site: Schema<'Site'> }) {
  const about = { site: name };
  return (
    <section class="panel" aria-labelledby="facts">
      <header class="panel-head">
        <h2 id="facts">What is known of it</h2>
      </header>
      <div class="panel-body">
        <dl class="figures">
          <div>
            <dt>Profile</dt>
            <dd>{profile}</dd>
          </div>
          <div>
            <dt>Time zone</dt>
            <dd>{time_zone}</dd>
          </div>
          <div>
            <dt>Measured from</dt>
            <dd>{origin_m ? placeMetres(origin_m) : 'where its first scan is'}</dd>
          </div>
        </dl>
        <div class="actions">
          <a href={linkTo('/sensors', about)}>Its sensors</a>
          <a href={linkTo('/zones', about)}>Its zones</a>
          <a href={linkTo('/surveys', about)}>Its surveys</a>
          <a href={linkTo('/storage', about)}>How long its scans are kept</a>
        </div>
      </div>
    </section>
  );
}
