// One rule: said in a sentence, edited, tried on the past, deleted. And a new one.

import { useState } from 'preact/hooks';
import { loader, navigate, showProblem, showToast, useResource, useSelect } from '../../app/app';
import { linkTo } from '../../app/router';
import { useSites } from '../../app/sites';
import { address, type Schema, send } from '../../lib/api';
import { Problem } from '../../lib/problem';
import { type Resource } from '../../lib/resources';
import { SeverityBadge, StateBadge } from '../../ui/badges';
import { DeleteDialog } from '../../ui/delete_dialog';
import { EditedElsewhere, useVersion, type Version } from '../../ui/edited_elsewhere';
import { SitePicker } from '../../ui/site_picker';
import { EmptyState, Loaded } from '../../ui/states';
import { Ago } from '../../ui/time';
import { useSaving } from '../../ui/use_saving';
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
  const [draft, setDraft] = useState(() => draftOf(base.data));
  const [asking, setAsking] = useState(false);
  const { saving, problem, run } = useSaving();
  const save = (body: Schema<'NewRule'>, etag: string | undefined): void =>
    void run(
      async () => {
        const answer = await send('put', '/api/v1/rules/{id}', { path: { id }, body, etag });
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
        site={site}
        zones={zones}
        draft={draft}
        onDraft={setDraft}
        problem={problem}
        saving={saving}
        onSave={(body) => save(body, base.etag)}
        notice={
          newer && (
            <EditedElsewhere
              differences={differencesOf(newer.data, bodyOf(draft, site), zoneName)}
              onTake={() => adopt(newer)}
              onKeep={() => save(bodyOf(draft, site), newer.etag)}
            />
          )
        }
        actions={
          <button type="button" onClick={() => setAsking(true)}>
            Delete …
          </button>
        }
      />
      <RehearsalPanel site={site} host={id} isOwn rule={bodyOf(draft, site)} />
      {asking && <DeleteRule rule={base.data} onClose={() => setAsking(false)} />}
    </div>
  );
}

function DeleteRule({ rule, onClose }: { rule: Rule; onClose: () => void }) {
  const remove = async (): Promise<void> => {
    try {
      await send('delete', '/api/v1/rules/{id}', { path: { id: rule.id } });
      listsAreOld();
      showToast('good', `The rule ${rule.name} was deleted.`);
      navigate(linkTo('/rules', { site: rule.site }));
    } catch (failure) {
      if (!(failure instanceof Problem)) throw failure;
      showProblem(failure);
      onClose();
    }
  };
  return (
    <DeleteDialog what={rule.name} onClose={onClose} onDelete={() => void remove()}>
      <p>It raises no alert any more. Alerts that it raised stay.</p>
    </DeleteDialog>
  );
}

export function NewRuleView() {
  const sites = useSites();
  const asked = useSelect((state) => state.location.query['site']);
  const [chosen, setChosen] = useState<string | undefined>(asked);
  const site = chosen ?? sites[0]?.name;
  return (
    <>
      <div class="view-head">
        <h1>New rule</h1>
        {site !== undefined && (
          <>
            <span class="muted">at {site}</span>
            <SitePicker site={site} onSite={setChosen} />
          </>
        )}
      </div>
      {site === undefined ? (
        <div class="panel">
          <EmptyState title="There is no site yet." />
        </div>
      ) : (
        <MakeRule key={site} site={site} />
      )}
    </>
  );
}

function MakeRule({ site }: { site: string }) {
  const zones = useZones(site);
  const zone = useSelect((state) => state.location.query['zone']);
  const rules = useResource(address('/api/v1/rules', { query: { site, limit: 1 } }));
  const [draft, setDraft] = useState({ ...newDraft, zone: zone ?? '' });
  const { saving, problem, run } = useSaving();
  const make = (body: Schema<'NewRule'>): void =>
    void run(async () => {
      const answer = await send('post', '/api/v1/rules', { body });
      listsAreOld();
      showToast('good', `The rule ${answer.data.name} is there. It takes effect with the next scan.`);
      navigate(`/rules/${answer.data.id}`);
    });
  return (
    <div class="rule-editor">
      <RuleForm
        site={site}
        zones={zones}
        draft={draft}
        onDraft={setDraft}
        problem={problem}
        saving={saving}
        onSave={make}
      />
      <RehearsalPanel site={site} host={rules.data?.items[0]?.id} isOwn={false} rule={bodyOf(draft, site)} />
    </div>
  );
}
