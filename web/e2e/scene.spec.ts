import { type Locator, type Page } from '@playwright/test';
import { kYardScans } from './support/build';
import { type Daemon } from './support/daemon';
import { expect, expectNoSidewaysScrolling, seriousViolations, test } from './support/fixtures';
import { countFrames, framesOf, pixelsLike } from './support/picture';

interface ChangeJson {
  id: number;
  kind: string;
  scan: number;
  comparison: number;
}

async function changeOf(daemon: Daemon, kind: string): Promise<ChangeJson> {
  const { items } = await daemon.get<{ items: ChangeJson[] }>(`/api/v1/changes?site=yard&kind=${kind}`);
  const change = items[0];
  if (!change) throw new Error(`the yard has nothing that was ${kind}`);
  return change;
}

// As tokens.css has them.
const kAdded = [31, 209, 155] as const;
const kRemoved = [255, 122, 31] as const;
const kRay = [86, 180, 233] as const;

const stageOf = (page: Page): Locator => page.locator('.scene');

/** The picture with all its points. */
async function picture(page: Page): Promise<Locator> {
  await expect(page.locator('.scene-points')).toContainText(/[\d,]+ points?/);
  return stageOf(page);
}

test('an alert leads to its change in 3D, with its figures', async ({ page, yard }) => {
  await page.goto(`${yard.url}/alerts`);
  await page
    .getByRole('link', { name: /was added/ })
    .first()
    .click();
  await page.getByRole('link', { name: /in 3D/ }).first().click();
  await expect(page).toHaveURL(/\/changes\/\d+$/);
  await expect(page.getByRole('heading', { name: /^Change \d+$/ })).toBeVisible();
  const figures = page.getByRole('region', { name: 'Figures' });
  await expect(figures).toContainText(/[\d.]+ × [\d.]+ × [\d.]+\sm/);
  await expect(figures.getByRole('link', { name: /^scan \d+$/ }).first()).toBeVisible();
  const stage = await picture(page);
  await expect.poll(() => pixelsLike(stage, kAdded)).toBeGreaterThan(50);
});

test('nothing is drawn while nothing moves, and keys move it', async ({ page, yard }) => {
  await countFrames(page);
  const change = await changeOf(yard, 'added');
  await page.goto(`${yard.url}/changes/${change.id}`);
  await picture(page);
  const atRest = async (): Promise<number> => {
    let before = -1;
    await expect
      .poll(async () => {
        const now = await framesOf(page);
        const same = now === before;
        before = now;
        return same;
      })
      .toBe(true);
    return before;
  };
  const still = await atRest();
  await page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 1000)));
  expect(await framesOf(page), 'no frame in a second at rest').toBe(still);

  await page.locator('canvas.scene-canvas').focus();
  await page.keyboard.press('ArrowLeft');
  await expect.poll(() => framesOf(page)).toBeGreaterThan(still);
  const moved = await atRest();
  await page.mouse.move(600, 400);
  await page.mouse.down();
  await page.mouse.move(680, 420, { steps: 4 });
  await page.mouse.up();
  await expect.poll(() => framesOf(page)).toBeGreaterThan(moved);
  await atRest();
});

