import { expect, expectNoSidewaysScrolling, seriousViolations, signIn, test as base } from './support/fixtures';
import { Receiver } from './support/receiver';

const test = base.extend<{ receiver: Receiver }>({
  receiver: async ({}, use) => {
    const receiver = await Receiver.start();
    await use(receiver);
    await receiver.end();
  },
});

interface Channel {
  id: number;
}

const kSecret = 'whsec_MfKQ9r8GKYqrTwjUPD8ILPZIo2LaLaSwMfKQ9r8GKYqrTwj=';

const channelTo = (url: string) => ({
  name: 'control room',
  kind: 'webhook',
  by: 'anna',
  webhook: { url, secrets: [kSecret] },
});

test('a webhook is made with a secret of its own, tried, and its secret never comes back', async ({
  page,
  daemon,
  receiver,
}) => {
  await signIn(page, 'ida');
  await page.goto(`${daemon.url}/channels`);
  await expect(page.getByText('Nobody is told yet.')).toBeVisible();
  await page.getByRole('link', { name: 'Make the first one' }).click();
  await page.getByLabel('Name', { exact: true }).fill('control room');
  await page.getByLabel('Address').fill(receiver.url);
  await page.getByRole('button', { name: 'Make a secret' }).click();
  const secret = await page.getByLabel('Secret', { exact: true }).inputValue();
  expect(secret).toMatch(/^whsec_/);
  await page.getByRole('button', { name: 'Save' }).click();
  await expect(page.getByRole('heading', { name: 'control room' })).toBeVisible();
  await expect(page.getByText('edited by ida')).toBeVisible();

  await page.getByRole('button', { name: 'Send a test' }).click();
  await expect(page.getByText('It arrived.')).toBeVisible();
  await expect(page.getByText(/The answer was 204/)).toBeVisible();
  expect(receiver.received[0]?.body.type).toBe('test');
  expect(receiver.received[0]?.headers['webhook-signature']).toMatch(/^v1,/);

  receiver.answer = 500;
  await page.getByRole('button', { name: 'Send a test' }).click();
  await expect(page.getByText('It did not arrive.')).toBeVisible();
  await expect(page.getByText(/The answer was 500/)).toBeVisible();

  await page.reload();
  await expect(page.getByLabel('New secret')).toHaveValue('');
  expect(await page.content()).not.toContain(secret);
  await page.getByLabel('From this severity on').selectOption('warning');
  await page.getByRole('button', { name: 'Save' }).click();
  await expect(page.getByText('control room was changed.')).toBeVisible();
  expect(await daemon.get('/api/v1/channels/1')).toMatchObject({ min_severity: 'warning', webhook: { secrets: 1 } });
});

test('what is wrong with a channel stands at its field', async ({ page, daemon, troubles }) => {
  troubles.expect(/422/);
  await signIn(page, 'ida');
  await page.goto(`${daemon.url}/channels/new?kind=mail`);
  await page.getByLabel('Name', { exact: true }).fill('guards');
  await page.getByLabel('Server').fill('mail.example.com');
  await page.getByLabel('From', { exact: true }).fill('nobody');
  await page.getByLabel('To', { exact: true }).fill('guard@example.com');
  await page.getByRole('button', { name: 'Save' }).click();
  await expect(page.getByLabel('From', { exact: true })).toHaveAttribute('aria-invalid', 'true');
  await expect(page.getByText(/must be a plain address/)).toHaveCount(1);
  await page.getByLabel('From', { exact: true }).fill('raywatch@example.com');
  await page.getByLabel('User').fill('raywatch');
  await page.getByLabel('Password').fill('hunter2');
  await page.getByRole('button', { name: 'Save' }).click();
  await expect(page.getByRole('heading', { name: 'guards' })).toBeVisible();
  await expect(page.getByLabel('New password')).toHaveValue('');
  expect(await daemon.get('/api/v1/channels/1')).toMatchObject({ mail: { port: 587, has_password: true } });
});

test('an alert that could not be told stands in the log, and is sent again', async ({ page, daemon, receiver }) => {
  await signIn(page, 'ida');
  await daemon.makeYard();
  receiver.answer = 410; // the receiver is gone: given up at once
  const channel = await daemon.post<Channel>('/api/v1/channels', channelTo(receiver.url));
  await daemon.upload(0, 14);
  await page.goto(`${daemon.url}/deliveries?state=failed`);
  const rows = page.getByRole('table', { name: 'deliveries' }).locator('tbody tr');
  await expect(rows.first()).toContainText('failed');
  await expect(rows.first()).toContainText('410');
  await expect(rows.first().getByRole('link', { name: /^alert \d+$/ })).toBeVisible();

  receiver.answer = 204;
  await page.goto(`${daemon.url}/channels/${channel.id}`);
  await page.getByLabel('Enabled').check();
  await page.getByRole('button', { name: 'Save' }).click();
  await expect(page.getByText('control room was changed.')).toBeVisible();
  await page.goto(`${daemon.url}/deliveries?state=failed`);
  await rows
    .last()
    .getByRole('button', { name: /^Send delivery/ })
    .click();
  await expect(page.getByText('It waits to be sent again.')).toBeVisible();
  await page.getByLabel('State').selectOption('delivered');
  await expect(page).toHaveURL(/state=delivered/);
  await expect(rows.first()).toContainText('delivered');
  await expect(rows.first()).toContainText('204');
});

test('a channel is deleted, and nobody is told by it any more', async ({ page, daemon, receiver }) => {
  const { id } = await daemon.post<Channel>('/api/v1/channels', channelTo(receiver.url));
  await page.goto(`${daemon.url}/channels/${id}`);
  await page.getByRole('button', { name: 'Delete …' }).click();
  await page.getByRole('button', { name: 'Delete it' }).click();
  await expect(page).toHaveURL(/\/channels$/);
  await expect(page.getByText('Nobody is told yet.')).toBeVisible();
});

for (const { name, width, colorScheme } of [
  { name: 'wide and light', width: 1280, colorScheme: 'light' as const },
  { name: 'narrow and dark', width: 390, colorScheme: 'dark' as const },
]) {
  test(`channels and deliveries are accessible and fit, ${name}`, async ({ page, daemon, receiver }) => {
    await daemon.makeYard();
    const { id } = await daemon.post<Channel>('/api/v1/channels', channelTo(receiver.url));
    await page.setViewportSize({ width, height: 844 });
    await page.emulateMedia({ colorScheme });
    const forms = ['webhook', 'mail', 'mqtt'].map((kind) => `/channels/new?kind=${kind}`);
    for (const view of ['/channels', ...forms, `/channels/${id}`, '/deliveries']) {
      await page.goto(daemon.url + view);
      await expect(page.getByRole('heading', { level: 1 })).toBeVisible();
      await expect(page.locator('.spinner')).toHaveCount(0);
      expect(await seriousViolations(page), view).toEqual([]);
      await expectNoSidewaysScrolling(page);
    }
  });
}
