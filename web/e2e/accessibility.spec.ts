import { expect, seriousViolations, test } from './support/fixtures';

const kViews = [
  '/',
  '/alerts',
  '/alerts?state=all',
  '/alerts/1',
  '/scans',
  '/scans/12',
  '/sensors',
  '/sensors/yard-1',
  '/baselines',
  '/silences',
];
const kLooks = [
  { name: 'wide and light', width: 1280, colorScheme: 'light' as const },
  { name: 'narrow and dark', width: 390, colorScheme: 'dark' as const },
];

for (const { name, width, colorScheme } of kLooks) {
  test(`axe-core finds nothing serious, ${name}`, async ({ page, yard }) => {
    await page.setViewportSize({ width, height: 844 });
    await page.emulateMedia({ colorScheme });
    for (const view of kViews) {
      await page.goto(yard.url + view);
      await expect(page.locator('.spinner')).toHaveCount(0);
      await page.waitForLoadState('domcontentloaded');
      expect(await seriousViolations(page), view).toEqual([]);
    }
    await page.keyboard.press('?');
    await expect(page.getByRole('dialog', { name: 'Keys' })).toBeVisible();
    expect(await seriousViolations(page), 'a dialog').toEqual([]);
  });
}

test('the first stop of the keyboard leads past the menu', async ({ page, yard }) => {
  await page.goto(yard.url);
  await expect(page.getByRole('heading', { name: 'Overview' })).toBeVisible();
  await page.keyboard.press('Tab');
  await expect(page.getByRole('link', { name: 'Skip to the content' })).toBeFocused();
  await page.keyboard.press('Enter');
  await expect(page.locator('main')).toBeFocused();
});
