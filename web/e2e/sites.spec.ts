import { expect, expectNoSidewaysScrolling, seriousViolations, test } from './support/fixtures';

interface SiteJson {
  epsg: number | null;
  mine_grid: object | null;
}

test('the coordinates of a site are said, with what is wrong at its field', async ({ page, pit, troubles }) => {
  troubles.expect(/422/);
  await page.goto(`${pit.url}/surveys`);
  await page.getByRole('link', { name: 'EPSG:28350' }).click();
  const panel = page.getByRole('region', { name: 'Coordinates of its results' });
  const epsg = panel.getByLabel('EPSG code');
  await expect(epsg).toHaveValue('28350');
  await epsg.fill('4326');
  await panel.getByRole('button', { name: 'Save' }).click();
  await expect(epsg).toHaveAccessibleDescription(/WGS 84 is not projected/);
  await expect(epsg).toBeFocused();

  await panel.getByLabel('Files of surveys go out in').selectOption('mine_grid');
  await panel.getByRole('button', { name: 'Save' }).click();
  const place = panel.getByRole('group', { name: 'The same place in the grid' });
  await expect(place).toHaveAccessibleDescription('needs three numbers');
  for (const [axis, value] of [
    ['x (east)', '5000'],
    ['y (north)', '10000'],
    ['z (height)', '1310'],
  ] as const)
    await place.getByLabel(axis).fill(value);
  await panel.getByLabel("The site's axes are turned by").fill('90');
  await expect(panel).toContainText('100 m along the x of the site lead 0.00 m east and 100.00 m north in the grid.');
  await panel.getByLabel('Scale').fill('2');
  await panel.getByRole('button', { name: 'Save' }).click();
  await expect(panel.getByLabel('Scale')).toHaveAccessibleDescription(/must be at most 1\.1/);
  await panel.getByLabel('Scale').fill('0.9996');
  await panel.getByRole('button', { name: 'Save' }).click();
  await expect(panel).toContainText('now a local mine grid, turned by 90°');
  expect(await pit.get<SiteJson>('/api/v1/sites/pit')).toMatchObject({
    epsg: null,
    mine_grid: {
      site_origin_m: [0, 0, 0],
      grid_origin_m: [5000, 10000, 1310],
      rotation_deg: 90,
      scale: 0.9996,
    },
  });

  await panel.getByLabel('Files of surveys go out in').selectOption('own');
  await panel.getByRole('button', { name: 'Save' }).click();
  await expect(panel).toContainText('now those of the site');
  expect(await pit.get<SiteJson>('/api/v1/sites/pit')).toMatchObject({ epsg: null, mine_grid: null });
});

test('coordinates that somebody else said meanwhile stand beside those that are filled in', async ({
  page,
  pit,
  troubles,
}) => {
  troubles.expect(/412/);
  await page.goto(`${pit.url}/sites/pit`);
  const epsg = page.getByLabel('EPSG code');
  await epsg.fill('28351');
  await fetch(`${pit.url}/api/v1/sites/pit`, {
    method: 'PATCH',
    headers: { 'Content-Type': 'application/json' },
    body: JSON.stringify({ epsg: 28352 }),
  });
  await page.getByRole('button', { name: 'Save' }).click();
  const row = page.getByRole('alert').getByRole('row', { name: /^Coordinates/ });
  await expect(row).toContainText('EPSG:28352');
  await expect(row).toContainText('EPSG:28351');
  await page.getByRole('button', { name: 'Save mine over it' }).click();
  await expect(page.getByText('now EPSG:28351')).toBeVisible();
});

for (const { width, colorScheme } of [
  { width: 1280, colorScheme: 'light' as const },
  { width: 390, colorScheme: 'dark' as const },
]) {
  test(`a site is accessible and fits, ${width} px wide and ${colorScheme}`, async ({ page, pit }) => {
    await page.setViewportSize({ width, height: 844 });
    await page.emulateMedia({ colorScheme });
    await page.goto(`${pit.url}/sites/pit`);
    await page.getByLabel('Files of surveys go out in').selectOption('mine_grid');
    expect(await seriousViolations(page)).toEqual([]);
    await expectNoSidewaysScrolling(page);
  });
}
