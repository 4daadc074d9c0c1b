import { readFile } from 'node:fs/promises';
import { join, resolve } from 'node:path';
import { type Locator, type Page } from '@playwright/test';
import { kBuild, simulateYard } from './support/build';
import { type Daemon } from './support/daemon';
import { expect, expectNoSidewaysScrolling, test } from './support/fixtures';

/** A yard in which the bag is left near a sensor, where shots are dense enough to tell it from the ground. */
const kBagYard = resolve(kBuild, 'e2e-bag-yard');

interface Manifest {
  objects: { kind: string; state: number; box: { min_m: number[]; max_m: number[] } }[];
  scans: { present: number[] }[];
}

/** Where the bag is left, and the first scan that could have it, by the scene itself. */
async function bag(): Promise<{ point: string; first: number }> {
  const manifest = JSON.parse(await readFile(join(kBagYard, 'manifest.json'), 'utf8')) as Manifest;
  const found = manifest.objects.find(({ kind }) => kind === 'bag');
  if (!found) throw new Error('the yard has no bag');
  const { min_m, max_m } = found.box;
  return {
    point: min_m.map((part, axis) => ((part + (max_m[axis] ?? 0)) / 2).toFixed(3)).join(','),
    first: manifest.scans.findIndex(({ present }) => present.includes(found.state)) + 1,
  };
}

/** Where the crate stood that is taken: occupied until scan 8, free from scan 10 on; the first sensor cannot see it. */
async function crate(yard: Daemon): Promise<string> {
  const { items } = await yard.get<{ items: { kind: string; centroid_m: number[] }[] }>('/api/v1/tracks?kind=removed');
  return items[0]?.centroid_m.map((part) => part.toFixed(3)).join(',') ?? '';
}

const words = (page: Page) => page.locator('.course-words');
const rows = (page: Page) => page.getByRole('region', { name: 'intervals' }).locator('tbody tr');
/** Of an interval: its first and last scan. */
const scansOf = (row: Locator) => row.getByRole('link').allInnerTexts();

test('the place of the bag was free, then not seen, and is occupied since it was left there', async ({
  page,
  daemon,
}) => {
  simulateYard(kBagYard, ['--seed', '8']);
  await daemon.makeYard();
  await daemon.upload(0, 8, kBagYard);
  const { point, first } = await bag();
  expect(first).toBe(5);
  await page.goto(`${daemon.url}/history?site=yard&point=${point}`);
  await expect(words(page)).toContainText(
    /Free until .*09:00:30 CET, occupied since .*09:01:00 CET; 1 scan between could not see it\./,
  );
  await expect(words(page)).toContainText(/Not seen since .*09:01:31 CET/);
  await expect(words(page)).toContainText('8 scans asked.');
  await expect(rows(page)).toHaveCount(4);
  for (const [index, state] of ['not seen', 'occupied', 'not seen', 'free'].entries()) {
    await expect(rows(page).nth(index)).toContainText(state);
  }
  expect(await scansOf(rows(page).nth(1))).toEqual(['scan 5', 'scan 7']);
  expect(await scansOf(rows(page).nth(3))).toEqual(['scan 1', 'scan 3']);

  await page.getByRole('button', { name: /^occupied, 1 Mar 2026/ }).click();
  const chosen = page.getByRole('region', { name: 'The chosen interval' });
  await expect(chosen).toContainText('It came about between scan 3 and scan 5');
  await expect(page).toHaveURL(/interval=5$/);
  await chosen.getByRole('link', { name: 'compare these two' }).click();
  await expect(page.getByLabel('Number of the scan')).toHaveValue('5');
  await expect(page.getByLabel('Numbers of scans')).toHaveValue('3');
});

test('a place that no ray reaches was not seen, and the time before the first scan is empty', async ({
  page,
  yard,
}) => {
  await page.goto(`${yard.url}/history?site=yard&point=0,0,-3`);
  await expect(words(page)).toContainText('None of 14 scans could see this place.');
  await expect(page.getByRole('button', { name: /^not seen, 1 Mar 2026/ })).toBeVisible();
  await page.goto(`${yard.url}/history?site=yard&point=0,0,1&from=2026-02-01T00:00:00Z&to=2026-02-02T00:00:00Z`);
  await expect(words(page)).toContainText('No scan was taken in this time.');
});

