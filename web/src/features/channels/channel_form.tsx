// Every field of a channel: by what it tells, and of what.

import { useSites } from '../../app/sites';
import { type Schema } from '../../lib/api';
import { EditForm, type EditFormProps, type PartProps } from '../../ui/edit_form';
import { CheckField, FormPart, NumberField, SelectField, TextField } from '../../ui/form';
import { type ChannelDraft, faultsOf, newSecret } from './draft';

export interface ChannelFormProps extends EditFormProps<ChannelDraft> {
  /** As it is kept; nothing for a new one. */
  channel?: Schema<'Channel'>;
}

interface ChannelPart extends PartProps<ChannelDraft> {
  channel: Schema<'Channel'> | undefined;
}

const kSeverities = (['info', 'advisory', 'warning', 'critical'] as const).map((value) => ({ value, words: value }));

export function ChannelForm({ channel, ...form }: ChannelFormProps) {
  const { kind } = form.draft;
  return (
    <EditForm {...form} faults={faultsOf(form.draft)}>
      {(part) => (
        <>
          <TextField label="Name" {...part.field('name')} />
          {kind === 'webhook' && <WebhookFields {...part} channel={channel} />}
          {kind === 'mail' && <MailFields {...part} channel={channel} />}
          {kind === 'mqtt' && <MqttFields {...part} channel={channel} />}
          <Told {...part} />
        </>
      )}
    </EditForm>
  );
}

function Told({ field }: PartProps<ChannelDraft>) {
  const sites = useSites();
  return (
    <FormPart title="Of what it tells">
      <div class="field-pair">
        <SelectField
          label="Site"
          options={[{ value: '', words: 'all sites' }, ...sites.map(({ name }) => ({ value: name, words: name }))]}
          {...field('site')}
        />
        <SelectField label="From this severity on" options={kSeverities} {...field('min_severity')} />
      </div>
      <TextField
        label="Events"
        hint="alert.* is each step of each alert; * is everything; others are such as track.started or scan.stored. With commas between them."
        {...field('events')}
      />
      <NumberField
        label="At most"
        unit="messages a minute"
        hint="More wait; none is lost."
        min={1}
        max={6000}
        step={1}
        {...field('per_minute')}
      />
      <CheckField label="Enabled" hint="What happens while it is not is not told." {...field('enabled')} />
    </FormPart>
  );
}

function WebhookFields({ set, field, channel }: ChannelPart) {
  const kept = channel?.webhook?.secrets;
  return (
    <FormPart title="Webhook">
      <TextField
        label="Address"
        type="url"
        placeholder="https://example.com/raywatch"
        {...field('url', 'webhook.url')}
      />
      <TextField
        label={kept === undefined ? 'Secret' : 'New secret'}
        placeholder="whsec_…"
        hint={
          kept === undefined
            ? 'Each message is signed with it. Copy it to the receiver now: it is never shown again.'
            : `Kept: ${kept}. Leave this empty to keep ${kept === 1 ? 'it' : 'them'}. To change without a gap, give the old and the new one for a while.`
        }
        {...field('secrets', 'webhook.secrets')}
      />
      <div class="actions">
        <button type="button" onClick={() => set({ secrets: newSecret() })}>
          Make a secret
        </button>
      </div>
    </FormPart>
  );
}

function ServerFields({ draft, field, channel, port }: ChannelPart & { port: string }) {
  const of = draft.kind;
  const hasPassword = (channel?.mail ?? channel?.mqtt)?.has_password ?? false;
  return (
    <>
      <div class="field-pair">
        <TextField label="Server" placeholder={`${of}.example.com`} {...field('host', `${of}.host`)} />
        <NumberField
          label="Port"
          unit=""
          min={1}
          max={65535}
          step={1}
          placeholder={port}
          {...field('port', `${of}.port`)}
        />
      </div>
      <div class="field-pair">
        <TextField label="User" placeholder="none" {...field('user', `${of}.user`)} />
        <TextField
          label={hasPassword ? 'New password' : 'Password'}
          type="password"
          placeholder={hasPassword ? 'kept as it is' : 'none'}
          disabled={draft.clearPassword}
          hint="It is never shown again."
          {...field('password', `${of}.password`)}
        />
      </div>
      {hasPassword && <CheckField label="Forget the password that is kept" {...field('clearPassword')} />}
    </>
  );
}

function MailFields(part: ChannelPart) {
  const { draft, field } = part;
  const port = { none: '25', starttls: '587', tls: '465' }[draft.security];
  return (
    <FormPart title="Mail">
      <SelectField
        label="Connection"
        options={[
          { value: 'starttls', words: 'encrypted, by STARTTLS' },
          { value: 'tls', words: 'encrypted from the start (TLS)' },
          { value: 'none', words: 'not encrypted' },
        ]}
        {...field('security', 'mail.security')}
      />
      <ServerFields {...part} port={port} />
      <TextField label="From" type="email" placeholder="raywatch@example.com" {...field('from', 'mail.from')} />
      <TextField
        label="To"
        placeholder="guard@example.com, office@example.com"
        hint="With commas between them."
        {...field('to', 'mail.to')}
      />
    </FormPart>
  );
}

function MqttFields(part: ChannelPart) {
  const { draft, field } = part;
  return (
    <FormPart title="MQTT">
      <CheckField label="Encrypted (TLS)" {...field('tls', 'mqtt.tls')} />
      <ServerFields {...part} port={draft.tls ? '8883' : '1883'} />
      <div class="field-pair">
        <TextField label="Topics begin with" {...field('topic_prefix', 'mqtt.topic_prefix')} />
        <TextField
          label="Home Assistant discovery"
          placeholder="off"
          hint="Empty: Home Assistant is told nothing."
          {...field('discovery_prefix', 'mqtt.discovery_prefix')}
        />
      </div>
    </FormPart>
  );
}
