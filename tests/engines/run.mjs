// `npm run test:engines`: builds the page, and checks it in Chromium, Firefox and WebKit. `npm run test:engines -- ENGINE…` selects some of
// the engines. Screenshots are written to test-results/engines.

import { mkdtempSync, readFileSync, readdirSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { buildProject } from '../../scripts/build.mjs';
import { REPOSITORY_ROOT, UserError, printStep, runAsScript } from '../../scripts/process.mjs';
import { startServer } from '../../scripts/serve.mjs';
import { browserStarters } from './browsers.mjs';

const PAGE_NAME = 'index.html';
const LISTENER_TAG = '<script src="/tests/engines/listen.js"></script>';

/**
 * Serves a copy of the page of `npm start` with two more scripts. The first script records errors. The second has functions that tests call.
 *
 * @returns {Promise<{ address: string, stopServer: () => void }>}
 */
async function serveSite() {
  const siteDirectory = mkdtempSync(join(tmpdir(), 'motion-engines-'));
  for (const fileName of readdirSync(join(REPOSITORY_ROOT, 'dist'))) if (fileName !== PAGE_NAME) symlinkSync(join(REPOSITORY_ROOT, 'dist', fileName), join(siteDirectory, fileName));
  for (const folderName of ['tests', 'build']) symlinkSync(join(REPOSITORY_ROOT, folderName), join(siteDirectory, folderName));
  writeFileSync(join(siteDirectory, PAGE_NAME), readFileSync(join(REPOSITORY_ROOT, 'dist', PAGE_NAME), 'utf8').replace('<head>', `<head>${LISTENER_TAG}`));
  const { address, close: closeServer } = await startServer(siteDirectory, { port: 0 });
  return {
    address,
    stopServer() {
      closeServer();
      rmSync(siteDirectory, { recursive: true });
    },
  };
}

/** Opens a page in an engine, and returns the failures that the checks found. @param {string} engineName @param {string} address */
async function runChecksInBrowser(engineName, address) {
  printStep(engineName);
  let engineVersion = 'none';
  try {
    const browserSession = await browserStarters[engineName]();
    engineVersion = browserSession.browserVersion;
    try {
      // checks.mjs is imported only here, because it imports dist/, which has to be built first.
      const { runChecks } = await import('./checks.mjs');
      return { engineVersion, ...(await runChecks(engineName, browserSession, address)) };
    } finally {
      await browserSession.endSession();
    }
  } catch (error) {
    const failureMessage = error instanceof UserError ? error.message : String(error instanceof Error ? error.stack : error);
    console.log(`FAILED ${engineName}: ${failureMessage}`);
    return { engineVersion, passedCount: 0, failedChecks: [failureMessage] };
  }
}

/** Tests the named engines, or all engines if none is named. Returns true if all of them pass. @param {string[]} engineNames */
async function testBrowserEngines(engineNames) {
  const allEngineNames = Object.keys(browserStarters);
  const unknownName = engineNames.find((name) => !allEngineNames.includes(name));
  if (unknownName !== undefined) throw new UserError(`"${unknownName}" is no engine that is tried; allowed are ${allEngineNames.join(', ')}.`);
  await buildProject();
  const { address, stopServer } = await serveSite();
  const summaryLines = [];
  let failureCount = 0;
  try {
    for (const name of engineNames.length > 0 ? engineNames : allEngineNames) {
      const { engineVersion, passedCount, failedChecks } = await runChecksInBrowser(name, address);
      failureCount += failedChecks.length;
      summaryLines.push(`${failedChecks.length === 0 ? 'ok    ' : 'FAILED'} ${name.padEnd(10)} ${engineVersion.padEnd(16)} ${passedCount} passed, ${failedChecks.length} failed`);
    }
  } finally {
    stopServer();
  }
  printStep(`Summary, by Node ${process.versions.node}`);
  console.log(summaryLines.join('\n'));
  return failureCount === 0;
}

await runAsScript(import.meta.url, async () => {
  if (!(await testBrowserEngines(process.argv.slice(2)))) process.exitCode = 1;
});
