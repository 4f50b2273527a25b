// `npm run pictures`: the pictures of doc/calibration.md, of the simulated log that the Alpha Calibrator opens with.

import { mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { chromium } from '@playwright/test';
import { CHROME_ARGUMENTS, ensureBrowser } from './browser.mjs';
import { build } from './build.mjs';
import { ROOT, runAsScript } from './process.mjs';
import { serve } from './serve.mjs';

const DIRECTORY = join(ROOT, 'doc/calibration');

/** As wide as those of README. */
const VIEW = { viewport: { width: 1000, height: 900 }, reducedMotion: /** @type {const} */ ('reduce') };

/** On both sides of a fold, pixels: letters of its charts are wider than it. */
const ROOM = 8;

/** Each with the attributes of the figure, the fold that it is of, and what is chosen there. @type {Record<string, [attributes: string, fold: string, choice?: string]>} */
const PICTURES = {
  askew: ['mountyaw="false"', 'Why these α’s', 'way'],
  straight: ['', 'Why these α’s', 'way'],
  doubts: ['', 'Doubts'],
  inflation: ['', 'Inflate'],
  lengths: ['bylength', 'Other lengths'],
};

async function take() {
  await build();
  const { chrome } = await ensureBrowser();
  const { address, close } = await serve(join(ROOT, 'dist'));
  const browser = await chromium.launch({ executablePath: chrome, args: CHROME_ARGUMENTS });
  mkdirSync(DIRECTORY, { recursive: true });
  try {
    for (const [name, [attributes, fold, choice]] of Object.entries(PICTURES)) {
      const page = await browser.newPage(VIEW);
      await page.route('**/figure.html', (route) =>
        route.fulfill({
          contentType: 'text/html',
          body: `<!doctype html><title>${name}</title><alpha-calibrator ${attributes}></alpha-calibrator><script type="module" src="/motion-widgets.js"></script>`,
        }),
      );
      await page.goto(new URL('/figure.html', address).href);
      const details = page.locator('alpha-calibrator details', { hasText: fold });
      await details.locator('summary').click();
      if (choice) await details.getByRole('radio', { name: choice }).check();
      // What is being computed is finished for who asks, and drawn in the next frames.
      await page.locator('alpha-calibrator').evaluate((element) => /** @type {any} */ (element).stats);
      await page.evaluate('new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(drawn))))');
      const { x, y, width, height } = /** @type {NonNullable<Awaited<ReturnType<typeof details.boundingBox>>>} */ (await details.boundingBox());
      const clip = { x: x - ROOM, y, width: width + 2 * ROOM, height };
      await page.screenshot({ path: join(DIRECTORY, `${name}.png`), clip, fullPage: true });
      await page.close();
    }
  } finally {
    await browser.close();
    close();
  }
}

await runAsScript(import.meta.url, take);
