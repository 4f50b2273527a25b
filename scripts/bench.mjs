// `npm run bench`: the targets of doc/benchmarks.md, measured in Node and in headless Chromium. Prints tables in Markdown,
// and writes what they are made of to build/bench.json. `-- --quick` measures less, in less time.

import { mkdirSync, writeFileSync } from 'node:fs';
import { cpus } from 'node:os';
import { join } from 'node:path';
import { setFlagsFromString } from 'node:v8';
import { runInNewContext } from 'node:vm';
import { CHROME_ARGUMENTS, ensureBrowser } from './browser.mjs';
import { build } from './build.mjs';
import { Missing, ROOT, progress, run, runAsScript } from './process.mjs';
import { serve } from './serve.mjs';
import { nativeRust } from './toolchain.mjs';
import { report } from '../benches/report.js';

/** Without them a page's clock goes in steps of 100 µs, with them of 5. */
const ISOLATED = { 'cross-origin-opener-policy': 'same-origin', 'cross-origin-embedder-policy': 'require-corp' };

/** @param {boolean} quick */
async function bench(quick) {
  await build();
  const began = Date.now();
  const machine = await describe();
  progress('Node');
  const counted = await count();
  const node = await inNode(quick, counted);
  const browser = await ensureBrowser();
  progress('Chromium');
  const { chromium, start, drags } = await inChromium(browser.chrome, quick, counted);
  const seconds = (Date.now() - began) / 1000;
  const results = { ...machine, chromiumVersion: browser.version, quick, seconds, node, chromium, start, drags };
  mkdirSync(join(ROOT, 'build'), { recursive: true });
  writeFileSync(join(ROOT, 'build/bench.json'), `${JSON.stringify(results, null, 2)}\n`);
  console.log(`\n${report(results)}\nIn ${seconds.toFixed(0)} s; all of it is in build/bench.json.`);
}

/** What all of it ran on. */
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

/** @returns {Promise<import('../benches/suite.js').Counted>} */
async function count() {
  const { countingCore, kernels, operationsOf } = await import('../benches/operations.js');
  const { KINDS } = await import('../benches/roofline.js');
  const core = await countingCore();
  return { kernels: [...(await kernels())], operations: KINDS.map((kind) => operationsOf(core, kind, 20_000)) };
}

/**
 * @param {boolean} quick
 * @param {import('../benches/suite.js').Counted} counted
 */
async function inNode(quick, counted) {
  setFlagsFromString('--expose-gc');
  const collect = runInNewContext('gc');
  // Built by now, and not before.
  const { measure } = await import('../benches/suite.js');
  const { load } = await import('../dist/core.js');
  const heap = () => {
    collect();
    return process.memoryUsage().heapUsed;
  };
  const loaded = /** @type {() => Promise<import('../www/types.d.ts').Motion>} */ (load);
  return measure({ load: loaded, heap, counted, quick, progress: (text) => console.log(text) });
}

/**
 * @param {string} executablePath
 * @param {boolean} quick
 * @param {import('../benches/suite.js').Counted} counted
 * @returns {Promise<{ chromium: import('../benches/suite.js').Measured, start: import('../benches/start.js').Start, drags: import('../benches/drag.js').Drag[] }>}
 */
async function inChromium(executablePath, quick, counted) {
  const { chromium: launcher } = await import('@playwright/test');
  const { timeDrags } = await import('../benches/drag.js');
  const { timeStart } = await import('../benches/start.js');
  const { address, close } = await serve(ROOT.replace(/[\\/]$/, ''), { port: 0, headers: ISOLATED });
  const browser = await launcher.launch({ executablePath, args: CHROME_ARGUMENTS });
  try {
    console.log('first cloud');
    const start = await timeStart(browser, `${address}benches/start.html`, quick ? 5 : 11);
    console.log('drags');
    const drags = await timeDrags(browser, `${address}benches/drag.html`, quick ? 10 : 40);
    const page = await browser.newPage();
    page.on('console', (message) => console.log(message.text()));
    const session = await page.context().newCDPSession(page);
    await page.exposeFunction('heapInUse', async () => {
      await session.send('HeapProfiler.collectGarbage');
      return (await session.send('Runtime.getHeapUsage')).usedSize;
    });
    await page.goto(`${address}benches/page.html`);
    await page.waitForFunction(() => 'measurePage' in globalThis);
    if (!(await page.evaluate('crossOriginIsolated'))) throw new Error('The page is not isolated, and its clock too coarse.');
    const chromium = await page.evaluate((options) => /** @type {any} */ (globalThis).measurePage(options), { quick, counted });
    return { chromium, start, drags };
  } finally {
    await browser.close();
    close();
  }
}

await runAsScript(import.meta.url, async () => {
  const options = process.argv.slice(2);
  const unknown = options.find((option) => option !== '--quick');
  if (unknown !== undefined) throw new Missing(`"${unknown}" is not known here: \`npm run bench\` takes --quick alone.`);
  await bench(options.includes('--quick'));
});
