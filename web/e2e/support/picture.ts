// What a 3D view shows and does, seen from outside: the colours on the screen, and the frames that were drawn.

import { type Locator, type Page } from '@playwright/test';

/** How many pixels of an element on the screen have nearly a colour. */
export async function pixelsLike(element: Locator, colour: readonly [number, number, number]): Promise<number> {
  const png = (await element.screenshot()).toString('base64');
  return element.page().evaluate(
    async ({ bytes, wanted }) => {
      const blob = new Blob([Uint8Array.from(atob(bytes), (letter) => letter.charCodeAt(0))]);
      const image = await createImageBitmap(blob);
      const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
      context?.drawImage(image, 0, 0);
      const { data } = context?.getImageData(0, 0, image.width, image.height) ?? { data: new Uint8ClampedArray() };
      let count = 0;
      for (let at = 0; at < data.length; at += 4) {
        if (wanted.every((part, channel) => Math.abs((data[at + channel] ?? 0) - part) < 24)) ++count;
      }
      return count;
    },
    { bytes: png, wanted: colour },
  );
}

/** Counts the frames that a page draws with WebGL, from its start. */
export async function countFrames(page: Page): Promise<void> {
  await page.addInitScript(() => {
    const counted = window as unknown as { framesDrawn: number };
    counted.framesDrawn = 0;
    const { clear } = WebGL2RenderingContext.prototype;
    WebGL2RenderingContext.prototype.clear = function (mask: number) {
      ++counted.framesDrawn;
      clear.call(this, mask);
    };
  });
}

export const framesOf = (page: Page): Promise<number> =>
  page.evaluate(() => (window as unknown as { framesDrawn: number }).framesDrawn);