test('before and after are swiped, by hand and by keys, and the link keeps it', async ({ page, yard }) => {
  const change = await changeOf(yard, 'removed');
  await page.goto(`${yard.url}/changes/${change.id}`);
  const stage = await picture(page);
  await expect.poll(() => pixelsLike(stage, kRemoved)).toBeGreaterThan(50);
  await page.keyboard.press('b');
  const border = page.getByRole('slider', { name: 'Border between before and after' });
  await expect(border).toHaveAttribute('aria-valuenow', '50');
  await expect(stage).toContainText(/Before: scan \d+/);
  // What is gone belongs to the picture before: none of it is left when all shows the one after, but for the box.
  await border.focus();
  await page.keyboard.press('End');
  await expect(border).toHaveAttribute('aria-valuenow', '100');
  await expect(page).toHaveURL(/swipe=100/);
  const all = await pixelsLike(stage, kRemoved);
  await page.keyboard.press('Home');
  await expect(border).toHaveAttribute('aria-valuenow', '0');
  await expect.poll(() => pixelsLike(stage, kRemoved)).toBeLessThan(all);
  await page.keyboard.press('ArrowRight');
  await expect(page).toHaveURL(/swipe=4/);
  await page.reload();
  await expect(border).toHaveAttribute('aria-valuenow', '4');
  const box = await border.boundingBox();
  await page.mouse.move((box?.x ?? 0) + 10, (box?.y ?? 0) + 300);
  await page.mouse.down();
  await page.mouse.move((box?.x ?? 0) + 210, (box?.y ?? 0) + 300, { steps: 3 });
  await page.mouse.up();
  await expect.poll(async () => Number(await border.getAttribute('aria-valuenow'))).toBeGreaterThan(20);
  await page.keyboard.press('b');
  await expect(border).toBeHidden();
});

test('the rays that prove a change are shown, and where they were sent from', async ({ page, yard }) => {
  const change = await changeOf(yard, 'added');
  await page.goto(`${yard.url}/changes/${change.id}?view=sensor`);
  const stage = await picture(page);
  await page.getByRole('button', { name: 'Rays' }).click();
  await expect(page.getByRole('button', { name: 'Rays' })).toHaveAttribute('aria-pressed', 'true');
  await expect(page).toHaveURL(/rays=1/);
  // They are faint: two fifths of their colour over the ground.
  const faint = kRay.map((part, index) => Math.round(part * 0.4 + ([12, 17, 23][index] ?? 0) * 0.6));
  await expect.poll(() => pixelsLike(stage, faint as unknown as typeof kRay)).toBeGreaterThan(200);
});

test('distances are measured with the keyboard alone', async ({ page, yard }) => {
  const change = await changeOf(yard, 'removed');
  await page.goto(`${yard.url}/changes/${change.id}?view=top`);
  await picture(page);
  await page.keyboard.press('m');
  await expect(page.getByText('Click a point, or bring it to the cross and press Enter.')).toBeVisible();
  await page.locator('canvas.scene-canvas').focus();
  for (const step of ['first', 'second']) {
    // Nearer, until a point lies at the cross.
    for (let tries = 0; tries < 12; ++tries) {
      await page.keyboard.press('Enter');
      const taken = page.getByText(step === 'first' ? 'Now the other point.' : /level,/);
      const isTaken = await taken.waitFor({ timeout: 500 }).then(
        () => true,
        () => false,
      );
      if (isTaken) break;
      await page.keyboard.press('Shift+ArrowDown');
    }
    if (step === 'first') for (const _ of [1, 2, 3]) await page.keyboard.press('Shift+ArrowLeft');
  }
  await expect(page.locator('.scene-measure')).toHaveText(/^\d+\.\d{3}\sm$/);
  await page.keyboard.press('Escape');
  await expect(page.locator('.scene-measure')).toBeHidden();
});

test('a click says which place it is', async ({ page, yard }) => {
  const change = await changeOf(yard, 'added');
  await page.goto(`${yard.url}/changes/${change.id}`);
  const stage = await picture(page);
  await expect.poll(() => pixelsLike(stage, kAdded)).toBeGreaterThan(50);
  await page.locator('canvas.scene-canvas').click(); // in the middle, where the change is
  await expect(page.locator('.scene-note')).toContainText(/\(-?[\d.]+, -?[\d.]+, -?[\d.]+\)\sm/);
  await page.keyboard.press('Escape');
  await expect(page.locator('.scene-note')).toBeHidden();
});

