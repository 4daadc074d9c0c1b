import { expect, expectNoSidewaysScrolling, seriousViolations, signIn, test } from './support/fixtures';

const kViews = [
  '/surveys',
  '/surveys/1',
  '/surveys/series?schedule=1',
  '/surveys/schedules/1',
  '/surveys/schedules/new',
  '/surveys/compare',
  '/surveys/runs/5',
];

test('the nights of a site say what moved, how sure that is, and which brought nothing', async ({ page, pit }) => {
  const asked: string[] = [];
  page.on('request', (request) => asked.push(new URL(request.url()).pathname));
  await page.goto(`${pit.url}/surveys`);
  const rows = page.getByRole('table', { name: 'nights of pit' }).locator('tbody tr');
  await expect(rows).toHaveCount(5);
  await expect(rows.first()).toContainText('Thu 5 Mar');
  await expect(rows.first()).toContainText('There are no scans in its window.');
  await expect(rows.nth(1)).toContainText(/[+−][\d,]+\u00a0m³\s*[+−]?[\d,]+ to [+−]?[\d,]+\u00a0m³/);
  await expect(rows.nth(1).locator('.badge').last()).toHaveText(/yellow|orange|red/);
  await expect(rows.last()).toContainText('this one is the first');

  // In the morning: the latest result, and that a night since brought none.
  const latest = page.getByRole('region', { name: 'The latest night' });
  await expect(latest).toContainText('1 night since brought no result');
  await expect(latest).toContainText('Net since the first night');
  await expect(page.getByText('coordinates: EPSG:28350, in metres')).toBeVisible();

  await page.getByLabel('state').selectOption('no_scans');
  await expect(rows).toHaveCount(2);
  await expect(page).toHaveURL(/state=no_scans/);
  await page.getByLabel('state').selectOption('');
  const total = await rows.nth(1).textContent();
  await page.getByLabel('zone').selectOption('bench');
  // The zone is all that there is.
  await expect(rows.nth(1)).toHaveText(total ?? '');
  // The lists say it all; only the latest night is asked for by itself.
  expect(asked.filter((path) => /surveys\/\d+/.test(path)).filter((path) => path !== '/api/v1/surveys/2')).toEqual([]);
  await rows.nth(1).getByRole('link').click();
  await expect(page.getByRole('heading', { name: 'Survey 2', exact: true })).toBeVisible();
});

test('a site without surveys says what to do first', async ({ page, daemon }) => {
  await page.goto(`${daemon.url}/surveys`);
  await expect(page.getByText('There is no site yet.')).toBeVisible();
  await daemon.post('/api/v1/sites', { name: 'quarry', profile: 'survey' });
  await page.reload();
  await expect(page.getByText('No night was surveyed yet.')).toBeVisible();
  await page.getByRole('link', { name: 'Make a schedule' }).click();
  await expect(page.getByRole('heading', { name: 'New schedule' })).toBeVisible();
  await expect(page.getByText('the whole site is surveyed')).toBeVisible();
});

test('a survey shows its figures, its map, what it rests on, and its files', async ({ page, pit }) => {
  await signIn(page, 'anna');
  await page.goto(`${pit.url}/surveys/1`);
  const figures = page.getByRole('table', { name: 'Figures of the zones' });
  for (const name of ['Cut', 'Net of what was not seen', 'Changed area', 'M3C2'])
    await expect(figures.getByRole('row', { name: new RegExp(`^${name}`) }).first()).toContainText(/\d/);
  await expect(figures.getByRole('row', { name: /^Cut in tonnes/ })).toContainText(/\d\u00a0t/);
  await expect(page.getByRole('region', { name: 'Levels and alerts' })).toContainText('Cut, bench');
  await expect(page.getByRole('table', { name: 'changes of survey 1' }).locator('tbody tr').first()).toContainText(
    'm³',
  );

  // By the keyboard: the cell in the middle, then one beside it.
  const map = page.getByRole('application', { name: /difference of both epochs/ });
  await map.focus();
  await page.keyboard.press('ArrowLeft');
  const readout = page.locator('.top-view-readout');
  await expect(readout).toContainText(/x -?[\d.]+\sm, y -?[\d.]+\sm; /);
  const first = await readout.textContent();
  await page.keyboard.press('ArrowUp');
  await expect(readout).not.toHaveText(first ?? '');
  await page.getByRole('button', { name: 'After', exact: true }).click();
  await expect(page).toHaveURL(/map=after/);
  await expect(page.getByText(/height .* to /)).toBeVisible();

  await expect(
    page
      .getByRole('table', { name: /scans of epoch/ })
      .first()
      .locator('tbody tr'),
  ).toHaveCount(2);
  await expect(page.getByText(/fits with a residual of/).first()).toBeVisible();
  for (const name of ['dod.tif', 'after.las', 'map.geojson', 'changes.csv', 'report.html', 'bundle.zip']) {
    const link = page.locator(`a[href="/api/v1/surveys/1/${name}"][download]`);
    const answer = await page.request.get(`${pit.url}${await link.getAttribute('href')}`);
    expect(answer.status(), name).toBe(200);
    expect((await answer.body()).length, name).toBeGreaterThan(100);
  }

  await page.getByRole('button', { name: 'Accept this state …' }).click();
  await page.getByLabel('Note').fill('checked against the total station');
  await page.getByRole('button', { name: 'Accept it' }).click();
  await expect(page.getByText('accepted by anna')).toBeVisible();

  // To the next one, and back.
  await page.keyboard.press('j');
  await expect(page.getByRole('heading', { name: 'Survey 2', exact: true })).toBeVisible();
  await page.keyboard.press('k');
  await expect(page.getByRole('heading', { name: 'Survey 1', exact: true })).toBeVisible();
});

