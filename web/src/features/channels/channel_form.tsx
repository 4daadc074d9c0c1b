import { type ComponentChildren } from 'preact';
import { useSites } from '../../app/sites';
import { type Schema } from '../../lib/api';
import { type Problem } from '../../lib/problem';
import { CheckField, FormProblem, NumberField, SelectField, TextField } from '../../ui/form';
import { type ChannelDraft, newSecret } from './draft';

export interface ChannelFormProps {
  draft: ChannelDraft;
  onDraft: (draft: ChannelDraft) => void;
  /** As it is kept; nothing for a new one. */
  channel?: Schema<'Channel'>;
  problem: Problem | undefined;
  saving: boolean;
  actions?: ComponentChildren;
  notice?: ComponentChildren;
  onSave: () => void;
}

const kSeverities = (['info', 'advisory', 'warning', 'critical'] as const).map((value) => ({ value, words: value }));

interface PartProps {
  draft: ChannelDraft;
  set: (change: Partial<ChannelDraft>) => void;
  error: (field: string) => string | undefined;
  channel: Schema<'Channel'> | undefined;
}

export function ChannelForm(props: ChannelFormProps) {
  const { draft, channel, problem } = props;
  const sites = useSites();
  const part: PartProps = {
    draft,
    channel,
    set: (change) => props.onDraft({ ...draft, ...change }),
    error: (field) => problem?.about(field),
  };
  const { set, error } = part;
  return (
    <form
      class="panel panel-body"
      noValidate
      onSubmit={(event) => {
        event.preventDefault();
        props.onSave();
      }}
    >
      {props.notice}
      <TextField label="Name" value={draft.name} error={error('name')} onValue={(name) => set({ name })} />
      {draft.kind === 'webhook' && <WebhookFields {...part} />}
      {draft.kind === 'mail' && <MailFields {...part} />}
      {draft.kind === 'mqtt' && <MqttFields {...part} />}
      <fieldset class="form-part">
        <legend>Of what it tells</legend>
        <div class="field-pair">
          <SelectField
            label="Site"
            value={draft.site}
            options={[{ value: '', words: 'all sites' }, ...sites.map(({ name }) => ({ value: name, words: name }))]}
            error={error('site')}
            onValue={(site) => set({ site })}
          />
          <SelectField
            label="From this severity on"
            value={draft.min_severity}
            options={kSeverities}
            error={error('min_severity')}
            onValue={(min_severity) => set({ min_severity })}
          />
        </div>
        <TextField
          label="Events"
          value={draft.events}
          hint="alert.* is each step of each alert; * is everything; others are such as track.started or scan.stored. With commas between them."
          error={error('events')}
          onValue={(events) => set({ events })}
        />
        <NumberField
          label="At most"
          unit="messages a minute"
          hint="More wait; none is lost."
          min={1}
          max={6000}
          step={1}
          value={draft.per_minute}
          error={error('per_minute')}
          onValue={(per_minute) => set({ per_minute })}
        />
        <CheckField
          label="Enabled"
          hint="What happens while it is not is not told."
          checked={draft.enabled}
          onChecked={(enabled) => set({ enabled })}
        />
      </fieldset>
      <FormProblem problem={problem} shown={kShown} />
      <div class="actions">
        <button type="submit" class="primary" disabled={props.saving}>
          Save
        </button>
        {props.actions}
      </div>
    </form>
  );
}

const kShown = [
  ...['name', 'site', 'min_severity', 'events', 'per_minute', 'webhook.url', 'webhook.secrets', 'mail.from', 'mail.to'],
  ...['mail', 'mqtt'].flatMap((kind) => ['host', 'port', 'user', 'password'].map((field) => `${kind}.${field}`)),
  ...['mqtt.topic_prefix', 'mqtt.discovery_prefix'],
];

