// How quick the dashboard is: `npm run bench` measures it in Chromium against the real daemon, and prints a table.
// There is no graphics card in it: Chromium draws in software, so what is told of frames is their script alone.

import { type Page } from '@playwright/test';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { kYard, kYardScans, simulateLab } from './support/build';
import { Daemon } from './support/daemon';
import { expect, test } from './support/fixtures';

const kClouds = [
  { name: '1 million points', density: 9 },
  { name: '5 million points', density: 44 },
] as const;
const kTries = 7;
const kDragSteps = 240;

const told: string[] = [];
const tell = (what: string, figure: string): void => void told.push(`${what.padEnd(64)} ${figure}`);

test.afterAll(() => console.log(`\n${told.join('\n')}\n`));

const sorted = (values: readonly number[]): number[] => [...values].sort((a, b) => a - b);
const quantile = (values: readonly number[], share: number): number =>
  sorted(values)[Math.min(values.length - 1, Math.floor(values.length * share))] ?? NaN;
const spread = (values: readonly number[], unit: string): string =>
  `median ${quantile(values, 0.5).toFixed(1)}, p95 ${quantile(values, 0.95).toFixed(1)}, ` +
  `greatest ${Math.max(...values).toFixed(1)} ${unit} (${values.length})`;

/** Notes how long the script of each frame takes, from the page's start. */
async function timeFrames(page: Page): Promise<void> {
  await page.addInitScript(() => {
    const timed = window as unknown as { scripts_ms: number[] };
    timed.scripts_ms = [];
    const request = window.requestAnimationFrame.bind(window);
    window.requestAnimationFrame = (callback) =>
      request((now_ms) => {
        const begun_ms = performance.now();
        callback(now_ms);
        timed.scripts_ms.push(performance.now() - begun_ms);
      });
  });
}

const scriptsOf = (page: Page): Promise<number[]> =>
  page.evaluate(() => (window as unknown as { scripts_ms: number[] }).scripts_ms.splice(0));

async function atRest(page: Page): Promise<void> {
  await expect
    .poll(
      async () => {
        await scriptsOf(page);
        await page.waitForTimeout(1000);
        return (await scriptsOf(page)).length;
      },
      { timeout: 120_000 },
    )
    .toBe(0);
}

test('first view', async ({ browser, yard }) => {
  const first_ms: number[] = [];
  for (let attempt = 0; attempt < kTries; ++attempt) {
    const context = await browser.newContext(); // nothing cached
    const page = await context.newPage();
    const begun_ms = performance.now();
    await page.goto(yard.url, { waitUntil: 'commit' });
    await page.getByRole('row').filter({ hasText: 'yard-2' }).waitFor();
    await page.locator('.alert-line').first().waitFor();
    first_ms.push(performance.now() - begun_ms);
    await context.close();
  }
  tell('first view: overview with sensors and alerts, nothing cached', spread(first_ms, 'ms'));
});

test('an alert on screen', async ({ page, daemon }) => {
  await page.addInitScript(() => {
    const seen = window as unknown as { alerts: Record<string, number> };
    seen.alerts = {};
    new MutationObserver(() => {
      for (const link of document.querySelectorAll<HTMLAnchorElement>('.alert-row a')) {
        seen.alerts[link.getAttribute('href') ?? ''] ??= Date.now();
      }
    }).observe(document, { childList: true, subtree: true });
  });
  await daemon.makeYard();
  await page.goto(`${daemon.url}/alerts`);
  await daemon.upload(0, kYardScans, kYard);
  const { items } = await daemon.get<{ items: { id: number; at: string; type: string; alert: number }[] }>(
    '/api/v1/events/log?limit=1000',
  );
  await page.waitForTimeout(2000);
  const seen = await page.evaluate(() => (window as unknown as { alerts: Record<string, number> }).alerts);
  const delays_ms = items.flatMap(({ at, type, alert }) => {
    if (type !== 'alert.opened') return [];
    const shown = Object.entries(seen).find(([href]) => new RegExp(`/alerts/${alert}(\\D|$)`).test(href))?.[1];
    return shown === undefined ? [] : [shown - Date.parse(at)];
  });
  expect(delays_ms.length).toBeGreaterThan(0);
  tell('from the commit of an alert to its row on the screen', spread(delays_ms, 'ms'));
});

for (const { name, density } of kClouds) {
  test(name, async ({ page, daemon }) => {
    test.setTimeout(240_000);
    const folder = join(tmpdir(), `raywatch-bench-${density}`);
    simulateLab(folder, density);
    await makeLab(daemon, folder);
    await timeFrames(page);
    const begun_ms = performance.now();
    await page.goto(`${daemon.url}/scans/1/3d?points=10000000`);
    await page.locator('.scene-points').waitFor();
    await expect(page.locator('.scene-points')).toContainText(/[\d,]+ points/);
    tell(`${name}: points on screen after`, `${((performance.now() - begun_ms) / 1000).toFixed(1)} s`);
    await atRest(page);
    tell(`${name}: all loaded after`, `${((performance.now() - begun_ms) / 1000).toFixed(1)} s`);
    tell(`${name}: shown`, (await page.locator('.scene-points').innerText()).replace(/\s+/g, ' '));

    const box = await page.locator('.scene canvas').first().boundingBox();
    if (!box) throw new Error('the scene has no canvas');
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    const client = await page.context().newCDPSession(page);
    await client.send('Performance.enable');
    const total = async (metric: string): Promise<number> =>
      (await client.send('Performance.getMetrics')).metrics.find(({ name: own }) => own === metric)?.value ?? NaN;
    const before_s = await total('ScriptDuration');
    const moving_ms = performance.now();
    await page.mouse.down();
    for (let step = 0; step < kDragSteps; ++step) {
      await page.mouse.move(
        box.x + box.width * (0.5 + 0.3 * Math.sin(step / 20)),
        box.y + box.height * (0.5 + 0.1 * Math.sin(step / 33)),
      );
    }
    await page.mouse.up();
    const moved_ms = performance.now() - moving_ms;
    const scripts_ms = await scriptsOf(page);
    const script_ms = ((await total('ScriptDuration')) - before_s) * 1000;
    tell(`${name}: script of a frame while it is turned`, spread(scripts_ms, 'ms'));
    tell(`${name}: all script, events included, for each frame`, `${(script_ms / scripts_ms.length).toFixed(2)} ms`);
    tell(`${name}: frames a second, drawn in software`, ((scripts_ms.length / moved_ms) * 1000).toFixed(0));
    await atRest(page);
    await page.waitForTimeout(3000);
    const idle = await scriptsOf(page);
    tell(`${name}: frames in 3 s at rest`, String(idle.length));
  });
}

async function makeLab(daemon: Daemon, folder: string): Promise<void> {
  await daemon.post('/api/v1/sites', { name: 'lab', profile: 'indoor', time_zone: 'Europe/Berlin' });
  await daemon.post('/api/v1/sensors', { name: 'lab-1', site: 'lab' });
  await daemon.upload(0, 1, folder, 'lab');
}