test('a survey that is not there is said to be not there, and what was there stays when the daemon goes', async ({
  page,
  pit,
  troubles,
}) => {
  troubles.expect(/404|ERR_CONNECTION_REFUSED|ERR_INCOMPLETE_CHUNKED_ENCODING|Failed to load resource/);
  await page.goto(`${pit.url}/surveys/99`);
  await expect(page.getByRole('alert')).toContainText('99');
  await page.goto(`${pit.url}/surveys`);
  const rows = page.getByRole('table', { name: 'nights of pit' }).locator('tbody tr');
  await expect(rows).toHaveCount(5);
  await pit.stop();
  await expect(page.getByText(/reconnecting|not live/)).toBeVisible();
  await expect(rows).toHaveCount(5);
});

test('a figure through time has its interval, and says which nights are missing', async ({ page, pit }) => {
  await page.goto(`${pit.url}/surveys/series?schedule=1&figure=cut_m3`);
  await expect(page.getByRole('img', { name: /^Cut: from [\d,.]+ to [\d,.]+ m³/ }).first()).toBeVisible();
  await expect(page.getByText('2 gaps:')).toBeVisible();
  await expect(page.getByText(/This figure has no levels/)).toHaveCount(0);
  await page.getByLabel('figure').selectOption('seen_share');
  await expect(page).toHaveURL(/figure=seen_share/);
  await expect(page.getByRole('img', { name: /^Seen in both epochs: .* %/ })).toBeVisible();
  await expect(page.getByText('This figure has no levels here: it raises no alert.')).toBeVisible();
});

test('a schedule is made, with what is wrong at its field, paused, run and deleted', async ({
  page,
  pit,
  troubles,
}) => {
  troubles.expect(/422/);
  await page.goto(`${pit.url}/surveys/schedules/new`);
  await page.getByLabel('Name').fill('weekly');
  await page.getByLabel('Time (cron)').fill('0 6 * * 1');
  await expect(page.getByText('every Monday at 06:00 (Australia/Perth)')).toBeVisible();
  await page.getByLabel('Time (cron)').fill('0 25 * * 1');
  await page
    .getByRole('group', { name: /^Zones/ })
    .getByLabel('bench')
    .check();
  await page.getByRole('button', { name: 'Add levels' }).click();
  await page.getByRole('button', { name: 'Save' }).click();
  await expect(page.getByText('needs at least one level')).toBeVisible();
  await page.getByLabel('Yellow from').fill('100');
  await page.getByRole('button', { name: 'Save' }).click();
  const cron = page.getByLabel('Time (cron)');
  await expect(cron).toHaveAttribute('aria-invalid', 'true');
  await cron.fill('0 6 * * 1');
  await page.getByLabel('What', { exact: true }).selectOption('days_ago');
  await page.getByLabel('How many').fill('7');
  await page.getByRole('button', { name: 'Save' }).click();
  await expect(page.getByRole('heading', { name: 'weekly' })).toBeVisible();
  const made = (await pit.get<{ items: { name: string; survey: { reference: object } }[] }>('/api/v1/schedules')).items;
  expect(made.find(({ name }) => name === 'weekly')?.survey.reference).toMatchObject({ policy: 'days_ago', days: 7 });

  await page.getByRole('button', { name: 'Pause' }).click();
  await expect(page.getByText('paused', { exact: true })).toBeVisible();
  await page.getByRole('button', { name: 'Run now' }).click();
  await expect(page.getByRole('region', { name: 'Latest runs' })).toContainText('no scans');
  await page.getByRole('button', { name: 'Delete …' }).click();
  await page.getByRole('button', { name: 'Delete it' }).click();
  await expect(page.getByRole('heading', { name: 'Surveys' })).toBeVisible();
  await expect(page.getByRole('link', { name: 'weekly' })).toHaveCount(0);
});

