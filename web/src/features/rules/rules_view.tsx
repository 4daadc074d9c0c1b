import './rules.css';
import { setQuery, useResource, useSelect } from '../../app/app';
import { linkTo } from '../../app/router';
import { useChosenSite } from '../../app/sites';
import { address, type Schema } from '../../lib/api';
import { SeverityBadge, StateBadge } from '../../ui/badges';
import { type Column, DataTable } from '../../ui/data_table';
import { SitePicker } from '../../ui/site_picker';
import { AtSite } from '../../ui/at_site';
import { EmptyPanel } from '../../ui/states';
import { Ago } from '../../ui/time';
import { ruleSentence } from './rule_words';

type Rule = Schema<'Rule'>;

function useColumns(site: string | undefined): readonly Column<Rule>[] {
  const page = useResource(site === undefined ? undefined : address('/api/v1/zones', { query: { site, limit: 1000 } }));
  const zoneName = (zone: number | null): string | undefined => page.data?.items.find(({ id }) => id === zone)?.name;
  return [
    { head: 'Rule', cell: ({ id, name }) => <a href={`/rules/${id}`}>{name}</a> },
    { head: 'Severity', cell: ({ severity }) => <SeverityBadge severity={severity} /> },
    {
      head: 'In force',
      cell: ({ enabled }) => (enabled ? <StateBadge tone="good">yes</StateBadge> : <StateBadge>no</StateBadge>),
    },
    { head: 'Says', cell: (rule) => ruleSentence(rule, zoneName(rule.zone)), essential: false },
    { head: 'Edited', cell: ({ edited_at, site: at }) => <Ago at={edited_at} site={at} />, essential: false },
  ];
}

export function RulesView() {
  const query = useSelect((state) => state.location.query);
  const site = useChosenSite();
  const page = useResource(
    site === undefined ? undefined : address('/api/v1/rules', { query: { site, cursor: query['cursor'], limit: 200 } }),
  );
  const columns = useColumns(site);
  return (
    <>
      <div class="view-head">
        <h1>Rules</h1>
        <span class="muted">what raises an alert</span>
        <span class="spacer" />
        <a class="button primary" href={linkTo('/rules/new', { site })}>
          New rule
        </a>
      </div>
      <AtSite site={site}>
        {(name) => (
          <DataTable
            caption={`rules of ${name}`}
            page={page}
            columns={columns}
            rowKey={({ id }) => id}
            searchText={({ name, severity }) => `${name} ${severity}`}
            filters={<SitePicker site={name} onSite={(chosen) => setQuery({ site: chosen, cursor: undefined })} />}
            empty={
              <EmptyPanel title="No rule: nothing that changes raises an alert here.">
                <a href={linkTo('/rules/new', { site: name })}>Make one</a>
              </EmptyPanel>
            }
          />
        )}
      </AtSite>
    </>
  );
}
