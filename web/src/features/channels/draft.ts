// A channel as it is filled in. Secrets are written and never come back: an empty field leaves what is kept.

import type { Schema } from '../../lib/api';
import type { Difference } from '../../ui/edited_elsewhere';

type Kind = Schema<'ChannelKind'>;

export interface ChannelDraft {
  readonly name: string;
  readonly kind: Kind;
  readonly enabled: boolean;
  /** Empty: of all sites. */
  readonly site: string;
  readonly min_severity: Schema<'Severity'>;
  readonly events: string;
  readonly per_minute: string;
  readonly url: string;
  readonly secrets: string;
  readonly host: string;
  readonly port: string;
  readonly security: 'none' | 'starttls' | 'tls';
  readonly tls: boolean;
  readonly user: string;
  readonly password: string;
  readonly clearPassword: boolean;
  readonly from: string;
  readonly to: string;
  readonly topic_prefix: string;
  /** Empty: Home Assistant is told nothing. */
  readonly discovery_prefix: string;
}

export const newDraft = (kind: Kind): ChannelDraft => ({
  name: '',
  kind,
  enabled: true,
  site: '',
  min_severity: 'info',
  events: 'alert.*',
  per_minute: '30',
  url: '',
  secrets: '',
  host: '',
  port: '',
  security: 'starttls',
  tls: false,
  user: '',
  password: '',
  clearPassword: false,
  from: '',
  to: '',
  topic_prefix: 'raywatch',
  discovery_prefix: 'homeassistant',
});

export function draftOf(channel: Schema<'Channel'>): ChannelDraft {
  const { mail, mqtt, webhook } = channel;
  const server = mail ?? mqtt;
  return {
    ...newDraft(channel.kind),
    name: channel.name,
    enabled: channel.enabled,
    site: channel.site ?? '',
    min_severity: channel.min_severity,
    events: channel.events.join(', '),
    per_minute: String(channel.per_minute),
    url: webhook?.url ?? '',
    host: server?.host ?? '',
    port: server ? String(server.port) : '',
    security: mail?.security ?? 'starttls',
    tls: mqtt?.tls ?? false,
    user: server?.user ?? '',
    from: mail?.from ?? '',
    to: mail?.to.join(', ') ?? '',
    topic_prefix: mqtt?.topic_prefix ?? 'raywatch',
    discovery_prefix: mqtt?.discovery_prefix ?? '',
  };
}

/** The words of a list with commas or blanks between them. */
const listed = (text: string): string[] => text.split(/[\s,;]+/).filter(Boolean);

export function bodyOf(draft: ChannelDraft, by: string): Schema<'NewChannel'> {
  return {
    name: draft.name.trim(),
    kind: draft.kind,
    enabled: draft.enabled,
    site: draft.site === '' ? null : draft.site,
    min_severity: draft.min_severity,
    events: listed(draft.events),
    per_minute: Number(draft.per_minute),
    by,
    ...ownPartOf(draft),
  };
}

function ownPartOf(draft: ChannelDraft): Pick<Schema<'NewChannel'>, 'webhook' | 'mail' | 'mqtt'> {
  const secrets = listed(draft.secrets);
  if (draft.kind === 'webhook')
    return { webhook: { url: draft.url.trim(), ...(secrets.length > 0 ? { secrets } : {}) } };
  const server = {
    host: draft.host.trim(),
    ...(draft.port === '' ? {} : { port: Number(draft.port) }),
    user: draft.user === '' ? null : draft.user,
    ...(draft.clearPassword ? { password: null } : draft.password === '' ? {} : { password: draft.password }),
  };
  if (draft.kind === 'mail') {
    return { mail: { ...server, security: draft.security, from: draft.from.trim(), to: listed(draft.to) } };
  }
  return {
    mqtt: {
      ...server,
      tls: draft.tls,
      topic_prefix: draft.topic_prefix,
      discovery_prefix: draft.discovery_prefix === '' ? null : draft.discovery_prefix,
    },
  };
}

/** What is missing before anything is sent, by the daemon's own names of fields. */
export function faultsOf({ name, kind, url, host, from, to }: ChannelDraft): Readonly<Record<string, string>> {
  const needs: Readonly<Record<string, readonly [value: string, what: string]>> = {
    name: [name, 'needs a name'],
    ...(kind === 'webhook'
      ? { 'webhook.url': [url, 'needs an address'] }
      : { [`${kind}.host`]: [host, 'needs a server'] }),
    ...(kind === 'mail'
      ? { 'mail.from': [from, 'needs an address'], 'mail.to': [to, 'needs at least one address'] }
      : {}),
  };
  return Object.fromEntries(
    Object.entries(needs)
      .filter(([, [value]]) => value.trim() === '')
      .map(([field, [, what]]) => [field, what]),
  );
}

/** What differs between what is there and what is filled in; a secret that is filled in, always. */
export function differencesOf(theirs: ChannelDraft, mine: ChannelDraft): Difference[] {
  const shown: readonly (readonly [keyof ChannelDraft, string])[] = [
    ['name', 'Name'],
    ['enabled', 'Enabled'],
    ['site', 'Site'],
    ['min_severity', 'From severity'],
    ['events', 'Events'],
    ['per_minute', 'A minute'],
    ['url', 'Address'],
    ['host', 'Server'],
    ['port', 'Port'],
    ['security', 'Security'],
    ['user', 'User'],
    ['from', 'From'],
    ['to', 'To'],
    ['topic_prefix', 'Topics'],
    ['discovery_prefix', 'Discovery'],
  ];
  return shown.map(([key, name]) => ({ name, theirs: String(theirs[key]), mine: String(mine[key]) }));
}

/** A new secret as Standard Webhooks has it: 32 bytes that nobody can guess. */
export function newSecret(): string {
  const bytes = crypto.getRandomValues(new Uint8Array(32));
  return `whsec_${btoa(String.fromCharCode(...bytes))}`;
}

/** Where a channel leads: an address without what may be secret in it, or a server. */
export function placeOf({ webhook, mail, mqtt }: Schema<'Channel'>): string {
  if (webhook) return webhook.url.replace(/\?.*$/, '?…');
  if (mail) return mail.to.join(', ');
  return mqtt ? `${mqtt.host}:${mqtt.port}` : '';
}
