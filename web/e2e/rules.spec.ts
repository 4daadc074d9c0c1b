import { expect, expectNoSidewaysScrolling, seriousViolations, test } from './support/fixtures';

interface Rule {
  id: number;
  name: string;
}

test('a rule is made in words, tried on the past before it is saved, and edited', async ({ page, yard }) => {
  await page.goto(`${yard.url}/rules`);
  await expect(page.getByRole('row', { name: /anything that lasts/ })).toContainText('Warns when anything is added');
  await page.getByRole('link', { name: 'New rule' }).click();
  await page.getByLabel('Name', { exact: true }).fill('a crate is taken');
  await page.getByLabel('Severity').selectOption('critical');
  await page.getByLabel('added: free before').uncheck();
  const sentence = page.locator('.rule-sentence');
  await expect(sentence).toContainText(
    'Raises a critical alert when anything is removed anywhere, seen in 2 of the last 3',
  );

  // The crate that was taken would have alerted, nothing as large as a house.
  await page.getByRole('button', { name: 'Try it' }).click();
  const tried = page.getByRole('table', { name: /would have been raised/ }).locator('tbody tr');
  await expect(tried.first()).toContainText('critical');
  await expect(tried.first().getByRole('link', { name: /^scan \d+$/ })).toBeVisible();
  await expect(page.getByText('2026-03-01')).toBeVisible();
  await expect(page.getByText(/^1 alert\.$/)).toBeVisible();
  await page.getByLabel('Longest side at least').fill('30');
  await page.getByRole('button', { name: 'Try it' }).click();
  await expect(page.getByText('Nothing would have alerted in that time.')).toBeVisible();
  await page.getByLabel('Longest side at least').fill('0.1');

  await page.getByRole('button', { name: 'Only at certain hours' }).click();
  await page.getByRole('button', { name: 'Sat', exact: true }).click();
  await page.getByRole('button', { name: 'Sun', exact: true }).click();
  await expect(sentence).toContainText('Mon to Fri from 20:00 to 06:00 (the next day)');
  await page.getByRole('button', { name: 'Save' }).click();
  await expect(page.getByRole('heading', { name: 'a crate is taken' })).toBeVisible();
  const { items } = await yard.get<{ items: Rule[] }>('/api/v1/rules?site=yard');
  expect(items.find(({ name }) => name === 'a crate is taken')).toMatchObject({
    kinds: ['removed'],
    severity: 'critical',
    min_extent_m: 0.1,
    persistence: { scans: 2, of: 3, seconds: 20 },
    schedule: [{ days: ['mon', 'tue', 'wed', 'thu', 'fri'], from: '20:00', to: '06:00' }],
  });

  // Sunday morning is out of its hours; as it is saved it says so.
  await page.getByRole('button', { name: 'Take hours 1 away' }).click();
  await page.getByRole('button', { name: 'Try it' }).click();
  await expect(page.getByText(/; as it is saved: 0 alerts/)).toBeVisible();
  await page.getByRole('button', { name: 'Save' }).click();
  await expect(page.getByText('a crate is taken was changed.')).toBeVisible();
  await expect(page.getByText('It holds at all hours.')).toBeVisible();
});

test('a rule that cannot be says so at its fields', async ({ page, yard, troubles }) => {
  troubles.expect(/409|422/);
  await page.goto(`${yard.url}/rules/new?site=yard`);
  await page.getByLabel('Seen in').fill('4');
  await page.getByRole('button', { name: 'Save' }).click();
  await expect(page.getByText('needs a name')).toBeVisible();
  await expect(page.getByText('must be at least 4: it is seen in so many of these')).toBeVisible();
  await page.getByLabel('Name', { exact: true }).fill('far too many');
  await page.getByLabel('of the last').fill('400');
  await page.getByRole('button', { name: 'Save' }).click();
  await expect(page.getByLabel('of the last')).toHaveAttribute('aria-invalid', 'true');
  await expect(page.locator('.field-bad')).toContainText('64');
});

test('of two who edit a rule, the second sees what the first did', async ({ page, yard, troubles }) => {
  troubles.expect(/412/);
  const body = { site: 'yard', name: 'crates', kinds: ['removed'] };
  const rule = await yard.post<Rule>('/api/v1/rules', body);
  await page.goto(`${yard.url}/rules/${rule.id}`);
  await page.getByLabel('At least', { exact: true }).fill('50');
  await fetch(`${yard.url}/api/v1/rules/${rule.id}`, {
    method: 'PUT',
    headers: { 'Content-Type': 'application/json' },
    body: JSON.stringify({ ...body, severity: 'info' }),
  });
  await page.getByRole('button', { name: 'Save', exact: true }).click();
  const notice = page.getByRole('alert');
  await expect(notice).toContainText('Notes when anything is removed');
  await page.getByRole('button', { name: 'Take what is there now' }).click();
  await expect(notice).toHaveCount(0);
  await expect(page.getByLabel('Severity')).toHaveValue('info');
  await expect(page.getByLabel('At least', { exact: true })).toHaveValue('');
});

test('a rule is deleted after a question', async ({ page, yard }) => {
  await page.goto(`${yard.url}/rules`);
  await page.getByRole('link', { name: 'large things' }).click();
  await page.getByRole('button', { name: 'Delete …' }).click();
  await expect(page.getByRole('button', { name: 'Keep it' })).toBeFocused();
  await page.getByRole('button', { name: 'Delete it' }).click();
  await expect(page.getByText('The rule large things was deleted.')).toBeVisible();
  await expect(page.getByRole('table').locator('tbody tr')).toHaveCount(2);
});

for (const { name, width, colorScheme } of [
  { name: 'wide and dark', width: 1280, colorScheme: 'dark' as const },
  { name: 'narrow and light', width: 390, colorScheme: 'light' as const },
]) {
  test(`rules are accessible and fit, ${name}`, async ({ page, yard }) => {
    await page.setViewportSize({ width, height: 844 });
    await page.emulateMedia({ colorScheme });
    for (const view of ['/rules', '/rules/new', '/rules/1']) {
      await page.goto(yard.url + view);
      await expect(page.getByRole('heading', { level: 1 })).toBeVisible();
      await expect(page.locator('.spinner')).toHaveCount(0);
      if (view === '/rules/1') {
        await page.getByRole('button', { name: 'Only at certain hours' }).click();
        await page.getByRole('button', { name: 'Try it' }).click();
        await expect(page.getByText(/as it is saved: \d+ alert/)).toBeVisible();
      }
      expect(await seriousViolations(page), view).toEqual([]);
      await expectNoSidewaysScrolling(page);
    }
  });
}