test('a whole scan shows all that was found, and a scan without changes says so', async ({ page, yard }) => {
  const change = await changeOf(yard, 'added');
  await page.goto(`${yard.url}/scans/${change.scan}/3d`);
  const list = page.getByRole('region', { name: 'Changes' });
  await expect(list.getByRole('link').first()).toBeVisible();
  await picture(page);
  await expect(page.locator('.scene-label a').first()).toHaveText(/added|removed/);
  await list.getByRole('link', { name: `Change ${change.id}` }).click();
  await expect(page).toHaveURL(new RegExp(`/changes/${change.id}$`));
  await page.goto(`${yard.url}/scans/1/3d`);
  await expect(page.getByText('There was no earlier scan to compare it with.')).toBeVisible();
  await picture(page);
  await page.goto(`${yard.url}/comparisons/${change.comparison}/3d`);
  await expect(page.getByRole('heading', { name: `Scan ${change.scan} in 3D` })).toBeVisible();
});

test('where there is no WebGL, or it is taken away, the page says so and the rest stands', async ({ page, yard }) => {
  const change = await changeOf(yard, 'added');
  await page.goto(`${yard.url}/changes/${change.id}`);
  await picture(page);
  await page.locator('canvas.scene-canvas').evaluate((canvas: HTMLCanvasElement) => {
    canvas.getContext('webgl2')?.getExtension('WEBGL_lose_context')?.loseContext();
  });
  await expect(page.getByText('The graphics card took the picture away.')).toBeVisible();
  await expect(page.getByRole('region', { name: 'Panorama' }).locator('canvas')).toBeVisible();
  await page.getByRole('button', { name: 'Try again' }).click();
  await expect.poll(() => pixelsLike(stageOf(page), kAdded)).toBeGreaterThan(50);

  await page.addInitScript(() => {
    const getContext = HTMLCanvasElement.prototype.getContext as (this: HTMLCanvasElement, kind: string) => unknown;
    HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, kind: string) {
      return kind === 'webgl2' ? null : getContext.call(this, kind);
    } as never;
  });
  await page.reload();
  await expect(page.getByText('There is no 3D picture here.')).toBeVisible();
  await expect(page.getByRole('region', { name: 'Figures' })).toBeVisible();
});

test('the panorama outlines changes, and is read by pointer and by keys', async ({ page, yard }) => {
  const change = await changeOf(yard, 'removed');
  await page.goto(`${yard.url}/scans/${change.scan}`);
  const panorama = page.getByRole('region', { name: 'Panorama' });
  const image = panorama.getByRole('application');
  await expect(image).toBeVisible();
  await image.hover();
  await expect(panorama.getByRole('status')).toContainText(/at azimuth -?[\d.]+°, elevation -?[\d.]+°/);
  await image.focus();
  await page.keyboard.press('ArrowDown');
  await page.keyboard.press('Shift+ArrowRight');
  await expect(panorama.getByRole('status')).toContainText(/[\d.]+\sm at azimuth|nothing seen/);
  await panorama.getByRole('link', { name: `Change ${change.id}, removed` }).click();
  await expect(page).toHaveURL(new RegExp(`/changes/${change.id}$`));
  await page.goto(`${yard.url}/sensors/yard-1`);
  await expect(page.getByRole('region', { name: 'Panorama' }).getByRole('application')).toBeVisible();
});

for (const { width, colorScheme } of [
  { width: 1280, colorScheme: 'light' as const },
  { width: 390, colorScheme: 'dark' as const },
]) {
  test(`the 3D views have no serious fault for axe-core and fit ${width} pixels`, async ({ page, yard }) => {
    await page.setViewportSize({ width, height: 844 });
    await page.emulateMedia({ colorScheme });
    const change = await changeOf(yard, 'added');
    for (const view of [`/changes/${change.id}?swipe=50`, `/scans/${change.scan}/3d`, `/scans/${kYardScans}`]) {
      await page.goto(yard.url + view);
      await expect(page.locator('.scene, .panorama').first()).toBeVisible();
      await expect(page.locator('.spinner')).toHaveCount(0);
      await expectNoSidewaysScrolling(page);
      expect(await seriousViolations(page), view).toEqual([]);
    }
  });
}