function WebhookFields({ draft, set, error, channel }: PartProps) {
  const kept = channel?.webhook?.secrets;
  return (
    <fieldset class="form-part">
      <legend>Webhook</legend>
      <TextField
        label="Address"
        type="url"
        placeholder="https://example.com/raywatch"
        value={draft.url}
        error={error('webhook.url')}
        onValue={(url) => set({ url })}
      />
      <TextField
        label={kept === undefined ? 'Secret' : 'New secret'}
        placeholder="whsec_…"
        hint={
          kept === undefined
            ? 'Each message is signed with it. Copy it to the receiver now: it is never shown again.'
            : `Kept: ${kept}. Leave this empty to keep ${kept === 1 ? 'it' : 'them'}. To change without a gap, give the old and the new one for a while.`
        }
        value={draft.secrets}
        error={error('webhook.secrets')}
        onValue={(secrets) => set({ secrets })}
      />
      <div class="actions">
        <button type="button" onClick={() => set({ secrets: newSecret() })}>
          Make a secret
        </button>
      </div>
    </fieldset>
  );
}

function ServerFields({ draft, set, error, channel, port }: PartProps & { port: string }) {
  const of = draft.kind;
  const hasPassword = (channel?.mail ?? channel?.mqtt)?.has_password ?? false;
  return (
    <>
      <div class="field-pair">
        <TextField
          label="Server"
          placeholder={`${of}.example.com`}
          value={draft.host}
          error={error(`${of}.host`)}
          onValue={(host) => set({ host })}
        />
        <NumberField
          label="Port"
          unit=""
          min={1}
          max={65535}
          step={1}
          placeholder={port}
          value={draft.port}
          error={error(`${of}.port`)}
          onValue={(value) => set({ port: value })}
        />
      </div>
      <div class="field-pair">
        <TextField
          label="User"
          placeholder="none"
          value={draft.user}
          error={error(`${of}.user`)}
          onValue={(user) => set({ user })}
        />
        <TextField
          label={hasPassword ? 'New password' : 'Password'}
          type="password"
          placeholder={hasPassword ? 'kept as it is' : 'none'}
          disabled={draft.clearPassword}
          hint="It is never shown again."
          value={draft.password}
          error={error(`${of}.password`)}
          onValue={(password) => set({ password })}
        />
      </div>
      {hasPassword && (
        <CheckField
          label="Forget the password that is kept"
          checked={draft.clearPassword}
          onChecked={(clearPassword) => set({ clearPassword })}
        />
      )}
    </>
  );
}

function MailFields(part: PartProps) {
  const { draft, set, error } = part;
  const port = { none: '25', starttls: '587', tls: '465' }[draft.security];
  return (
    <fieldset class="form-part">
      <legend>Mail</legend>
      <SelectField
        label="Connection"
        value={draft.security}
        options={[
          { value: 'starttls', words: 'encrypted, by STARTTLS' },
          { value: 'tls', words: 'encrypted from the start (TLS)' },
          { value: 'none', words: 'not encrypted' },
        ]}
        onValue={(security) => set({ security })}
      />
      <ServerFields {...part} port={port} />
      <TextField
        label="From"
        type="email"
        placeholder="raywatch@example.com"
        value={draft.from}
        error={error('mail.from')}
        onValue={(from) => set({ from })}
      />
      <TextField
        label="To"
        placeholder="guard@example.com, office@example.com"
        hint="With commas between them."
        value={draft.to}
        error={error('mail.to')}
        onValue={(to) => set({ to })}
      />
    </fieldset>
  );
}

function MqttFields(part: PartProps) {
  const { draft, set, error } = part;
  return (
    <fieldset class="form-part">
      <legend>MQTT</legend>
      <CheckField label="Encrypted (TLS)" checked={draft.tls} onChecked={(tls) => set({ tls })} />
      <ServerFields {...part} port={draft.tls ? '8883' : '1883'} />
      <div class="field-pair">
        <TextField
          label="Topics begin with"
          value={draft.topic_prefix}
          error={error('mqtt.topic_prefix')}
          onValue={(topic_prefix) => set({ topic_prefix })}
        />
        <TextField
          label="Home Assistant discovery"
          placeholder="off"
          hint="Empty: Home Assistant is told nothing."
          value={draft.discovery_prefix}
          error={error('mqtt.discovery_prefix')}
          onValue={(discovery_prefix) => set({ discovery_prefix })}
        />
      </div>
    </fieldset>
  );
}
