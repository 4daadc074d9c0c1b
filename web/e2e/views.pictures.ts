// The pictures that stand in the README: `npm run pictures` makes them anew, from the tests' own scene.

import { rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { kYardScans, simulatePit, simulateYard } from './support/build';
import { expect, signIn, test } from './support/fixtures';
import { pixelsLike } from './support/picture';

const kPictures = new URL('../pictures/', import.meta.url).pathname;

test('pictures of the main views', async ({ page, daemon }) => {
  // The scene ends now, so that its times are those of a guard at work.
  const folder = join(tmpdir(), 'raywatch-pictures');
  rmSync(folder, { recursive: true, force: true });
  simulateYard(folder, ['--start', new Date(Date.now() - (kYardScans / 2) * 30_000).toISOString()]);
  await daemon.makeYard();
  await daemon.upload(0, kYardScans, folder);
  await signIn(page, 'anna');

  await page.emulateMedia({ colorScheme: 'light' });
  await page.setViewportSize({ width: 1280, height: 640 });
  await page.goto(daemon.url);
  await expect(page.getByRole('row').filter({ hasText: 'yard-2' })).toContainText('good');
  await expect(page.locator('.alert-line').first()).toBeVisible();
  await page.screenshot({ path: join(kPictures, 'overview.png') });

  await page.emulateMedia({ colorScheme: 'dark' });
  await page.setViewportSize({ width: 1280, height: 800 });
  await page.goto(`${daemon.url}/alerts`);
  await page.locator('.alert-row a').first().click();
  await expect(page.getByRole('heading', { name: 'Who saw it' })).toBeVisible();
  await page.screenshot({ path: join(kPictures, 'alerts.png') });

  await page.setViewportSize({ width: 390, height: 800 });
  await expect(page.getByRole('heading', { name: 'Who saw it' })).toBeVisible();
  await page.screenshot({ path: join(kPictures, 'alert_narrow.png') });

  await page.setViewportSize({ width: 1280, height: 860 });
  const { items } = await daemon.get<{ items: { id: number }[] }>('/api/v1/changes?site=yard&kind=removed');
  await page.goto(`${daemon.url}/changes/${items.at(-1)?.id}?rays=1`);
  await expect.poll(() => pixelsLike(page.locator('.scene'), [255, 122, 31])).toBeGreaterThan(50);
  await expect(page.getByRole('region', { name: 'Panorama' }).getByRole('application')).toBeVisible();
  await page.screenshot({ path: join(kPictures, 'change.png') });
});

test('a picture of a survey', async ({ page, daemon }) => {
  test.setTimeout(300_000);
  const folder = join(tmpdir(), 'raywatch-pictures-pit');
  rmSync(folder, { recursive: true, force: true });
  simulatePit(folder, 1);
  await daemon.makePit(folder, 2);
  await page.emulateMedia({ colorScheme: 'light' });
  await page.setViewportSize({ width: 1280, height: 860 });
  await page.goto(`${daemon.url}/surveys/2`);
  await expect(page.getByRole('application', { name: /difference of both epochs/ })).toBeVisible();
  await expect(page.getByText(/its size from/)).toBeVisible();
  await page.screenshot({ path: join(kPictures, 'survey.png') });
});
