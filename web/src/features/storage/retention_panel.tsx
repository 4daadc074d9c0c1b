// For how long a site's scans are kept: set, and first looked at.

import { useState } from 'preact/hooks';
import { loader, showToast, useResource } from '../../app/app';
import { siteAt } from '../../app/sites';
import { type Schema, send } from '../../lib/api';
import { bytes, counted, count } from '../../lib/format';
import { type Resource } from '../../lib/resources';
import { EditForm, useEditing } from '../../ui/edit_form';
import { NumberField } from '../../ui/form';
import { Icon } from '../../ui/icon';
import { SitePicker } from '../../ui/site_picker';
import { Loaded } from '../../ui/states';
import { Time } from '../../ui/time';
import { draftOf, type LimitsDraft, limitsOf } from './limits';

type Site = Schema<'Site'>;
type Preview = NonNullable<Schema<'RetentionPreview'>['items']>[number];

export function RetentionPanel({ site, onSite }: { site: string; onSite: (site: string) => void }) {
  const resource = useResource(siteAt(site));
  return (
    <section class="panel" aria-labelledby="retention">
      <header class="panel-head">
        <h2 id="retention">How long scans are kept</h2>
        <span class="spacer" />
        <SitePicker site={site} onSite={onSite} />
      </header>
      <Loaded of={resource} what="site">
        {(data) => <RetentionForm key={resource.etag} site={data} resource={resource} />}
      </Loaded>
    </section>
  );
}

const kFields = [
  {
    key: 'max_age_days',
    field: 'max_age_days',
    label: 'Scans older than this go',
    unit: 'days after their receipt',
    step: 1,
  },
  { key: 'max_gb', field: 'max_bytes', label: 'Points of this site take at most', unit: 'GB', step: 'any' },
  { key: 'min_free_gb', field: 'min_free_bytes', label: 'Of the disk stay free', unit: 'GB', step: 'any' },
] as const;

function RetentionForm({ site, resource }: { site: Site; resource: Resource<Site> }) {
  const { draft, run, form } = useEditing<LimitsDraft>(() => draftOf(site.retention));
  const [preview, setPreview] = useState<Preview | undefined>();
  const look = (): void =>
    void run(async () => {
      const body = { site: site.name, ...limitsOf(draft) };
      const answer = await send('post', '/api/v1/storage/retention/preview', { body });
      setPreview(answer.data.items?.[0]);
    });
  const save = (): void =>
    void run(async () => {
      const body = { retention: limitsOf(draft) };
      const path = { name: site.name };
      loader.put(siteAt(site.name), await send('patch', '/api/v1/sites/{name}', { path, body, etag: resource.etag }));
      loader.invalidate((key) => key.startsWith('/api/v1/sites?') || key.startsWith('/api/v1/storage'));
      showToast('good', `What is kept of ${site.name} was changed.`);
    }, conflict);
  const conflict = (): void => {
    showToast('bad', `Somebody else has changed ${site.name} meanwhile; what is there now is shown.`);
    loader.invalidate((key) => key === siteAt(site.name));
  };
  return (
    <>
      <EditForm
        {...form}
        class="panel-body"
        notice={
          <p class="muted">
            An empty field is as configured for all sites, and 0 no such limit here. What is pinned, normal now, behind
            an open alert, or the first scan of a place is never deleted.
          </p>
        }
        onDraft={(changed) => {
          setPreview(undefined);
          form.onDraft(changed);
        }}
        onSave={save}
        actions={
          <button type="button" disabled={form.saving} onClick={look}>
            Show what would go
          </button>
        }
      >
        {(part) =>
          kFields.map(({ key, field, label, unit, step }) => {
            const tied = part.field(key, field);
            return (
              <NumberField
                key={key}
                label={label}
                unit={unit}
                min={0}
                step={step}
                placeholder="as configured"
                {...tied}
                error={tied.error ?? part.error(`retention.${field}`)}
              />
            );
          })
        }
      </EditForm>
      {preview && (
        <div class="panel-body">
          <PreviewNotice preview={preview} />
        </div>
      )}
    </>
  );
}

const kReasons = { age: 'for their age', bytes: 'for the room that points take', free_disk: 'to keep the disk free' };
const kProtected = {
  pinned: 'pinned',
  baseline: 'part of what is normal',
  alert: 'behind an open alert',
  evidence: 'what such a scan was compared with',
  unfinished: 'in a comparison that is not finished',
  survey: 'in an accepted epoch, or needed by a survey',
  anchor: 'what later poses are fitted onto',
};

function listed<Key extends string>(counts: Partial<Record<Key, number>>, words: Record<Key, string>): string {
  return (Object.keys(words) as Key[])
    .flatMap((key) => (counts[key] ? [`${count(counts[key] ?? 0)} ${words[key]}`] : []))
    .join(', ');
}

function PreviewNotice({ preview }: { preview: Preview }) {
  const stays = listed(preview.protected, kProtected);
  return (
    <div class={preview.scans > 0 ? 'notice notice-busy' : 'notice'} role="status">
      <Icon name="storage" />
      <div>
        <p>
          {preview.scans === 0 ? (
            <b>Nothing would go now.</b>
          ) : (
            <>
              <b>
                {counted(preview.scans, 'scan')} with {bytes(preview.bytes)} would go now
              </b>
              : {listed(preview.reasons, kReasons)}
              {preview.oldest_received_at !== null && preview.newest_received_at !== null && (
                <>
                  ; received from <Time at={preview.oldest_received_at} site={preview.site} /> to{' '}
                  <Time at={preview.newest_received_at} site={preview.site} />
                </>
              )}
              .
            </>
          )}
        </p>
        {stays !== '' && <p>Just as old, and kept all the same: {stays}.</p>}
        {!preview.reached && (
          <p>
            <b>The limit cannot be kept:</b> what is left is protected.
          </p>
        )}
      </div>
    </div>
  );
}
