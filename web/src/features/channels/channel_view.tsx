// One channel: edited, tried, with what it sent last. And a new one.

import './channels.css';
import { useState } from 'preact/hooks';
import { loader, navigate, setQuery, showToast, useResource, useSelect } from '../../app/app';
import { withOperator } from '../../app/operator';
import { address, ask, type Schema, send } from '../../lib/api';
import { count } from '../../lib/format';
import { type Resource } from '../../lib/resources';
import { StateBadge } from '../../ui/badges';
import { DeleteButton, DeleteDialog } from '../../ui/delete_dialog';
import { useEditing } from '../../ui/edit_form';
import { EditedElsewhere, useVersion, type Version } from '../../ui/edited_elsewhere';
import { Icon } from '../../ui/icon';
import { Loaded } from '../../ui/states';
import { Ago } from '../../ui/time';
import { useSaving } from '../../ui/use_saving';
import { ChannelForm } from './channel_form';
import { ChannelState } from './channel_state';
import { DeliveryTable } from './delivery_table';
import { bodyOf, differencesOf, draftOf, newDraft } from './draft';

type Channel = Schema<'Channel'>;

const addressOf = (id: number) => address('/api/v1/channels/{id}', { path: { id } });
const listsAreOld = (): void =>
  loader.invalidate((key) => key.startsWith('/api/v1/channels?') || key.startsWith('/api/v1/deliveries'));

export function ChannelView({ id }: { id: string }) {
  const channel = useResource(addressOf(Number(id)));
  return (
    <Loaded of={channel} what="channel">
      {(data) => <OneChannel key={data.id} resource={{ ...channel, data }} />}
    </Loaded>
  );
}

function OneChannel({ resource }: { resource: Resource<Channel> & { data: Channel } }) {
  const { base, newer, adopt } = useVersion(resource);
  const channel = resource.data;
  return (
    <>
      <div class="view-head">
        <h1>{channel.name}</h1>
        <StateBadge>{channel.kind}</StateBadge>
        <ChannelState channel={channel} />
        <span class="muted">
          edited by {channel.by} <Ago at={channel.edited_at} site={channel.site ?? undefined} />
        </span>
      </div>
      <div class="channel-editor">
        <EditChannel key={base.etag} base={base} newer={newer} adopt={adopt} />
        <div class="channel-side">
          <Trial channel={channel} />
          <section class="panel" aria-labelledby="latest">
            <header class="panel-head">
              <h2 id="latest">Sent last</h2>
              <span class="spacer" />
              <a href={`/deliveries?channel=${channel.id}`}>All of them</a>
            </header>
            <div class="panel-body">
              <DeliveryTable channel={channel.id} limit={8} />
            </div>
          </section>
        </div>
      </div>
    </>
  );
}

interface EditChannelProps {
  base: Version<Channel>;
  newer: Version<Channel> | undefined;
  adopt: (version: Version<Channel>) => void;
}

/** What changes without anybody editing: whether messages arrive. */
const isEdited = (base: Version<Channel>, newer: Version<Channel>): boolean =>
  base.data.edited_at !== newer.data.edited_at;

function EditChannel({ base, newer, adopt }: EditChannelProps) {
  const { id, name } = base.data;
  const { draft, run, form } = useEditing(() => draftOf(base.data));
  const [asking, setAsking] = useState(false);
  const edited = newer && isEdited(base, newer) ? newer : undefined;
  const save = (expected: Version<Channel>): void =>
    withOperator((by) => {
      void run(async () => {
        // Its state is another version, too; only what somebody edited stands in the way.
        const now = await ask(addressOf(id));
        if (now && now.data.edited_at !== expected.data.edited_at) return loader.put(addressOf(id), now);
        const path = { id };
        const answer = await send('put', '/api/v1/channels/{id}', { path, body: bodyOf(draft, by), etag: now?.etag });
        loader.put(addressOf(id), answer);
        adopt(answer);
        listsAreOld();
        showToast('good', `${answer.data.name} was changed. What waits is sent by the new settings.`);
      });
    });
  const remove = async (): Promise<void> => {
    await send('delete', '/api/v1/channels/{id}', { path: { id } });
    listsAreOld();
    showToast('good', `The channel ${name} was deleted.`);
    navigate('/channels');
  };
  return (
    <>
      <ChannelForm
        {...form}
        channel={base.data}
        onSave={() => save(base)}
        notice={
          edited && (
            <EditedElsewhere
              differences={differencesOf(draftOf(edited.data), draft)}
              onTake={() => adopt(edited)}
              onKeep={() => save(edited)}
            />
          )
        }
        actions={<DeleteButton onAsk={() => setAsking(true)} />}
      />
      {asking && (
        <DeleteDialog what={`the channel ${name}`} onClose={() => setAsking(false)} onDelete={remove}>
          <p>What still waits for it is dropped, and nobody is told by it any more.</p>
        </DeleteDialog>
      )}
    </>
  );
}

