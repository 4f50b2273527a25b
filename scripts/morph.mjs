// `node scripts/morph.mjs`: records the animation in README, in which the Banana Machine's cloud is deformed from one view to the other.

import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { CHROME_ARGUMENTS, ensureBrowser } from './browser.mjs';
import { buildProject } from './build.mjs';
import { REPOSITORY_ROOT, runOrThrow, runAsScript } from './process.mjs';
import { startServer } from './serve.mjs';

/** Width of the figure, at which the figure shows a single picture, and font size of the figure. */
const FIGURE_WIDTH_PX = 690;
const FONT_SIZE_PX = 24;

/** Number of frames of the animation, the duration of each frame, and the longer duration of the first and last frame. */
const FRAME_COUNT = 24;
const FRAME_DURATIONS_MS = { each: 100, end: 1600 };

await runAsScript(import.meta.url, async () => {
  await buildProject({ isLocal: true });
  const { chromium } = await import('@playwright/test');
  const browser = await chromium.launch({ executablePath: (await ensureBrowser()).chromePath, args: CHROME_ARGUMENTS });
  const { address: serverAddress, close: closeServer } = await startServer(join(REPOSITORY_ROOT, 'dist'), { port: 0 });
  const frameDirectory = mkdtempSync(join(tmpdir(), 'morph-'));
  try {
    const page = await browser.newPage({ viewport: { width: FIGURE_WIDTH_PX, height: 1350 } });
    await page.goto(`${serverAddress}embed.html?widget=banana-machine`);
    await page.addStyleTag({ content: `body { margin: 0; font-size: ${FONT_SIZE_PX}px }` });
    const bananaMachine = page.locator('banana-machine');
    await bananaMachine.locator('.folds').waitFor();
    await page.waitForFunction(() => !(/** @type {any} */ (document.querySelector('banana-machine')).playing));
    await page.waitForTimeout(1500);
    const { y, height } = (await bananaMachine.locator('.morphing').boundingBox()) ?? { y: 0, height: 0 };
    const clipBox = { x: 0, y: 0, width: FIGURE_WIDTH_PX, height: y + height };
    const frameArguments = [];
    for (let i = 0; i <= FRAME_COUNT; i++) {
      const morphShare = (1 - Math.cos((Math.PI * i) / FRAME_COUNT)) / 2;
      await bananaMachine.evaluate((element, morphAttribute) => element.setAttribute('morph', String(morphAttribute)), morphShare);
      await page.waitForTimeout(100);
      const framePath = join(frameDirectory, `${i}.png`);
      await page.screenshot({ path: framePath, clip: clipBox });
      frameArguments.push('-d', String(i % FRAME_COUNT === 0 ? FRAME_DURATIONS_MS.end : FRAME_DURATIONS_MS.each), framePath);
    }
    await runOrThrow('img2webp is missing: install the package webp.', 'img2webp', ['-loop', '0', '-lossy', '-q', '50', '-m', '6', ...frameArguments, '-o', join(REPOSITORY_ROOT, 'doc/morph.webp')]);
  } finally {
    await browser.close();
    closeServer();
    rmSync(frameDirectory, { recursive: true });
  }
});
