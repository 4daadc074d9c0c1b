// Planned work that is said beforehand: of what, until when, and why.

import { loader, store, useResource } from '../../app/app';
import { withOperator } from '../../app/operator';
import { useSites, useZone } from '../../app/sites';
import { address, send } from '../../lib/api';
import { localOf, momentOf } from '../../lib/zone';
import { Dialog } from '../../ui/dialog';
import { EditForm, useEditing } from '../../ui/edit_form';
import { NoteField, SelectField, TextField } from '../../ui/form';

export const silencesAreOld = (): void => loader.invalidate((key) => key.startsWith('/api/v1/silences'));

/** What is left empty is as it is offered: the first site, two hours from now. */
interface SilenceDraft {
  readonly site: string;
  /** "sensor:NAME", "zone:ID", or all of the site. */
  readonly of: string;
  /** On the clock of the site. */
  readonly until: string;
  readonly note: string;
}

export function NewSilence({ onClose }: { onClose: () => void }) {
  const sites = useSites();
  const { draft, run, form } = useEditing<SilenceDraft>({ site: '', of: '', until: '', note: '' });
  const site = draft.site || (sites[0]?.name ?? '');
  const time_zone = useZone(site);
  const sensors = useResource(address('/api/v1/sensors', { query: { site, limit: 1000 } })).data?.items ?? [];
  const zones = useResource(address('/api/v1/zones', { query: { site, limit: 1000 } })).data?.items ?? [];
  const until = draft.until || localOf(new Date(store.state().now_ms + 2 * 3_600_000), time_zone);
  const make = (by: string): Promise<void> => {
    const [kind, ...name] = draft.of.split(':');
    return run(async () => {
      await send('post', '/api/v1/silences', {
        body: {
          site,
          by,
          until: momentOf(until, time_zone).toISOString(),
          ...(kind === 'sensor' ? { sensor: name.join(':') } : {}),
          ...(kind === 'zone' ? { zone: Number(name[0]) } : {}),
          ...(draft.note === '' ? {} : { note: draft.note }),
        },
      });
      silencesAreOld();
      onClose();
    });
  };
  return (
    <Dialog title="New silence" onClose={onClose}>
      <EditForm
        {...form}
        class=""
        words="Keep silent"
        onSave={() => withOperator((by) => void make(by))}
        actions={
          <button type="button" onClick={onClose}>
            Cancel
          </button>
        }
      >
        {({ field }) => (
          <>
            <SelectField
              label="Site"
              first
              options={sites.map(({ name }) => ({ value: name, words: name }))}
              {...field('site')}
              value={site}
            />
            <SelectField
              label="What of it"
              options={[
                { value: '', words: 'all of it' },
                ...sensors.map(({ name }) => ({ value: `sensor:${name}`, words: `sensor ${name}` })),
                ...zones.map(({ id, name }) => ({ value: `zone:${id}`, words: `zone ${name}` })),
              ]}
              {...field('of', 'sensor')}
            />
            <TextField type="datetime-local" label={`Until (${time_zone})`} {...field('until')} value={until} />
            <NoteField label="Why" {...field('note')} />
          </>
        )}
      </EditForm>
    </Dialog>
  );
}
