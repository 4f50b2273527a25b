// `npm run bench`: the targets of doc/benchmarks.md, measured in Node and in headless Chromium. It prints tables in Markdown and
// writes the measurements to build/bench.json. `-- --quick` takes fewer turns.

import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { cpus } from 'node:os';
import { join } from 'node:path';
import { CHROME_ARGUMENTS, ensureBrowser } from './browser.mjs';
import { build } from './build.mjs';
import { EXAMPLE_LOGS } from './example-log.mjs';
import { Missing, ROOT, progress, run, runAsScript } from './process.mjs';
import { serve } from './serve.mjs';
import { nativeRust } from './toolchain.mjs';
import { report } from '../benches/report.js';

/** Headers that isolate the page, for a clock in steps of 5 µs instead of 100. */
const ISOLATED = { 'cross-origin-opener-policy': 'same-origin', 'cross-origin-embedder-policy': 'require-corp' };

/** @typedef {{ quick: boolean, log: { odometry: string, reference: string } }} Options */

/** @param {boolean} quick */
async function bench(quick) {
  // As it ships: the local build is not optimized.
  await build();
  const [odometry, reference] = [EXAMPLE_LOGS.odometry, EXAMPLE_LOGS.reference].map((path) => readFileSync(join(ROOT, path), 'utf8'));
  const options = { quick, log: { odometry, reference } };
  const machine = await describe();
  progress('Node');
  const node = await inNode(options);
  const browser = await ensureBrowser();
  progress('Chromium');
  const results = { ...machine, chromiumVersion: browser.version, quick, node, ...(await inChromium(browser.chrome, options)) };
  mkdirSync(join(ROOT, 'build'), { recursive: true });
  writeFileSync(join(ROOT, 'build/bench.json'), `${JSON.stringify(results, null, 2)}\n`);
  console.log(`\n${report(results)}\n\nbuild/bench.json has all measurements.`);
}

/** Describes the machine and the versions. */
async function describe() {
  const commit = await run('git', ['describe', '--always', '--dirty'], { quiet: true });
  const { description } = await nativeRust();
  return {
    date: new Date().toISOString(),
    commit: commit.ok ? commit.stdout.trim() : 'unknown',
    processor: cpus()[0].model,
    cores: cpus().length,
    nodeVersion: process.versions.node,
    rustVersion: description,
  };
}

/** @param {Options} options */
async function inNode(options) {
  // Both exist only after the build.
  const { measure } = await import('../benches/suite.js');
  const { load } = await import('../dist/core.js');
  const motion = /** @type {import('../www/types.d.ts').Motion} */ (await load());
  return measure(motion, { ...options, progress: (text) => console.log(text) });
}

/**
 * @param {string} executablePath
 * @param {Options} options
 * @returns {Promise<Pick<import('../benches/report.js').Results, 'chromium' | 'start' | 'drags'>>}
 */
async function inChromium(executablePath, options) {
  const { chromium: launcher } = await import('@playwright/test');
  const { timeDrags } = await import('../benches/drag.js');
  const { timeStart } = await import('../benches/start.js');
  const { address, close } = await serve(ROOT.replace(/[\\/]$/, ''), { port: 0, headers: ISOLATED });
  const browser = await launcher.launch({ executablePath, args: CHROME_ARGUMENTS });
  try {
    console.log('first cloud');
    const start = await timeStart(browser, `${address}benches/start.html`, options.quick ? 5 : 11);
    console.log('drags');
    const drags = await timeDrags(browser, `${address}benches/drag.html`, options.quick ? 10 : 40);
    const page = await browser.newPage();
    page.on('console', (message) => console.log(message.text()));
    await page.goto(`${address}benches/page.html`);
    await page.waitForFunction(() => 'measurePage' in globalThis);
    if (!(await page.evaluate('crossOriginIsolated'))) throw new Error('The page is not isolated, and its clock too coarse.');
    const chromium = await page.evaluate((given) => /** @type {any} */ (globalThis).measurePage(given), options);
    return { chromium, start, drags };
  } finally {
    await browser.close();
    close();
  }
}

await runAsScript(import.meta.url, async () => {
  const options = process.argv.slice(2);
  const unknown = options.find((option) => option !== '--quick');
  if (unknown !== undefined) throw new Missing(`"${unknown}" is not an option; \`npm run bench\` takes only --quick.`);
  await bench(options.includes('--quick'));
});