/** Sends a message at once and says what happened. */
function Trial({ channel }: { channel: Channel }) {
  const [result, setResult] = useState<Schema<'ChannelTest'> | undefined>();
  const { saving, problem, run } = useSaving();
  const test = (): void =>
    void run(async () => {
      setResult(undefined);
      setResult((await send('post', '/api/v1/channels/{id}/test', { path: { id: channel.id } })).data);
      loader.invalidate((key) => key.startsWith('/api/v1/channels'));
    });
  return (
    <section class="panel" aria-labelledby="trial">
      <header class="panel-head">
        <h2 id="trial">Try it</h2>
      </header>
      <div class="panel-body channel-side">
        <p class="muted">Sends a message of the type “test” at once, by the settings as they are saved.</p>
        <div class="actions">
          <button type="button" disabled={saving} onClick={test}>
            {saving ? 'Sending …' : 'Send a test'}
          </button>
        </div>
        {problem && (
          <p class="field-bad" role="alert">
            {problem.title}. {problem.message}
          </p>
        )}
        {result && <TrialResult result={result} />}
      </div>
    </section>
  );
}

function TrialResult({ result }: { result: Schema<'ChannelTest'> }) {
  const answer = result.response_code === null ? 'Nobody answered' : `The answer was ${result.response_code}`;
  return (
    <div class={`notice notice-${result.delivered ? 'good' : 'bad'}`} role="status">
      <Icon name={result.delivered ? 'check' : 'alert'} />
      <div>
        <b>{result.delivered ? 'It arrived.' : 'It did not arrive.'}</b>
        <p>
          {answer}, after {count(result.took_ms)}&nbsp;ms.{result.error !== null && ` ${result.error}`}
        </p>
      </div>
    </div>
  );
}

const kKinds: readonly { readonly kind: Schema<'ChannelKind'>; readonly means: string }[] = [
  { kind: 'webhook', means: 'a program of yours, by HTTP' },
  { kind: 'mail', means: 'people, by plain text' },
  { kind: 'mqtt', means: 'a broker, such as that of Home Assistant' },
];

export function NewChannelView() {
  const asked = useSelect((state) => state.location.query['kind']);
  const kind = kKinds.find((entry) => entry.kind === asked)?.kind ?? 'webhook';
  return (
    <>
      <div class="view-head">
        <h1>New channel</h1>
        <div class="actions" role="group" aria-label="Kind">
          {kKinds.map((entry) => (
            <button
              key={entry.kind}
              type="button"
              aria-pressed={entry.kind === kind}
              onClick={() => setQuery({ kind: entry.kind }, { replace: true })}
            >
              {entry.kind}
            </button>
          ))}
        </div>
        <span class="muted">tells {kKinds.find((entry) => entry.kind === kind)?.means}</span>
      </div>
      <MakeChannel key={kind} kind={kind} />
    </>
  );
}

function MakeChannel({ kind }: { kind: Schema<'ChannelKind'> }) {
  const { draft, run, form } = useEditing(() => newDraft(kind));
  const make = (): void =>
    withOperator((by) => {
      void run(async () => {
        const answer = await send('post', '/api/v1/channels', { body: bodyOf(draft, by) });
        listsAreOld();
        showToast('good', `${answer.data.name} is told from now on.`);
        navigate(`/channels/${answer.data.id}`);
      });
    });
  return (
    <div class="channel-editor">
      <ChannelForm {...form} onSave={make} />
    </div>
  );
}
