import { expect, expectNoSidewaysScrolling, test } from './support/fixtures';

interface ComparisonJson {
  id: number;
  scan: number;
  state: string;
  changes: number;
  reference: unknown;
  parameters: Record<string, unknown>;
}

test('a comparison by hand, from the scan by the form to its result and once more', async ({ page, yard }) => {
  await page.goto(`${yard.url}/scans/10`);
  await page.getByRole('link', { name: 'Compare by hand' }).click();
  await expect(page.getByLabel('Number of the scan')).toHaveValue('10');
  await expect(page.getByText(/By yard-2 at yard, .*09:02:01 CET/)).toBeVisible();
  await expect(page.getByLabel('Range (m)')).toHaveAttribute('placeholder', '0.15');
  await page.getByLabel('Named scans').check();
  await page.getByRole('button', { name: 'Add …' }).click();
  const picker = page.getByRole('dialog', { name: 'Compare with this scan, too' });
  await picker.getByLabel('Sensor').selectOption('yard-2');
  await picker.getByRole('button', { name: /^4 ?yard-2/ }).click();
  await expect(page.getByLabel('Numbers of scans')).toHaveValue('4');
  await page.getByLabel('Noise up to (points)').fill('3');
  await page.getByRole('button', { name: 'Compare', exact: true }).click();

  await expect(page).toHaveURL(/\/comparisons\/\d+$/);
  const id = Number(/(\d+)$/.exec(page.url())?.[1]);
  await expect(page.locator('.view-head')).toContainText('done');
  await expect(page.locator('.view-head')).toContainText('with scan 4');
  const comparison = await yard.get<ComparisonJson>(`/api/v1/comparisons/${id}`);
  expect(comparison).toMatchObject({ scan: 10, reference: { scans: [4] } });
  expect(comparison.parameters['cluster_min_points']).toBe(3);
  expect(comparison.changes).toBeGreaterThan(0);
  const changes = page.getByRole('region', { name: `changes of comparison ${id}` }).locator('tbody tr');
  await expect(changes).toHaveCount(comparison.changes);
  await expect(page.getByRole('region', { name: 'priors' }).locator('tbody tr')).toHaveCount(1);
  await expect(page.getByRole('region', { name: 'Parameters' })).toContainText('3 points (else 5 points)');

  await page.getByRole('link', { name: 'Again, with other parameters' }).click();
  await expect(page.getByLabel('Numbers of scans')).toHaveValue('4');
  await expect(page.getByLabel('Noise up to (points)')).toHaveValue('3');
  await page.getByLabel('Grouping').selectOption('union');
  await expect(page.getByLabel('Roughness (m)')).toHaveCount(0);
  await page.getByRole('button', { name: 'Compare', exact: true }).click();
  await expect(page).toHaveURL(new RegExp(`/comparisons/${id + 1}$`));
  await expect(page.locator('.view-head')).toContainText('done');
  await expect(page.getByRole('region', { name: 'Parameters' })).toContainText('union');
});

test('wrong input is shown at its field, by the form and by the daemon', async ({ page, yard, troubles }) => {
  await page.goto(`${yard.url}/compare?scan=9`);
  await page.getByLabel('Angle (°)').fill('wide');
  await page.getByLabel('A time range').check();
  await page.getByRole('button', { name: 'Compare', exact: true }).click();
  await expect(page.getByLabel('Angle (°)')).toHaveAccessibleDescription(/must be a number such as 0\.25/);
  await expect(page.getByLabel(/^from \(Europe\/Berlin\)/)).toHaveAccessibleDescription(/is required/);
  await expect(page.getByLabel(/^from \(Europe\/Berlin\)/)).toBeFocused();

  troubles.expect(/422/);
  await page.getByLabel('Angle (°)').fill('120');
  await page.getByLabel(/^from \(Europe\/Berlin\)/).fill('2026-03-01T09:05');
  await page.getByLabel(/^to \(Europe\/Berlin\)/).fill('2026-03-01T09:00');
  await page.getByRole('button', { name: 'Compare', exact: true }).click();
  await expect(page.getByLabel('Angle (°)')).toHaveAccessibleDescription(/90/);
  await expect(page.getByLabel('Angle (°)')).toHaveAttribute('aria-invalid', 'true');
  await expect(page.getByLabel(/^to \(Europe\/Berlin\)/)).toHaveAccessibleDescription(/must be later than/);

  await page.getByLabel('Angle (°)').fill('');
  await page.getByLabel('Named scans').check();
  await page.getByLabel('Numbers of scans').fill('9');
  await page.getByRole('button', { name: 'Compare', exact: true }).click();
  await expect(page.getByLabel('Numbers of scans')).toHaveAccessibleDescription(/scan 9 is the one that is compared/);

  troubles.expect(/404/);
  await page.getByLabel('Number of the scan').press('Control+a');
  await page.getByLabel('Number of the scan').pressSequentially('99');
  await page.getByLabel('Number of the scan').press('Tab');
  await expect(page.getByLabel('Number of the scan')).toHaveAccessibleDescription(/99/);
});