test('a place is given by numbers, as a point or a box, and the link keeps it', async ({ page, yard }) => {
  await page.goto(`${yard.url}/history`);
  await expect(page.getByText('No place is chosen.')).toBeVisible();
  const [x, y, z] = (await crate(yard)).split(',');
  await page.getByLabel('x', { exact: true }).fill(x ?? '');
  await page.getByLabel('y', { exact: true }).fill(y ?? '');
  await page.getByLabel('z', { exact: true }).fill(z ?? '');
  await page.getByRole('button', { name: 'Ask this place' }).click();
  await expect(page).toHaveURL(/point=/);
  await expect(rows(page)).toHaveCount(4);
  for (const side of ['length, x', 'width, y', 'height, z']) await page.getByLabel(side).fill('0.3');
  await page.getByRole('button', { name: 'Ask this place' }).click();
  await expect(page).toHaveURL(/box=/);
  await expect(words(page)).toContainText('14 scans asked.');
  await page.reload();
  await expect(page.getByLabel('width, y')).toHaveValue('0.3');
  await expect(words(page)).toContainText('14 scans asked.');
});

test('what is wrong with a place or a time is said', async ({ page, yard, troubles }) => {
  await page.goto(`${yard.url}/history?site=yard&point=1,2`);
  await expect(page.getByText('This link names no place.')).toBeVisible();
  troubles.expect(/422/);
  await page.goto(`${yard.url}/history?site=yard&point=1,2,3&from=tomorrow`);
  await expect(page.getByRole('alert')).toContainText('from');
});

test('time is gone through with the keyboard', async ({ page, yard }) => {
  const point = await crate(yard);
  await page.goto(`${yard.url}/history?site=yard&point=${point}`);
  await page
    .getByRole('button', { name: /^not seen, 1 Mar 2026/ })
    .first()
    .focus();
  await page.keyboard.press('ArrowRight');
  await expect(page.getByRole('button', { name: /^occupied/ })).toBeFocused();
  await expect(page).toHaveURL(/interval=2$/);
  await page.keyboard.press('End');
  await expect(page.getByRole('button', { name: /^free/ })).toBeFocused();
  await expect(page).toHaveURL(/interval=10$/);

  await page.getByRole('heading', { name: 'What was there' }).click();
  await page.keyboard.press('w');
  await expect(page).toHaveURL(/from=2026-02-22T23%3A00%3A00.000Z&to=2026-03-01T23%3A00%3A00.000Z/);
  await page.keyboard.press('n');
  await expect(words(page)).toContainText('No scan was taken in this time.');
  await page.keyboard.press('p');
  await expect(words(page)).toContainText(/free since/);
  await page.keyboard.press('e');
  await expect(page).not.toHaveURL(/from=/);
});

test('the calendar shows how much happened on each day, and a day becomes the range', async ({ page, yard }) => {
  const point = await crate(yard);
  await page.goto(`${yard.url}/history?site=yard&point=${point}`);
  const day = page.getByRole('button', { name: /^1 March 2026: 14 scans, \d+ changes?, \d+ alerts?$/ });
  await expect(day).toContainText('14');
  await day.focus();
  await page.keyboard.press('ArrowDown');
  await expect(page.getByRole('button', { name: /^8 March 2026: 0 scans/ })).toBeFocused();
  await page.keyboard.press('ArrowUp');
  await page.keyboard.press('Enter');
  await expect(page).toHaveURL(/from=2026-02-28T23%3A00%3A00.000Z&to=2026-03-01T23%3A00%3A00.000Z/);
  await expect(day).toHaveAttribute('aria-pressed', 'true');
  await expect(page.getByRole('button', { name: /^day/ })).toHaveAttribute('aria-pressed', 'true');
  await page.getByRole('button', { name: 'Month before' }).click();
  await expect(page).toHaveURL(/month=2026-02/);
  await expect(page.getByRole('heading', { name: 'February 2026' })).toBeVisible();
  await page.getByLabel('What is counted').selectOption('changes');
  await expect(page).toHaveURL(/count=tracks/);
});

test('an alert leads to the history of its place', async ({ page, yard }) => {
  const { items } = await yard.get<{ items: { id: number; track: number | null }[] }>('/api/v1/alerts?state=open');
  await page.goto(`${yard.url}/alerts/${items.find(({ track }) => track !== null)?.id}`);
  await page.getByRole('link', { name: 'History of this place' }).click();
  await expect(words(page)).toContainText(/since/);
});

test('an empty store, and a telephone', async ({ page, daemon, yard }) => {
  await page.goto(`${daemon.url}/history`);
  await expect(page.getByText('There is no site yet.')).toBeVisible();
  await page.setViewportSize({ width: 390, height: 844 });
  await page.goto(`${yard.url}/history?site=yard&point=${await crate(yard)}`);
  await expect(words(page)).toContainText(/free since/);
  await expectNoSidewaysScrolling(page);
});
