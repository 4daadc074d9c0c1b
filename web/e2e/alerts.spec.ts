import { kYardScans } from './support/build';
import { type Daemon } from './support/daemon';
import { expect, expectNoSidewaysScrolling, signIn, test } from './support/fixtures';

interface AlertJson {
  id: number;
  state: string;
  history: { action: string; by: string; note: string }[];
}

const alertOf = (daemon: Daemon, id: number): Promise<AlertJson> => daemon.get<AlertJson>(`/api/v1/alerts/${id}`);

test('the story: scans arrive, an alert stands there, somebody acknowledges it', async ({ page, daemon }) => {
  await daemon.makeYard();
  await daemon.upload(0, 6);
  await page.goto(`${daemon.url}/alerts`);
  await expect(page.getByText('Nothing is open.')).toBeVisible();
  await daemon.upload(6, kYardScans);
  const alert = page.getByRole('listitem').filter({ hasText: 'critical' }).first();
  await expect(alert).toBeVisible();
  await expect(page).toHaveTitle(/^\(\d+\) Alert/);

  await alert.getByRole('link').click();
  const detail = page.getByRole('region', { name: /^Alert \d+$/ });
  await expect(detail).toContainText('By the rule nothing leaves');
  await expect(detail).toContainText('seen in 2 of the last 3 scans');
  await expect(detail).toContainText(/[\d.]+ × [\d.]+ × [\d.]+\sm/);
  await expect(detail).toContainText('Compared with scan');

  await detail.getByLabel('Note').fill('on my way');
  await detail.getByRole('button', { name: 'Acknowledge' }).click();
  await page.getByLabel('Your name').fill('anna');
  await page.getByRole('button', { name: 'That is me' }).click();
  await expect(page.getByText('1 alert acknowledged.')).toBeVisible();
  await expect(detail).toContainText('acknowledged by anna');
  await expect(detail).toContainText('on my way');
  const id = Number(/alerts\/(\d+)/.exec(page.url())?.[1]);
  expect(await alertOf(daemon, id)).toMatchObject({ state: 'acknowledged' });

  // The name is asked for once.
  await page.reload();
  await detail.getByRole('button', { name: 'Resolve' }).click();
  await expect(page.getByText('1 alert resolved.')).toBeVisible();
  expect((await alertOf(daemon, id)).history.at(-1)).toMatchObject({ action: 'resolved', by: 'anna' });
});

test('alerts are worked through with the keyboard alone', async ({ page, yard }) => {
  await page.goto(`${yard.url}/alerts`);
  const rows = page.locator('.alert-row');
  await expect(rows.first()).toBeVisible();
  const before = await rows.count();
  expect(before).toBeGreaterThanOrEqual(2);

  await page.keyboard.press('?');
  await expect(page.getByRole('dialog', { name: 'Keys' })).toContainText('acknowledge');
  await page.keyboard.press('Escape');
  await expect(page.getByRole('dialog')).toBeHidden();

  await page.keyboard.press('j');
  await expect(rows.nth(0)).toHaveClass(/alert-current/);
  await page.keyboard.press('j');
  await expect(rows.nth(1)).toHaveClass(/alert-current/);
  await page.keyboard.press('k');
  await page.keyboard.press('Enter');
  await expect(page).toHaveURL(/\/alerts\/\d+$/);
  await page.keyboard.press('a');
  // Who acts is asked once, with the keyboard, too.
  await expect(page.getByLabel('Your name')).toBeFocused();
  await page.keyboard.type('ben');
  await page.keyboard.press('Enter');
  await expect(page.getByText('1 alert acknowledged.')).toBeVisible();
  await expect(rows).toHaveCount(before - 1);

  await page.keyboard.press('Escape');
  await expect(page).toHaveURL(/\/alerts$/);
  await page.keyboard.press('j');
  await page.keyboard.press('s');
  await expect(page.getByRole('dialog', { name: 'Snooze 1 alert' })).toBeVisible();
  await page.keyboard.press('Enter');
  await expect(page.getByText('1 alert snoozed.')).toBeVisible();
  await expect(rows).toHaveCount(before - 2);
});

test('what is marked is done at once', async ({ page, yard }) => {
  await signIn(page, 'cleo');
  await page.goto(`${yard.url}/alerts`);
  const rows = page.locator('.alert-row');
  await expect(rows.first()).toBeVisible();
  const number = await rows.count();
  await page.keyboard.press('*');
  await expect(page.getByText(`${number} marked`)).toBeVisible();
  await page.keyboard.press('x'); // no alert is the current one yet: nothing happens
  await page.getByRole('button', { name: 'Resolve' }).click();
  const question = page.getByRole('dialog', { name: `Resolve ${number} alerts` });
  await question.getByLabel('Note').fill('an exercise');
  await question.getByRole('button', { name: 'Resolve' }).click();
  await expect(page.getByText(`${number} alerts resolved.`)).toBeVisible();
  await expect(page.getByText('Nothing is open.')).toBeVisible();
  const { items } = await yard.get<{ items: AlertJson[] }>('/api/v1/alerts?state=resolved');
  const last = (await alertOf(yard, items[0]?.id ?? 0)).history.at(-1);
  expect(last).toMatchObject({ action: 'resolved', by: 'cleo', note: 'an exercise' });
});

test('nobody overrules unknowingly what somebody else did', async ({ page, yard }) => {
  await signIn(page, 'dora');
  await page.goto(`${yard.url}/alerts`);
  const row = page.locator('.alert-row').first();
  await expect(row).toBeVisible();
  const id = Number((await row.getAttribute('id'))?.replace('alert-', ''));
  // The other one's action is not heard of yet when this one acts: the list is held back.
  let release = (): void => undefined;
  const held = new Promise<void>((resolve) => (release = resolve));
  await page.route('**/api/v1/alerts?*', async (route) => {
    await held;
    await route.continue();
  });
  await yard.post(`/api/v1/alerts/${id}/acknowledge`, { by: 'emil' });
  await page.keyboard.press('j');
  await page.keyboard.press('r');
  await expect(
    page.getByText(`Alert ${id} changed meanwhile. It was acknowledged by emil; nothing was done.`),
  ).toBeVisible();
  release();
  await expect(page.locator(`#alert-${id}`)).toBeHidden();
  expect(await alertOf(yard, id)).toMatchObject({ state: 'acknowledged' });
});

test('a change is accepted as normal', async ({ page, yard }) => {
  await signIn(page, 'fred');
  await page.goto(`${yard.url}/alerts`);
  await page.locator('.alert-row a').first().click();
  await page.getByRole('button', { name: 'Accept as normal' }).click();
  const question = page.getByRole('dialog', { name: 'Accept 1 change as normal' });
  await question.getByLabel('Note').fill('the crate was moved away');
  await question.getByRole('button', { name: 'Accept as normal' }).click();
  await expect(page.getByText('1 alert accepted as normal.')).toBeVisible();
  await expect(page.getByText('It is over: nothing is left to be done.')).toBeVisible();
});

test('the inbox fits a telephone', async ({ page, yard }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await page.goto(`${yard.url}/alerts`);
  await expect(page.locator('.alert-row').first()).toBeVisible();
  await expectNoSidewaysScrolling(page);
  await page.locator('.alert-row a').first().click();
  await expect(page.getByRole('button', { name: 'Acknowledge' })).toBeVisible();
  await expectNoSidewaysScrolling(page);
  await page.getByRole('link', { name: 'Back to the list' }).click();
  await expect(page.locator('.alert-row').first()).toBeVisible();
});
