// One rule: said in a sentence, edited, tried on the past, deleted. And a new one.

import { useState } from 'preact/hooks';
import { loader, navigate, showToast, useResource, useSelect } from '../../app/app';
import { linkTo } from '../../app/router';
import { useChosenSite } from '../../app/sites';
import { address, type Schema, send } from '../../lib/api';
import { type Resource } from '../../lib/resources';
import { SeverityBadge, StateBadge } from '../../ui/badges';
import { NewAtSite } from '../../ui/at_site';
import { DeleteButton, DeleteDialog } from '../../ui/delete_dialog';
import { useEditing } from '../../ui/edit_form';
import { EditedElsewhere, useVersion, type Version } from '../../ui/edited_elsewhere';
import { Loaded } from '../../ui/states';
import { Ago } from '../../ui/time';
import { bodyOf, differencesOf, draftOf, newDraft } from './draft';
import { RehearsalPanel } from './rehearsal_panel';
import { RuleForm } from './rule_form';

type Rule = Schema<'Rule'>;

const addressOf = (id: number) => address('/api/v1/rules/{id}', { path: { id } });
const listsAreOld = (): void => loader.invalidate((key) => key.startsWith('/api/v1/rules?'));

const useZones = (site: string): readonly Schema<'Zone'>[] =>
  useResource(address('/api/v1/zones', { query: { site, limit: 1000 } })).data?.items ?? [];

export function RuleView({ id }: { id: string }) {
  const rule = useResource(addressOf(Number(id)));
  return (
    <Loaded of={rule} what="rule">
      {(data) => <OneRule key={data.id} resource={{ ...rule, data }} />}
    </Loaded>
  );
}

function OneRule({ resource }: { resource: Resource<Rule> & { data: Rule } }) {
  const { base, newer, adopt } = useVersion(resource);
  const rule = resource.data;
  return (
    <>
      <div class="view-head">
        <h1>{rule.name}</h1>
        <SeverityBadge severity={rule.severity} />
        {!rule.enabled && <StateBadge>not in force</StateBadge>}
        <span class="muted">
          rule at {rule.site}, edited <Ago at={rule.edited_at} site={rule.site} />
        </span>
      </div>
      <EditRule key={base.etag} base={base} newer={newer} adopt={adopt} />
    </>
  );
}

interface EditRuleProps {
  base: Version<Rule>;
  newer: Version<Rule> | undefined;
  adopt: (version: Version<Rule>) => void;
}

function EditRule({ base, newer, adopt }: EditRuleProps) {
  const { id, site } = base.data;
  const zones = useZones(site);
  const { draft, run, form } = useEditing(() => draftOf(base.data));
  const [asking, setAsking] = useState(false);
  const mine = bodyOf(draft, site);
  const save = (etag: string | undefined): void =>
    void run(
      async () => {
        const answer = await send('put', '/api/v1/rules/{id}', { path: { id }, body: mine, etag });
        loader.put(addressOf(id), answer);
        adopt(answer);
        listsAreOld();
        showToast('good', `${answer.data.name} was changed. It takes effect with the next scan.`);
      },
      () => loader.invalidate((key) => key === addressOf(id)),
    );
  const zoneName = (zone: number | null | undefined): string | undefined =>
    zones.find((each) => each.id === zone)?.name;
  return (
    <div class="rule-editor">
      <RuleForm
        {...form}
        site={site}
        zones={zones}
        onSave={() => save(base.etag)}
        notice={
          newer && (
            <EditedElsewhere
              differences={differencesOf(newer.data, mine, zoneName)}
              onTake={() => adopt(newer)}
              onKeep={() => save(newer.etag)}
            />
          )
        }
        actions={<DeleteButton onAsk={() => setAsking(true)} />}
      />
      <RehearsalPanel site={site} host={id} isOwn rule={mine} />
      {asking && <DeleteRule rule={base.data} onClose={() => setAsking(false)} />}
    </div>
  );
}

function DeleteRule({ rule: { id, name, site }, onClose }: { rule: Rule; onClose: () => void }) {
  const remove = async (): Promise<void> => {
    await send('delete', '/api/v1/rules/{id}', { path: { id } });
    listsAreOld();
    showToast('good', `The rule ${name} was deleted.`);
    navigate(linkTo('/rules', { site }));
  };
  return (
    <DeleteDialog what={`the rule ${name}`} onClose={onClose} onDelete={remove}>
      <p>It raises no alert any more. Alerts that it raised stay.</p>
    </DeleteDialog>
  );
}

export const NewRuleView = () => (
  <NewAtSite title="New rule" site={useChosenSite()}>
    {(site) => <MakeRule site={site} />}
  </NewAtSite>
);

function MakeRule({ site }: { site: string }) {
  const zones = useZones(site);
  const zone = useSelect((state) => state.location.query['zone']);
  const rules = useResource(address('/api/v1/rules', { query: { site, limit: 1 } }));
  const { draft, run, form } = useEditing({ ...newDraft, zone: zone ?? '' });
  const mine = bodyOf(draft, site);
  const make = (): void =>
    void run(async () => {
      const answer = await send('post', '/api/v1/rules', { body: mine });
      listsAreOld();
      showToast('good', `The rule ${answer.data.name} is there. It takes effect with the next scan.`);
      navigate(`/rules/${answer.data.id}`);
    });
  return (
    <div class="rule-editor">
      <RuleForm {...form} site={site} zones={zones} onSave={make} />
      <RehearsalPanel site={site} host={rules.data?.items[0]?.id} isOwn={false} rule={mine} />
    </div>
  );
}
