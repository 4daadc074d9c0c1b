import { expect, expectNoSidewaysScrolling, test } from './support/fixtures';

test('the overview shows how sites and sensors fare, in the time zone of the site', async ({ page, yard }) => {
  await page.goto(yard.url);
  await expect(page.getByText('live', { exact: true })).toBeVisible();
  const site = page.getByRole('region', { name: 'Site yard' });
  await expect(site).toContainText('times in Europe/Berlin');
  for (const sensor of ['yard-1', 'yard-2']) {
    const row = site.getByRole('row').filter({ hasText: sensor });
    await expect(row).toContainText('good');
    await expect(row).toContainText(/\d+\s%/);
    await expect(row.getByRole('time')).toHaveAttribute('title', /2026, 09:0\d:\d\d CET \(Europe\/Berlin\)/);
  }
  await expect(page.getByRole('region', { name: 'The daemon' })).toContainText(/[\d.]+\sGB free of [\d.]+\sGB/);
  await expect(page.getByRole('region', { name: 'The daemon' })).toContainText('nothing waits');
});

test('an empty store says how to begin', async ({ page, daemon }) => {
  await page.goto(daemon.url);
  await expect(page.getByText('There is no site yet.')).toBeVisible();
  await expect(page.getByText('Nothing is open.')).toBeVisible();
});

test('a scan that arrives is on screen without loading the page again', async ({ page, daemon }) => {
  await daemon.makeYard();
  await page.goto(daemon.url);
  const row = page.getByRole('row').filter({ hasText: 'yard-1' });
  await expect(row).toContainText('no scans yet');
  await daemon.upload(0, 1);
  await expect(row).toContainText('good');
  await expect(page.getByRole('region', { name: 'The daemon' })).toContainText('1 scan,');
});

test('the overview fits a telephone', async ({ page, yard }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await page.goto(yard.url);
  await expect(page.getByRole('region', { name: 'Site yard' })).toBeVisible();
  await expectNoSidewaysScrolling(page);
  await page.getByRole('button', { name: 'Menu' }).click();
  await page.getByRole('link', { name: 'Alerts' }).click();
  await expect(page.getByRole('heading', { name: 'Alerts', level: 1 })).toBeVisible();
  await expect(page.getByRole('navigation', { name: 'Views' })).toBeHidden();
});

test('nothing is fetched twice', async ({ page, yard }) => {
  const asked: string[] = [];
  page.on('request', (request) => {
    if (/\/(api\/|metrics)/.test(request.url())) asked.push(`${request.method()} ${request.url()}`);
  });
  await page.goto(yard.url);
  await expect(page.getByRole('row').filter({ hasText: 'yard-2' })).toContainText('good');
  await page.getByRole('link', { name: 'Go to the inbox' }).click();
  await expect(page.locator('.alert-row').first()).toBeVisible();
  await page.goBack();
  await expect(page.getByRole('row').filter({ hasText: 'yard-2' })).toContainText('good');
  expect(asked.filter((request, index) => asked.indexOf(request) !== index)).toEqual([]);
});
