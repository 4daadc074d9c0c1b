import { type Locator, type Page } from '@playwright/test';
import { expect, expectNoSidewaysScrolling, seriousViolations, test } from './support/fixtures';

const zone = {
  site: 'yard',
  name: 'gate',
  kind: 'alert',
  polygon_m: [
    [0, 0],
    [6, 0],
    [6, 4],
    [0, 4],
  ],
  z_min_m: -0.5,
  z_max_m: 3,
};

interface Zone {
  id: number;
  name: string;
  polygon_m: [number, number][];
  z_min_m: number;
  z_max_m: number;
}

const picture = (page: Page): Locator => page.getByRole('application', { name: /from above/ });

/** The points have come: what was drawn before they did would lie elsewhere. */
async function pointsAreThere(page: Page): Promise<void> {
  await expect(page.getByText(/^height .* to /)).toBeVisible();
}

async function drawTriangle(page: Page): Promise<void> {
  for (const position of [
    { x: 200, y: 120 },
    { x: 420, y: 120 },
    { x: 420, y: 300 },
  ])
    await picture(page).click({ position });
}

test('a zone is drawn with the mouse, shaped, and stored', async ({ page, yard }) => {
  await page.goto(`${yard.url}/zones`);
  await expect(page.getByText('No zone yet: rules look everywhere.')).toBeVisible();
  await page.getByRole('link', { name: 'New zone' }).click();
  await pointsAreThere(page);
  await drawTriangle(page);
  await expect(page.getByRole('row', { name: /corner 3/ })).toBeVisible();
  await picture(page).click({ position: { x: 200, y: 120 } });
  await expect(page.getByText(/points over its outline/)).toBeVisible();

  // A corner is pulled elsewhere, another out of the middle of a side; one step is taken back.
  const box = (await picture(page).boundingBox())!;
  const pull = async (from: [number, number], to: [number, number]): Promise<void> => {
    await page.mouse.move(box.x + from[0], box.y + from[1]);
    await page.mouse.down();
    await page.mouse.move(box.x + to[0], box.y + to[1], { steps: 4 });
    await page.mouse.up();
  };
  await pull([420, 300], [440, 330]);
  await pull([310, 120], [310, 80]);
  await expect(page.getByText(/^4 corners, /)).toBeVisible();
  await page.getByRole('button', { name: 'Undo' }).click();
  await expect(page.getByText(/^3 corners, /)).toBeVisible();
  await page.getByRole('button', { name: 'Redo' }).click();

  await page.getByLabel('Name', { exact: true }).fill('fence');
  await page.getByLabel('Kind').selectOption('control');
  await expect(page.getByText(/Nothing may change here/)).toBeVisible();
  await page.getByRole('button', { name: 'Save' }).click();
  await expect(page.getByRole('heading', { name: 'fence' })).toBeVisible();
  const stored = (await yard.get<{ items: Zone[] }>('/api/v1/zones?site=yard')).items[0]!;
  expect(stored).toMatchObject({ name: 'fence', kind: 'control' });
  expect(stored.polygon_m).toHaveLength(4);
  // By itself it reaches from below the ground to over a person's head.
  expect(stored.z_min_m).toBeLessThan(0);
  expect(stored.z_max_m).toBeGreaterThan(2);
});

test('a zone is made of numbers, and what is wrong stands at its field', async ({ page, yard, troubles }) => {
  troubles.expect(/409|422/);
  await yard.post('/api/v1/zones', zone);
  await page.goto(`${yard.url}/zones/new?site=yard`);
  await page.getByRole('button', { name: 'Save' }).click();
  await expect(page.getByText('needs a name')).toBeVisible();
  await expect(page.getByRole('alert')).toContainText('needs at least 3 corners');
  const corners = [
    [0, 0],
    [4, 4],
    [4, 0],
    [0, 4],
  ];
  for (const [index, [x, y]] of corners.entries()) {
    await page.getByRole('button', { name: 'Add a corner', exact: true }).click();
    await page.getByLabel(`x of corner ${index + 1} `).fill(String(x));
    await page.getByLabel(`y of corner ${index + 1} `).fill(String(y));
  }
  await page.getByRole('button', { name: 'Close it' }).click();
  await expect(page.getByRole('alert')).toContainText('crosses itself');
  await page.getByLabel('y of corner 2').fill('0');
  await page.getByLabel('y of corner 3').fill('4');
  await page.getByLabel('y of corner 3').blur();
  await expect(page.getByText(/^4 corners, 16\.0/)).toBeVisible();
  await page.getByLabel('From height').fill('3');
  await page.getByLabel('To height').fill('2');
  await expect(page.getByText('must be above the lower end')).toBeVisible();
  await page.getByLabel('To height').fill('5');

  // What only the daemon knows: the name is taken.
  await page.getByLabel('Name', { exact: true }).fill('gate');
  await page.getByRole('button', { name: 'Save' }).click();
  await expect(page.locator('.field-bad')).toBeVisible();
  await page.getByLabel('Name', { exact: true }).fill('store');
  await page.getByRole('button', { name: 'Save' }).click();
  await expect(page.getByRole('heading', { name: 'store' })).toBeVisible();
});

