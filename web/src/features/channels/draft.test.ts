import { webcrypto } from 'node:crypto';
import { describe, expect, it, vi } from 'vitest';
import { bodyOf, draftOf, faultsOf, newDraft, newSecret } from './draft';

describe('a channel that is filled in', () => {
  it('sends secrets only when they are given', () => {
    const webhook = { ...newDraft('webhook'), name: 'control room', url: 'https://example.com' };
    expect(bodyOf(webhook, 'anna')).toMatchObject({ webhook: { url: 'https://example.com' }, by: 'anna' });
    expect(bodyOf(webhook, 'anna').webhook).not.toHaveProperty('secrets');
    expect(bodyOf({ ...webhook, secrets: 'whsec_a, whsec_b' }, 'anna').webhook?.secrets).toEqual([
      'whsec_a',
      'whsec_b',
    ]);
    const mail = { ...newDraft('mail'), host: 'mail.example.com' };
    expect(bodyOf(mail, 'anna').mail).not.toHaveProperty('password');
    expect(bodyOf({ ...mail, password: 'x' }, 'anna').mail?.password).toBe('x');
    expect(bodyOf({ ...mail, password: 'x', clearPassword: true }, 'anna').mail?.password).toBeNull();
  });

  it('leaves out what is not of its kind, and empty fields', () => {
    const body = bodyOf({ ...newDraft('mqtt'), host: 'broker', discovery_prefix: '' }, 'anna');
    expect(body).not.toHaveProperty('mail');
    expect(body.mqtt).toEqual({
      host: 'broker',
      user: null,
      tls: false,
      topic_prefix: 'raywatch',
      discovery_prefix: null,
    });
  });

  it('comes back without its secrets', () => {
    const stored = {
      kind: 'mail',
      name: 'guards',
      events: ['alert.*', 'track.started'],
      site: null,
      per_minute: 30,
      min_severity: 'warning',
      enabled: true,
      mail: { host: 'm', port: 465, security: 'tls', user: '', has_password: true, from: 'a@b', to: ['c@d', 'e@f'] },
    } as unknown as Parameters<typeof draftOf>[0];
    expect(draftOf(stored)).toMatchObject({
      port: '465',
      to: 'c@d, e@f',
      password: '',
      events: 'alert.*, track.started',
    });
  });

  it('says what is missing for its kind', () => {
    expect(Object.keys(faultsOf(newDraft('webhook')))).toEqual(['name', 'webhook.url']);
    expect(Object.keys(faultsOf({ ...newDraft('mail'), name: 'guards' }))).toEqual([
      'mail.host',
      'mail.from',
      'mail.to',
    ]);
    expect(faultsOf({ ...newDraft('mqtt'), name: 'home', host: 'broker' })).toEqual({});
  });

  it('gets a secret that Standard Webhooks takes', () => {
    // Node 18 has it, but not where browsers have it.
    vi.stubGlobal('crypto', webcrypto);
    expect(newSecret()).toMatch(/^whsec_[A-Za-z0-9+/]{43}=$/);
    expect(newSecret()).not.toBe(newSecret());
  });
});
