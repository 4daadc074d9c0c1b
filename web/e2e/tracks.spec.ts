import { expect, expectNoSidewaysScrolling, test } from './support/fixtures';

interface Tracks {
  items: { id: number; kind: string; state: string; seen: number; latest_change: number }[];
}

test('tracks are found by kind, state and time, and the link says how', async ({ page, yard }) => {
  const { items } = await yard.get<Tracks>('/api/v1/tracks');
  const removed = items.filter(({ kind }) => kind === 'removed');
  await page.goto(`${yard.url}/tracks`);
  const rows = page.getByRole('table', { name: 'tracks' }).locator('tbody tr');
  await expect(rows).toHaveCount(items.length);
  await page.getByLabel('kind').selectOption('removed');
  await expect(page).toHaveURL(/kind=removed/);
  await expect(rows).toHaveCount(removed.length);
  await page.getByLabel('kind').selectOption('');
  await page.getByLabel('state').selectOption('gone');
  await expect(rows).toHaveCount(items.filter(({ state }) => state === 'gone').length);
  await page.getByLabel('state').selectOption('');
  await page.getByLabel('to', { exact: true }).fill('2026-03-01T09:00');
  await expect(page.getByText('No track is like this.')).toBeVisible();
});

test('a track shows who saw it, its size through time, its alerts and its changes', async ({ page, yard }) => {
  const { items } = await yard.get<Tracks>('/api/v1/tracks');
  const track = items.reduce((most, each) => (each.seen > most.seen ? each : most));
  await page.goto(`${yard.url}/tracks`);
  await page.getByRole('link', { name: String(track.id), exact: true }).click();
  await expect(page.getByRole('heading', { name: `Track ${track.id}` })).toBeVisible();
  await expect(page.getByRole('region', { name: 'What it is' })).toContainText(/[\d.]+ × [\d.]+ × [\d.]+\sm/);
  await expect(page.getByRole('region', { name: 'Who saw it' })).toContainText(/seen \d+ scans?/);
  await page.getByText('Times and scans').click();
  await expect(page.getByRole('region', { name: 'observations' }).locator('tbody tr').first()).toContainText('scan');
  await expect(page.getByRole('region', { name: 'Its alerts' }).locator('.alert-line').first()).toBeVisible();
  for (const chart of [/^Volume of its boxes: from [\d.,]+ to [\d.,]+ L$/, /^Points: from [\d,]+ to [\d,]+ points$/]) {
    await expect(page.getByRole('img', { name: chart }).locator('canvas')).toBeVisible();
  }
  const changes = page.getByRole('region', { name: `changes of track ${track.id}` }).locator('tbody tr');
  const found = await yard.get<{ items: unknown[] }>(`/api/v1/tracks/${track.id}/changes`);
  await expect(changes).toHaveCount(found.items.length);
  await expect(changes.first()).toContainText(String(track.latest_change));
  await page.getByRole('link', { name: 'History of this place' }).click();
  await expect(page.locator('.course-words')).toContainText(/since/);
});

test('what was moved is one object at two places, and each leads to the other', async ({ page, yard }) => {
  // The yard moves nothing by itself: the pair is made of two of its tracks.
  const { items } = await yard.get<Tracks>('/api/v1/tracks');
  const [from, to] = [items.find(({ kind }) => kind === 'removed'), items.find(({ kind }) => kind === 'added')];
  await page.route(`**/api/v1/tracks/${from?.id}`, async (route) => {
    const response = await route.fetch();
    await route.fulfill({ response, json: { ...((await response.json()) as object), moved_to: to?.id } });
  });
  await page.goto(`${yard.url}/tracks/${from?.id}`);
  await expect(page.getByText(/It was moved to/)).toContainText(/[\d.]+\sm away at/);
  await page.getByRole('link', { name: `track ${to?.id}` }).click();
  await expect(page.getByRole('heading', { name: `Track ${to?.id}` })).toBeVisible();
});

test('a track that is not there is said to be not there', async ({ page, yard, troubles }) => {
  troubles.expect(/404/);
  await page.goto(`${yard.url}/tracks/999`);
  await expect(page.getByRole('alert')).toContainText('999');
});

test('tracks fit a telephone, and an empty store says what they are', async ({ page, daemon, yard }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await page.goto(`${daemon.url}/tracks`);
  await expect(page.getByText('There is no track yet.')).toBeVisible();
  for (const view of ['/tracks', '/tracks/1']) {
    await page.goto(yard.url + view);
    await expect(page.getByRole('heading', { level: 1 })).toBeVisible();
    await expect(page.locator('.spinner')).toHaveCount(0);
    await expectNoSidewaysScrolling(page);
  }
});
