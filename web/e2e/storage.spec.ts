import { expect, expectNoSidewaysScrolling, seriousViolations, test } from './support/fixtures';

test('what is stored, what would go, and what went', async ({ page, yard }) => {
  await page.goto(`${yard.url}/storage`);
  await expect(page.getByText('points of yard')).toBeVisible();
  await expect(page.getByText(/free of|of .*GB|TB/).first()).toBeVisible();
  await expect(page.getByText('Nothing was deleted yet.')).toBeVisible();

  await page.getByLabel('Points of this site take at most').fill('0.001');
  await page.getByRole('button', { name: 'Show what would go' }).click();
  const preview = page.getByRole('status').filter({ hasText: 'would go now' });
  await expect(preview).toContainText(/\d+ scans with .* would go now: \d+ for the room that points take/);
  await expect(preview).toContainText(/kept all the same: .*part of what is normal/);
  expect((await yard.get<{ items: unknown[] }>('/api/v1/scans?site=yard')).items).toHaveLength(14);

  // What is shown is of the limits that were asked about.
  await page.getByLabel('Points of this site take at most').fill('');
  await expect(preview).toHaveCount(0);
  await page.getByLabel('Scans older than this go').fill('30');
  await page.getByRole('button', { name: 'Show what would go' }).click();
  await expect(page.getByText('Nothing would go now.')).toBeVisible();
  await page.getByRole('button', { name: 'Save' }).click();
  await expect(page.getByText('What is kept of yard was changed.')).toBeVisible();
  await expect(page.getByLabel('Scans older than this go')).toHaveValue('30');
  expect(await yard.get('/api/v1/sites/yard')).toMatchObject({ retention: { max_age_days: 30, max_bytes: null } });

  const deleted = await fetch(`${yard.url}/api/v1/scans/14`, { method: 'DELETE' });
  expect(deleted.status).toBe(204);
  await page.reload();
  await expect(page.getByRole('table', { name: 'deletions' }).locator('tbody tr')).toContainText('by hand');
});

test('a limit that cannot be says so at its field', async ({ page, yard, troubles }) => {
  troubles.expect(/422/);
  await page.goto(`${yard.url}/storage`);
  await page.getByLabel('Scans older than this go').fill('-3');
  await page.getByRole('button', { name: 'Save' }).click();
  await expect(page.getByLabel('Scans older than this go')).toHaveAttribute('aria-invalid', 'true');
  await expect(page.locator('.field-bad')).toBeVisible();
});

for (const { name, width, colorScheme } of [
  { name: 'wide and dark', width: 1280, colorScheme: 'dark' as const },
  { name: 'narrow and light', width: 390, colorScheme: 'light' as const },
]) {
  test(`storage is accessible and fits, ${name}`, async ({ page, yard }) => {
    await page.setViewportSize({ width, height: 844 });
    await page.emulateMedia({ colorScheme });
    await page.goto(`${yard.url}/storage`);
    await expect(page.getByText('points of yard')).toBeVisible();
    await expect(page.locator('.spinner')).toHaveCount(0);
    await page.getByLabel('Points of this site take at most').fill('0.001');
    await page.getByRole('button', { name: 'Show what would go' }).click();
    await expect(page.getByText('would go now')).toBeVisible();
    expect(await seriousViolations(page)).toEqual([]);
    await expectNoSidewaysScrolling(page);
  });
}