test('a zone is drawn by keys alone', async ({ page, yard }) => {
  await page.goto(`${yard.url}/zones/new?site=yard`);
  await pointsAreThere(page);
  await picture(page).focus();
  for (const keys of [['Enter'], ['ArrowRight', 'ArrowRight', 'Enter'], ['ArrowDown', 'ArrowDown', 'Enter'], ['c']]) {
    for (const key of keys) await page.keyboard.press(key);
  }
  await expect(page.getByText(/^3 corners, .*m²/)).toBeVisible();
  const y = page.getByLabel('y of corner 1');
  const before = Number(await y.inputValue());
  await page.keyboard.press(']');
  await page.keyboard.press('Control+ArrowUp');
  await expect(y).toHaveValue(String(Math.round((before + 0.1) * 100) / 100));
  await page.keyboard.press('Control+z');
  await expect(y).toHaveValue(String(before));
});

test('somebody else was faster: both versions stand beside each other', async ({ page, yard, troubles }) => {
  troubles.expect(/412/);
  const made = await yard.post<Zone>('/api/v1/zones', zone);
  await page.goto(`${yard.url}/zones/${made.id}`);
  await expect(page.getByText(/^4 corners, 24\.0/)).toBeVisible();
  await page.getByLabel('To height').fill('2.5');
  const response = await fetch(`${yard.url}/api/v1/zones/${made.id}`, {
    method: 'PUT',
    headers: { 'Content-Type': 'application/json' },
    body: JSON.stringify({ ...zone, name: 'main gate', z_max_m: 4 }),
  });
  expect(response.status).toBe(200);
  const notice = page.getByRole('alert');
  // An event may tell of it before it is saved; if none did, the daemon does.
  await page.getByRole('button', { name: 'Save', exact: true }).click();
  await expect(notice).toContainText('Somebody else has changed this meanwhile');
  await expect(notice.getByRole('row', { name: /Name main gate gate/ })).toBeVisible();
  await expect(notice.getByRole('row', { name: /To 4\.00.m 2\.50.m/ })).toBeVisible();
  await page.getByRole('button', { name: 'Save mine over it' }).click();
  await expect(page.getByText('gate was changed.')).toBeVisible();
  await expect(notice).toHaveCount(0);
  expect(await yard.get(`/api/v1/zones/${made.id}`)).toMatchObject({ name: 'gate', z_max_m: 2.5 });
});

test('a zone that a rule looks into says which; without one it is deleted', async ({ page, yard }) => {
  const made = await yard.post<Zone>('/api/v1/zones', zone);
  const rule = await yard.post<{ id: number }>('/api/v1/rules', { name: 'gate by night', zone: made.id });
  await page.goto(`${yard.url}/zones/${made.id}`);
  await page.getByRole('button', { name: 'Delete …' }).click();
  const dialog = page.getByRole('dialog');
  await expect(dialog.getByRole('link', { name: 'gate by night' })).toBeVisible();
  await expect(dialog.getByRole('button', { name: 'Delete it' })).toHaveCount(0);
  await dialog.getByRole('button', { name: 'Close' }).last().click();
  await fetch(`${yard.url}/api/v1/rules/${rule.id}`, { method: 'DELETE' });
  await page.reload();
  await page.getByRole('button', { name: 'Delete …' }).click();
  await dialog.getByRole('button', { name: 'Delete it' }).click();
  await expect(page).toHaveURL(/\/zones\?site=yard$/);
  await expect(page.getByText('No zone yet: rules look everywhere.')).toBeVisible();
});

test('how much of a zone was seen is shown through time', async ({ page, daemon }) => {
  await daemon.makeYard();
  await daemon.upload(0, 2);
  const made = await daemon.post<Zone>('/api/v1/zones', zone);
  await daemon.upload(2, 5);
  await page.goto(`${daemon.url}/zones`);
  await expect(page.getByRole('row', { name: /gate/ })).toContainText(/\d+.%/);
  await page.goto(`${daemon.url}/zones/${made.id}`);
  await expect(page.getByText(/The latest scan, .* could judge/)).toBeVisible();
  await expect(page.getByRole('img', { name: /judged, of 3 scans/ }).locator('canvas')).toBeVisible();
});

test('nothing is drawn while nothing moves', async ({ page, yard }) => {
  await page.addInitScript(() => {
    const counted = window as unknown as { frames: number };
    counted.frames = 0;
    const request = window.requestAnimationFrame.bind(window);
    window.requestAnimationFrame = (callback) => {
      counted.frames += 1;
      return request(callback);
    };
  });
  const frames = () => page.evaluate(() => (window as unknown as { frames: number }).frames);
  await page.goto(`${yard.url}/zones`);
  await pointsAreThere(page);
  await picture(page).click();
  const before = await frames();
  await page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 400)));
  expect(await frames()).toBe(before);
  await page.mouse.wheel(0, -200);
  await expect.poll(frames).toBeGreaterThan(before);
});

for (const { name, width, colorScheme } of [
  { name: 'wide and light', width: 1280, colorScheme: 'light' as const },
  { name: 'narrow and dark', width: 390, colorScheme: 'dark' as const },
]) {
  test(`zones are accessible and fit, ${name}`, async ({ page, yard }) => {
    const made = await yard.post<Zone>('/api/v1/zones', zone);
    await page.setViewportSize({ width, height: 844 });
    await page.emulateMedia({ colorScheme });
    for (const view of ['/zones', '/zones/new', `/zones/${made.id}`]) {
      await page.goto(yard.url + view);
      await pointsAreThere(page);
      await expect(page.locator('.spinner')).toHaveCount(0);
      expect(await seriousViolations(page), view).toEqual([]);
      await expectNoSidewaysScrolling(page);
    }
  });
}
