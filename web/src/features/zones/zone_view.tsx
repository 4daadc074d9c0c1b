// One zone: edited, seen through time, deleted. And a new one.

import './zones.css';
import { useState } from 'preact/hooks';
import { loader, navigate, showToast, useResource } from '../../app/app';
import { lazy } from '../../app/lazy';
import { linkTo } from '../../app/router';
import { useChosenSite } from '../../app/sites';
import { address, type Answer, type Schema, send } from '../../lib/api';
import { counted } from '../../lib/format';
import { type Resource } from '../../lib/resources';
import { StateBadge } from '../../ui/badges';
import { NewAtSite } from '../../ui/at_site';
import { DeleteButton, DeleteDialog } from '../../ui/delete_dialog';
import { EditedElsewhere, useVersion } from '../../ui/edited_elsewhere';
import { Loaded } from '../../ui/states';
import { Ago } from '../../ui/time';
import { useSaving } from '../../ui/use_saving';
import { ViewLink } from '../../ui/view_link';
import { differencesOf, draftOf, emptyDraft } from './draft';
import { extentInWords } from './extent_words';
import { placesOf } from './overlays';
import { ZoneEditor } from './zone_editor';

type Zone = Schema<'Zone'>;

const addressOf = (id: number) => address('/api/v1/zones/{id}', { path: { id } });
const isListOfZones = (key: string): boolean => key.startsWith('/api/v1/zones?');
const listsAreOld = (): void => loader.invalidate(isListOfZones);

const CoveragePanel = lazy(() => import('./coverage_panel').then((module) => module.CoveragePanel));

export function ZoneView({ id }: { id: string }) {
  const zone = useResource(addressOf(Number(id)));
  return (
    <Loaded of={zone} what="zone">
      {(data) => <OneZone key={data.id} resource={{ ...zone, data }} />}
    </Loaded>
  );
}

function OneZone({ resource }: { resource: Resource<Zone> & { data: Zone } }) {
  const { base, newer, adopt } = useVersion(resource);
  const { saving, problem, run } = useSaving();
  const [asking, setAsking] = useState(false);
  const zone = resource.data;
  const save = (body: Schema<'ZoneEdit'>, etag: string | undefined): void =>
    void run(
      async () => {
        const answer = await send('put', '/api/v1/zones/{id}', { path: { id: zone.id }, body, etag });
        loader.put(addressOf(zone.id), answer);
        adopt(answer);
        listsAreOld();
        showToast('good', `${answer.data.name} was changed. It takes effect with the next scan.`);
      },
      () => loader.invalidate((key) => key === addressOf(zone.id)),
    );
  return (
    <>
      <div class="view-head">
        <h1>{zone.name}</h1>
        <StateBadge>{zone.kind}</StateBadge>
        <span class="muted">
          zone at {zone.site}, {extentInWords(zone)}, edited <Ago at={zone.edited_at} site={zone.site} />
        </span>
      </div>
      <ZoneEditor
        key={base.etag}
        site={zone.site}
        id={zone.id}
        initial={draftOf(base.data)}
        corners={placesOf(base.data)}
        problem={problem}
        saving={saving}
        onSave={(body) => save(body, base.etag)}
        notice={(mine) =>
          newer && (
            <EditedElsewhere
              differences={differencesOf(newer.data, mine)}
              onTake={() => adopt(newer)}
              onKeep={() => save(mine, newer.etag)}
            />
          )
        }
        actions={<DeleteButton onAsk={() => setAsking(true)} />}
      />
      <CoveragePanel zone={zone} />
      {asking && <DeleteZone zone={zone} onClose={() => setAsking(false)} />}
    </>
  );
}

/** Which rules look into it: it cannot go before they do. */
function DeleteZone({ zone, onClose }: { zone: Zone; onClose: () => void }) {
  const rules = useResource(address('/api/v1/rules', { query: { site: zone.site, limit: 1000 } }));
  const users = rules.data?.items.filter((rule) => rule.zone === zone.id);
  const remove = async (): Promise<void> => {
    await send('delete', '/api/v1/zones/{id}', { path: { id: zone.id } });
    loader.forget(isListOfZones);
    showToast('good', `The zone ${zone.name} was deleted.`);
    navigate(linkTo('/zones', { site: zone.site }));
  };
  return (
    <DeleteDialog what={`the zone ${zone.name}`} onClose={onClose} onDelete={users?.length === 0 ? remove : undefined}>
      {!users ? (
        <p class="muted">Asking which rules look into it …</p>
      ) : users.length === 0 ? (
        <p>No rule looks into it. Alerts that it raised stay.</p>
      ) : (
        <>
          <p>
            {counted(users.length, 'rule looks', 'rules look')} into it. Have {users.length === 1 ? 'it' : 'them'} look
            elsewhere first, or delete {users.length === 1 ? 'it' : 'them'}:
          </p>
          <ul class="bullets">
            {users.map((rule) => (
              <li key={rule.id}>
                <ViewLink to={`/rules/${rule.id}`}>{rule.name}</ViewLink>
              </li>
            ))}
          </ul>
        </>
      )}
    </DeleteDialog>
  );
}

export const NewZoneView = () => (
  <NewAtSite title="New zone" site={useChosenSite()}>
    {(site) => <MakeZone site={site} />}
  </NewAtSite>
);

function MakeZone({ site }: { site: string }) {
  const { saving, problem, run } = useSaving();
  const make = (body: Schema<'ZoneEdit'>): void =>
    void run(async () => {
      const answer: Answer<Zone> = await send('post', '/api/v1/zones', { body: { ...body, site } });
      listsAreOld();
      showToast('good', `The zone ${answer.data.name} is there. It takes effect with the next scan.`);
      navigate(`/zones/${answer.data.id}`);
    }, listsAreOld);
  return <ZoneEditor site={site} initial={emptyDraft} problem={problem} saving={saving} onSave={make} />;
}