test('a comparison is asked for with the keyboard alone', async ({ page, yard }) => {
  await page.goto(`${yard.url}/compare?scan=9`);
  await page.getByLabel('What was before').focus();
  await page.keyboard.press('ArrowDown');
  await expect(page.getByLabel('What is normal')).toBeChecked();
  await page.getByLabel('Number of the scan').focus();
  await page.keyboard.press('Enter');
  await expect(page).toHaveURL(/\/comparisons\/\d+$/);
  await expect(page.locator('.view-head')).toContainText('with what is normal');
  await expect(page.locator('.view-head')).toContainText('done');
});

test('how far a comparison is, is shown until its result is there', async ({ page, yard }) => {
  const { id } = await yard.post<ComparisonJson>('/api/v1/comparisons', { scan: 9 });
  let asked = 0;
  // The yard is compared too fast to be seen: the first two answers are those of a larger scan.
  await page.route(`**/api/v1/comparisons/${id}`, async (route) => {
    const response = await route.fetch();
    const json = (await response.json()) as object;
    const early = [
      { state: 'queued', progress: 0 },
      { state: 'running', progress: 0.4 },
    ][asked++];
    await route.fulfill({ response, json: { ...json, ...early }, headers: { 'Content-Type': 'application/json' } });
  });
  await page.goto(`${yard.url}/comparisons/${id}`);
  await expect(page.getByText('It waits for its turn.')).toBeVisible();
  await expect(page.getByRole('progressbar')).toHaveAttribute('value', '0.4');
  await expect(page.getByRole('region', { name: 'Figures' })).toBeVisible();
  await expect(page.getByRole('progressbar')).toHaveCount(0);
});

test('comparisons are found by scan and state, and a new one stands there by itself', async ({ page, yard }) => {
  await page.goto(`${yard.url}/comparisons`);
  const rows = page.getByRole('table', { name: 'comparisons' }).locator('tbody tr');
  await expect(rows.first()).toContainText('done');
  await page.getByLabel('of scan').fill('9');
  await page.keyboard.press('Enter');
  await expect(page).toHaveURL(/scan=9/);
  await expect(rows).toHaveCount(2);
  await yard.post('/api/v1/comparisons', { scan: 9, reference: { scans: [1] } });
  await expect(rows).toHaveCount(3);
  await expect(rows.first()).toContainText('scan 1');
  await page.getByLabel('state').selectOption('failed');
  await expect(page.getByText('No comparison is like this.')).toBeVisible();
});

test('comparisons fit a telephone, and an empty store says where to begin', async ({ page, daemon, yard }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await page.goto(`${daemon.url}/compare`);
  await expect(page.getByText('No scan is stored yet.')).toBeVisible();
  for (const view of ['/comparisons', '/comparisons/10', '/compare?scan=9', '/compare?like=10']) {
    await page.goto(yard.url + view);
    await expect(page.getByRole('heading', { level: 1 })).toBeVisible();
    await expect(page.locator('.spinner')).toHaveCount(0);
    await expectNoSidewaysScrolling(page);
  }
});