test('two nights are compared by hand, by epochs or times, with what is wrong at its field', async ({
  page,
  pit,
  troubles,
}) => {
  troubles.expect(/422/);
  await page.goto(`${pit.url}/surveys`);
  await page.getByRole('link', { name: 'Compare two nights …' }).click();
  const side = (name: string) => page.getByRole('group', { name, exact: true });
  await expect(side('Before').getByLabel('Epoch')).toHaveValue('2');
  await expect(side('After').getByLabel('Epoch')).toHaveValue('3');

  // What is missing is said before anything is sent, the rest by the daemon.
  await side('Before').getByLabel('By').selectOption('window');
  await page.getByRole('button', { name: 'Compare', exact: true }).click();
  const from = side('Before').getByLabel('From (Australia/Perth)');
  await expect(from).toHaveAccessibleDescription('needs a time');
  await expect(from).toBeFocused();
  await from.fill('2026-03-01T06:00');
  await side('Before').getByLabel('To (Australia/Perth)').fill('2026-03-05T13:00');
  await page.getByLabel('Cells of the models').fill('0');
  await page.getByRole('button', { name: 'Compare', exact: true }).click();
  await expect(page.getByLabel('Cells of the models')).toHaveAccessibleDescription(/must be 0\.02 to 100/);
  await page.getByLabel('Cells of the models').fill('4');
  await page.getByRole('button', { name: 'Compare', exact: true }).click();
  await expect(side('Before').getByLabel('To (Australia/Perth)')).toHaveAccessibleDescription(/must end before/);
  await side('Before').getByLabel('To (Australia/Perth)').fill('2026-03-01T13:00');
  await page.getByLabel('bench').check();
  await page.getByLabel('Density in place').fill('2.65');
  await page.getByLabel('Steepest ground').fill('75');
  await page.getByRole('button', { name: 'Compare', exact: true }).click();

  // Its run stands there until its survey does.
  await expect(page).toHaveURL(/\/surveys\/3$/);
  await expect(page.getByRole('heading', { name: 'Survey 3', exact: true })).toBeVisible();
  await expect(page.getByText('Net against epoch 4')).toBeVisible();
  const made = await pit.get<{ ground: { survey: object } }>('/api/v1/surveys/3');
  expect(made.ground.survey).toMatchObject({
    zones: [1],
    cell_m: 4,
    density_t_per_m3: 2.65,
    greatest_slope_deg: 75,
  });
  await page.getByRole('link', { name: 'Compare these two otherwise' }).click();
  await expect(page.getByLabel('Cells of the models')).toHaveValue('4');
  await expect(side('Before').getByLabel('Epoch')).toHaveValue('4');
  await page.goto(`${pit.url}/surveys`);
  await expect(page.getByRole('table', { name: 'nights of pit' }).locator('tbody tr').first()).toContainText('by hand');
});

test('a run that waits is shown as such, and is cancelled by somebody', async ({ page, pit }) => {
  await signIn(page, 'anna');
  // Fine ones that take their time, so that the last of them waits.
  const survey = { cell_m: 0.06, core_spacing_m: 0.1 };
  let run = { id: 0 };
  for (let number = 0; number < 4; ++number) {
    run = await pit.post<{ id: number }>('/api/v1/surveys', { site: 'pit', before: 1, after: 2, survey });
  }
  await page.goto(`${pit.url}/surveys`);
  const row = page.getByRole('table', { name: 'nights of pit' }).locator('tbody tr').first();
  await expect(row).toContainText('waiting');
  await expect(row.getByRole('button', { name: `Cancel run ${run.id}` })).toBeVisible();
  await row.getByRole('link').click();
  await expect(page.getByText('It waits for its turn.')).toBeVisible();
  await page.getByRole('button', { name: `Cancel run ${run.id}` }).click();
  await page.getByLabel(/^Note/).fill('the wrong nights');
  await page.getByRole('button', { name: 'Cancel it' }).click();
  await expect(page.getByRole('region', { name: 'How far it is' })).toContainText('the wrong nights');
  await expect(page.locator('.view-head')).toContainText('cancelled');
  const made = await pit.get<{ state: string; why: string }>(`/api/v1/surveys/runs/${run.id}`);
  expect(made).toMatchObject({ state: 'cancelled', why: expect.stringContaining('anna') as unknown });
});

test('a run that brought nothing says why, and cannot be cancelled any more', async ({ page, pit }) => {
  await page.goto(`${pit.url}/surveys/runs/5`);
  await expect(page.getByText('There are no scans in its window.').first()).toBeVisible();
  await expect(page.getByRole('region', { name: 'Log of its run' })).toContainText('0 scans from');
  await expect(page.getByRole('button', { name: /^Cancel/ })).toHaveCount(0);
});

for (const colorScheme of ['light', 'dark'] as const) {
  for (const viewport of [
    { width: 1280, height: 800 },
    { width: 390, height: 844 },
  ]) {
    test(`views of surveys are usable by all, ${colorScheme}, ${viewport.width} px wide`, async ({ page, pit }) => {
      await page.setViewportSize(viewport);
      await page.emulateMedia({ colorScheme, reducedMotion: 'reduce' });
      for (const view of kViews) {
        await page.goto(pit.url + view);
        await expect(page.getByRole('heading', { level: 1 })).toBeVisible();
        await expect(page.locator('.spinner')).toHaveCount(0);
        expect(await seriousViolations(page), view).toEqual([]);
        await expectNoSidewaysScrolling(page);
      }
    });
  }
}
