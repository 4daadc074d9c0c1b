import { kYardScans } from './support/build';
import { expect, test } from './support/fixtures';

test('after a restart of the daemon the page is live again, and has what it missed', async ({
  page,
  daemon,
  troubles,
}) => {
  troubles.expect(/ERR_CONNECTION_REFUSED|ERR_CONNECTION_RESET|ERR_INCOMPLETE_CHUNKED_ENCODING|ERR_EMPTY_RESPONSE/);
  await daemon.makeYard();
  await daemon.upload(0, 6);
  await page.goto(`${daemon.url}/alerts`);
  const live = page.locator('.live');
  await expect(live).toContainText('live');
  await expect(page.getByText('Nothing is open.')).toBeVisible();

  await daemon.stop();
  await expect(live).toContainText('reconnecting');
  await daemon.startAgain();
  await daemon.upload(6, kYardScans);
  await expect(page.locator('.alert-row').first()).toBeVisible();
  await expect(live).toHaveText(/^\s*live$/);
});

test('a daemon that stays away is said to be away, and what was shown stays', async ({ page, yard, troubles }) => {
  troubles.expect(/ERR_CONNECTION_REFUSED|ERR_CONNECTION_RESET|ERR_INCOMPLETE_CHUNKED_ENCODING|ERR_EMPTY_RESPONSE/);
  await page.goto(yard.url);
  await expect(page.getByRole('region', { name: 'Site yard' })).toBeVisible();
  await yard.stop();
  await expect(page.locator('.live')).toContainText('not live');
  await expect(page.getByRole('region', { name: 'Site yard' })).toBeVisible();
  await page
    .getByRole('link', { name: 'Alerts', exact: true })
    .or(page.getByRole('link', { name: /^Alerts \d/ }))
    .first()
    .click();
  await expect(page.getByText('The daemon does not answer').or(page.locator('.alert-row').first())).toBeVisible();
});
