// `npm run bench`: measures the targets of doc/benchmarks.md in Node and in headless Chromium. It prints tables in Markdown, and writes the
// measurements to build/bench.json. `-- --quick` repeats each measurement less often.

import { readFileSync, writeFileSync } from 'node:fs';
import { cpus } from 'node:os';
import { join } from 'node:path';
import { CHROME_ARGUMENTS, ensureBrowser } from './browser.mjs';
import { buildProject } from './build.mjs';
import { EXAMPLE_LOG_PATHS } from './example-log.mjs';
import { REPOSITORY_ROOT, UserError, printStep, runProgram, runAsScript } from './process.mjs';
import { startServer } from './serve.mjs';
import { ensureNativeRust } from './toolchain.mjs';
import { formatReport } from '../benches/report.js';

/** Headers that make the page cross-origin isolated. Its clock then has steps of 5 µs instead of 100 µs. */
const ISOLATION_HEADERS = { 'cross-origin-opener-policy': 'same-origin', 'cross-origin-embedder-policy': 'require-corp' };

/** Describes the machine and the versions of the programs. @param {string} chromiumVersion */
async function describeMachine(chromiumVersion) {
  const commitResult = await runProgram('git', ['describe', '--always', '--dirty'], { isQuiet: true });
  const { description } = await ensureNativeRust();
  return {
    'Measured on': new Date().toISOString().slice(0, 10),
    commit: commitResult.hasSucceeded ? commitResult.stdout.trim() : 'unknown',
    processor: `${cpus()[0].model}, ${cpus().length} cores`,
    Node: process.versions.node,
    Chromium: chromiumVersion,
    Rust: description,
  };
}

/**
 * Measures the core and the page in Chromium.
 *
 * @param {string} executablePath
 * @param {{ isQuickRun: boolean, log: { odometry: string, reference: string } }} benchOptions
 * @returns {Promise<Pick<import('../benches/report.js').Results, 'chromiumTimings' | 'pageStartTimes' | 'dragTimings'>>}
 */
async function measureInChromium(executablePath, benchOptions) {
  const { chromium: chromiumLauncher } = await import('@playwright/test');
  const { measureDrags } = await import('../benches/drag.js');
  const { measureStarts } = await import('../benches/start.js');
  const { address: serverAddress, close: closeServer } = await startServer(REPOSITORY_ROOT.replace(/[\\/]$/, ''), { port: 0, headers: ISOLATION_HEADERS });
  const browser = await chromiumLauncher.launch({ executablePath, args: CHROME_ARGUMENTS });
  const figuresAddress = `${serverAddress}benches/page.html`;
  try {
    printStep('First cloud');
    const pageStartTimes = await measureStarts(browser, figuresAddress, benchOptions.isQuickRun ? 5 : 11);
    printStep('Drags');
    const dragTimings = await measureDrags(browser, figuresAddress, benchOptions.isQuickRun ? 10 : 40);
    printStep('Refresh and calibration');
    // The page "empty" has no figures, so that its times are those of the page alone.
    const page = await browser.newPage();
    await page.route(`${serverAddress}empty`, (route) => route.fulfill({ headers: ISOLATION_HEADERS, contentType: 'text/html', body: '' }));
    await page.goto(`${serverAddress}empty`);
    if (!(await page.evaluate('crossOriginIsolated'))) throw new Error('The page is not isolated, and its clock too coarse.');
    const chromiumTimings = await page.evaluate(async ({ moduleAddresses: [coreModule, suiteModule], suiteOptions }) => {
      const [{ load: loadCore }, { measureCore }] = await Promise.all([import(coreModule), import(suiteModule)]);
      return measureCore(await loadCore(), suiteOptions);
    }, { moduleAddresses: [`${serverAddress}dist/core.js`, `${serverAddress}benches/suite.js`], suiteOptions: benchOptions });
    return { chromiumTimings, pageStartTimes, dragTimings };
  } finally {
    await browser.close();
    closeServer();
  }
}

await runAsScript(import.meta.url, async () => {
  const commandOptions = process.argv.slice(2);
  const unknownOption = commandOptions.find((commandOption) => commandOption !== '--quick');
  if (unknownOption !== undefined) throw new UserError(`"${unknownOption}" is not an option; \`npm run bench\` takes only --quick.`);
  const isQuickRun = commandOptions.length > 0;
  // The full build is measured, because it is published. The local build is not optimized.
  await buildProject();
  const [odometry, reference] = [EXAMPLE_LOG_PATHS.odometry, EXAMPLE_LOG_PATHS.reference].map((logPath) => readFileSync(join(REPOSITORY_ROOT, logPath), 'utf8'));
  const benchOptions = { isQuickRun, log: { odometry, reference } };
  printStep('Node');
  // The modules of benches/ import dist/, which exists only after the build.
  const { measureCore } = await import('../benches/suite.js');
  const { load: loadCore } = await import('../dist/core.js');
  const nodeTimings = await measureCore(/** @type {import('../www/types.d.ts').Motion} */ (await loadCore()), benchOptions);
  const browser = await ensureBrowser();
  printStep('Chromium');
  const benchResults = { machineDescription: await describeMachine(browser.version), isQuickRun, nodeTimings, ...(await measureInChromium(browser.chromePath, benchOptions)) };
  writeFileSync(join(REPOSITORY_ROOT, 'build/bench.json'), `${JSON.stringify(benchResults, null, 2)}\n`);
  console.log(`\n${formatReport(benchResults)}\n\nbuild/bench.json has all measurements.`);
});
