import { expect, test } from './support/fixtures';

test('every view has a link that can be sent', async ({ page, yard }) => {
  await page.goto(`${yard.url}/alerts?state=all&severity=critical`);
  await expect(page.getByLabel('State')).toHaveValue('all');
  await expect(page.getByLabel('Severity')).toHaveValue('critical');
  await page
    .getByRole('link', { name: /removed/ })
    .first()
    .click();
  await expect(page).toHaveURL(/\/alerts\/\d+\?state=all&severity=critical$/);
  await expect(page.getByRole('heading', { name: /was removed/ })).toBeVisible();
  await page.reload();
  await expect(page.getByRole('heading', { name: /was removed/ })).toBeVisible();
  await page.goBack();
  await expect(page).toHaveURL(/\/alerts\?state=all&severity=critical$/);
});

test('a link that leads nowhere says so', async ({ page, yard }) => {
  await page.goto(`${yard.url}/no/such/view`);
  await expect(page.getByText('There is no such view.')).toBeVisible();
  await page.getByRole('link', { name: 'Go to the overview' }).click();
  await expect(page.getByRole('heading', { name: 'Overview' })).toBeVisible();
});

test('light and dark follow the system until somebody chooses, and then stay', async ({ page, daemon }) => {
  const ground = () => page.evaluate(() => getComputedStyle(document.documentElement).backgroundColor);
  await page.emulateMedia({ colorScheme: 'dark' });
  await page.goto(daemon.url);
  await expect.poll(ground).toBe('rgb(11, 16, 22)');
  await page.emulateMedia({ colorScheme: 'light' });
  await expect.poll(ground).toBe('rgb(238, 241, 244)');
  await page.getByRole('button', { name: /^Colours/ }).click();
  await expect.poll(ground).toBe('rgb(11, 16, 22)');
  await page.reload();
  expect(await ground()).toBe('rgb(11, 16, 22)');
});

test('the page may run nothing but its own files', async ({ page, daemon }) => {
  const response = await page.goto(daemon.url);
  expect(response?.headers()['content-security-policy']).toContain("default-src 'self'");
  expect(response?.headers()['content-security-policy']).not.toContain('unsafe');
});
