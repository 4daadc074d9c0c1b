import { readFile } from 'node:fs/promises';
import { join } from 'node:path';
import { kYard } from './support/build';
import { expect, expectNoSidewaysScrolling, signIn, test } from './support/fixtures';

const scanFile = (number: number): string => join(kYard, `yard_${String(number).padStart(4, '0')}.pcd`);

test('a scan with its side-car is dropped on the page, stored and compared', async ({ page, daemon }) => {
  await daemon.makeYard();
  await page.goto(`${daemon.url}/scans`);
  await expect(page.getByText('There is no scan yet.')).toBeVisible();
  const files = await Promise.all(
    [scanFile(0), `${scanFile(0)}.json`].map(async (file) => ({
      name: file.split('/').pop() ?? '',
      content: (await readFile(file)).toString('base64'),
    })),
  );
  const dropped = await page.evaluateHandle((given) => {
    const transfer = new DataTransfer();
    for (const { name, content } of given) {
      transfer.items.add(new File([Uint8Array.from(atob(content), (letter) => letter.charCodeAt(0))], name));
    }
    return transfer;
  }, files);
  await page.dispatchEvent('main', 'dragover', { dataTransfer: dropped });
  await expect(page.locator('.upload-over')).toBeVisible();
  await page.dispatchEvent('main', 'drop', { dataTransfer: dropped });
  const upload = page.getByRole('list', { name: 'Uploads' }).getByRole('listitem');
  await expect(upload).toHaveCount(1);
  await expect(upload).toContainText('stored');
  await expect(page.getByRole('row').filter({ hasText: 'yard-1' })).toContainText('compared');
  await upload.getByRole('link', { name: 'scan 1' }).click();
  await expect(page.getByRole('heading', { name: 'Scan 1' })).toBeVisible();
  await expect(page.getByText('No earlier scan was near enough to be considered.')).toBeVisible();
});

test('a file that is no scan is refused in words', async ({ page, daemon, troubles }) => {
  troubles.expect(/415|422/);
  await daemon.makeYard();
  await page.goto(`${daemon.url}/scans`);
  await expect(page.getByRole('combobox', { name: /^Sensor, where/ })).toHaveValue('yard-1');
  await page
    .getByLabel('Scan files')
    .setInputFiles({ name: 'cat.jpg', mimeType: 'image/jpeg', buffer: Buffer.from([0xff, 0xd8, 0xff, 0xe0, 0, 0]) });
  const problem = page.getByRole('list', { name: 'Uploads' }).getByRole('alert');
  await expect(problem).toContainText('not taken');
  await expect(problem).toContainText(/format/);
});

test('scans are found by sensor, time and words, and the link says how', async ({ page, yard }) => {
  await page.goto(`${yard.url}/scans?sensor=yard-2`);
  const rows = page.getByRole('table', { name: 'scans' }).locator('tbody tr');
  await expect(rows).toHaveCount(7);
  await page.getByLabel('from').fill('2026-03-01T09:02');
  await expect(page).toHaveURL(/from=2026-03-01T08%3A02%3A00/);
  await expect(rows).toHaveCount(3);
  await page.getByLabel('Search in scans').fill('compared yard-2');
  await expect(rows).toHaveCount(3);
  await page.getByLabel('Search in scans').fill('elsewhere');
  await expect(page.getByText('Nothing in this page has all of these words.')).toBeVisible();
});

test('a scan tells why its priors were chosen, and can be pinned', async ({ page, yard }) => {
  await page.goto(`${yard.url}/scans/12`);
  const candidates = page.getByRole('table', { name: 'candidates' });
  await expect(candidates.locator('tbody tr').first()).toContainText('overlaps most');
  await page.getByRole('button', { name: 'with what is normal' }).click();
  await expect(page).toHaveURL(/comparison=\d+$/);
  await expect(candidates.locator('tbody tr').first()).toBeVisible();
  await page.getByRole('button', { name: 'Pin: never delete it' }).click();
  await expect(page.getByText('pinned', { exact: true })).toBeVisible();
  await page.getByLabel('Note').fill('the night of the crate');
  await page.getByRole('button', { name: 'Keep the note' }).click();
  // "Kept." may still be that of the pin.
  await expect.poll(() => yard.get('/api/v1/scans/12')).toMatchObject({ pinned: true, note: 'the night of the crate' });
});

test('a sensor can be told more about, and says what is wrong with that', async ({ page, yard, troubles }) => {
  troubles.expect(/422/);
  await page.goto(`${yard.url}/sensors`);
  await page.getByRole('link', { name: 'yard-1' }).click();
  await expect(page.getByText('(estimated)').first()).toBeVisible();
  await page.getByLabel('Nearest usable range').fill('50');
  await page.getByLabel('Farthest usable range').fill('20');
  await page.getByRole('button', { name: 'Save' }).click();
  await expect(page.locator('.field-bad').first()).toBeVisible();
  await page.getByLabel('Nearest usable range').fill('1.5');
  await page.getByRole('button', { name: 'Save' }).click();
  await expect(page.getByText('yard-1 was changed.')).toBeVisible();
  await expect(page.getByText(/^1\.50\sm$/)).toBeVisible();
});

test('what is normal is listed by version, and learned anew by somebody', async ({ page, yard }) => {
  await signIn(page, 'gina');
  await page.goto(`${yard.url}/baselines`);
  const rows = page.getByRole('table').locator('tbody tr');
  await expect(rows).toHaveCount(4);
  await page.getByRole('button', { name: 'Learn anew' }).click();
  await page.getByLabel('Note').fill('the yard was paved');
  await page.getByRole('dialog').getByRole('button', { name: 'Learn anew' }).click();
  await expect(rows.first()).toContainText('gina');
  await expect(rows.first()).toContainText('the yard was paved');
});

test('a silence is kept for planned work, and ended', async ({ page, yard }) => {
  await signIn(page, 'hans');
  await page.goto(`${yard.url}/silences`);
  await expect(page.getByText('Nothing is silent.')).toBeVisible();
  await page.getByRole('button', { name: 'New silence' }).click();
  await page.getByLabel('What of it').selectOption('sensor yard-2');
  await page.getByLabel('Why').fill('the mast is painted');
  await page.getByRole('button', { name: 'Keep silent' }).click();
  const row = page.getByRole('row').filter({ hasText: 'yard · sensor yard-2' });
  await expect(row).toContainText('silent');
  await expect(row).toContainText('hans');
  await row.getByRole('button', { name: /^End silence/ }).click();
  await expect(page.getByText('The silence was ended.')).toBeVisible();
});

test('the lists fit a telephone', async ({ page, yard }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  for (const view of ['/scans', '/scans/12', '/sensors', '/sensors/yard-1', '/baselines', '/silences']) {
    await page.goto(yard.url + view);
    await expect(page.getByRole('heading', { level: 1 })).toBeVisible();
    await expect(page.locator('.spinner')).toHaveCount(0);
    await expectNoSidewaysScrolling(page);
  }
});
