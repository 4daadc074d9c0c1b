// Fingers on pictures: one moves, two come nearer.

import { type CDPSession, type Locator } from '@playwright/test';
import { expect, test } from './support/fixtures';
import { countFrames, framesOf } from './support/picture';

test.use({ hasTouch: true, viewport: { width: 390, height: 844 } });

type Point = readonly [x: number, y: number];

/** Puts fingers down, moves them in steps, and lifts them. */
async function fingers(session: CDPSession, from: readonly Point[], to: readonly Point[]): Promise<void> {
  const kSteps = 4;
  const at = (share: number) =>
    from.map(([x, y], id) => ({
      id,
      x: x + ((to[id]?.[0] ?? x) - x) * share,
      y: y + ((to[id]?.[1] ?? y) - y) * share,
    }));
  await session.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: at(0) });
  for (let step = 1; step <= kSteps; ++step)
    await session.send('Input.dispatchTouchEvent', { type: 'touchMove', touchPoints: at(step / kSteps) });
  await session.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
}

async function middleOf(element: Locator): Promise<Point> {
  await element.scrollIntoViewIfNeeded();
  const box = await element.boundingBox();
  if (!box) throw new Error('it is not shown');
  return [box.x + box.width / 2, box.y + box.height / 2];
}

test('the map of a survey is moved by a finger, and two bring it nearer', async ({ page, pit }) => {
  await page.goto(`${pit.url}/surveys/1`);
  const map = page.getByRole('application', { name: /difference of both epochs/ });
  const [x, y] = await middleOf(map);
  const session = await page.context().newCDPSession(page);
  const pictures = [(await map.screenshot()).toString('base64')];
  const another = async (): Promise<void> => {
    await expect.poll(async () => pictures.includes((await map.screenshot()).toString('base64'))).toBe(false);
    pictures.push((await map.screenshot()).toString('base64'));
  };
  await fingers(session, [[x, y]], [[x + 60, y + 40]]);
  await another();
  const apart = (by: number): Point[] => [
    [x - by, y],
    [x + by, y],
  ];
  await fingers(session, apart(30), apart(120));
  await another();
  // The page stayed where it was: the gesture is the map's.
  expect((await middleOf(map))[1]).toBeCloseTo(y, 0);
  await page.getByRole('button', { name: 'Show all' }).click();
  await expect.poll(async () => (await map.screenshot()).toString('base64') === pictures.at(-1)).toBe(false);
});

test('the 3D view turns by a finger, and two bring it nearer', async ({ page, yard }) => {
  await countFrames(page);
  await page.goto(`${yard.url}/scans/14/3d`);
  const scene = page.locator('.scene canvas').first();
  await expect(scene).toBeVisible();
  const settled = async (): Promise<number> => {
    let before = -1;
    await expect
      .poll(async () => {
        const now = await framesOf(page);
        const same = now === before && now > 0;
        before = now;
        return same;
      })
      .toBe(true);
    return before;
  };
  const first = await settled();
  const [x, y] = await middleOf(scene);
  const session = await page.context().newCDPSession(page);
  await fingers(session, [[x, y]], [[x + 50, y + 20]]);
  const turned = await settled();
  expect(turned).toBeGreaterThan(first);
  await fingers(
    session,
    [
      [x - 30, y],
      [x + 30, y],
    ],
    [
      [x - 100, y],
      [x + 100, y],
    ],
  );
  expect(await settled()).toBeGreaterThan(turned);
});
