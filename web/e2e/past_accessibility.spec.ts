import { expect, seriousViolations, test } from './support/fixtures';

const kViews = [
  ['/history', '/history?site=yard&point=17.828,3.973,0.402&interval=2'],
  ['/tracks', '/tracks/1'],
  ['/comparisons', '/comparisons/20', '/compare?scan=10&reference=scans', '/compare?scan=10&reference=window'],
];
const kLooks = [
  { name: 'wide and light', width: 1280, colorScheme: 'light' as const },
  { name: 'narrow and dark', width: 390, colorScheme: 'dark' as const },
];

for (const views of kViews) {
  for (const { name, width, colorScheme } of kLooks) {
    test(`axe-core finds nothing serious in ${views[0]}, ${name}`, async ({ page, yard }) => {
      await page.setViewportSize({ width, height: 844 });
      await page.emulateMedia({ colorScheme });
      for (const view of views) {
        await page.goto(yard.url + view);
        await expect(page.getByRole('heading', { level: 1 })).toBeVisible();
        await expect(page.locator('.spinner')).toHaveCount(0);
        expect(await seriousViolations(page), view).toEqual([]);
      }
    });
  }
}
