// `npm run test:embeddings`: builds, packs, and opens each example as its platform serves it. `npm run test:embeddings -- PLATFORM…`
// selects some of the platforms. Pictures of the pages are in test-results/embeddings.

import { mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { chromium } from '@playwright/test';
import { CHROME_ARGUMENTS, ensureBrowser } from '../../scripts/browser.mjs';
import { buildProject } from '../../scripts/build.mjs';
import { REPOSITORY_ROOT, UserError, printStep, runAsScript } from '../../scripts/process.mjs';
import { runChecks } from './checks.mjs';
import { loadPlatform, findPlatformNames, prepareExample } from './project.mjs';

/** @typedef {{ name: string, serverMode: string, passed: number, failures: string[], seconds: number }} Outcome */

/**
 * Returns an outcome for each way of serving a site. If the platform cannot be served, returns a single outcome.
 *
 * @param {import('@playwright/test').Browser} browser
 * @param {string} platformName
 */
async function testPlatform(browser, platformName) {
  const platformDefinition = await loadPlatform(platformName);
  /** @type {Outcome[]} */
  const platformOutcomes = [];
  let startTime = Date.now();
  const addOutcome = (/** @type {string} */ serverModeName, /** @type {number} */ passedCount, /** @type {string[]} */ failures) => {
    platformOutcomes.push({ name: platformName, serverMode: serverModeName, passed: passedCount, failures, seconds: (Date.now() - startTime) / 1000 });
    for (const failureText of failures) console.log(`FAILED ${failureText}`);
    startTime = Date.now();
  };
  let serverModeName = 'build';
  try {
    const { directory: projectDirectory, tools: exampleTools } = await prepareExample(platformName, platformDefinition);
    printStep(`${platformName}: building`);
    await platformDefinition.build?.(projectDirectory, exampleTools);
    for (const serverMode of platformDefinition.serverModes) {
      serverModeName = serverMode.name;
      printStep(`${platformName}: ${serverModeName}`);
      const { url, stop } = await serverMode.serve(projectDirectory, exampleTools);
      try {
        const { passed, failures } = await runChecks(browser, { name: platformName, definition: platformDefinition, serverMode, url });
        addOutcome(serverModeName, passed, failures);
      } finally {
        await stop();
      }
    }
  } catch (error) {
    addOutcome(serverModeName, 0, [error instanceof UserError ? error.message : String(error instanceof Error ? error.stack : error)]);
  }
  return platformOutcomes;
}

/** Tests the named platforms, or all platforms if none is named. Returns true if all of them pass. @param {string[]} platformNames */
async function testPlatforms(platformNames) {
  const allPlatformNames = await findPlatformNames();
  const unknownName = platformNames.find((name) => !allPlatformNames.includes(name));
  if (unknownName !== undefined) throw new UserError(`"${unknownName}" is no platform that is tried; allowed are ${allPlatformNames.join(', ')}.`);
  await buildProject();
  const { chromePath, version: browserVersion } = await ensureBrowser();
  mkdirSync(join(REPOSITORY_ROOT, 'test-results/embeddings'), { recursive: true });
  // With the back/forward cache, going back restores a page in the state in which the user left it.
  const browser = await chromium.launch({ executablePath: chromePath, args: CHROME_ARGUMENTS, ignoreDefaultArgs: ['--disable-back-forward-cache'] });
  /** @type {Outcome[]} */
  const allOutcomes = [];
  try {
    for (const name of platformNames.length > 0 ? platformNames : allPlatformNames) allOutcomes.push(...(await testPlatform(browser, name)));
  } finally {
    await browser.close();
  }
  await printSummary(allOutcomes, browserVersion);
  return allOutcomes.every(({ failures }) => failures.length === 0);
}

/** Prints the versions of the packages and the outcomes. @param {Outcome[]} outcomes @param {string} browserVersion */
async function printSummary(outcomes, browserVersion) {
  printStep(`Versions: Node ${process.versions.node}, Chromium ${browserVersion}`);
  for (const name of new Set(outcomes.map(({ name }) => name))) console.log(`${name.padEnd(16)} ${(await loadPlatform(name)).readVersions()}`);
  printStep('Summary');
  for (const { name, serverMode, passed, failures, seconds } of outcomes) {
    const countText = `${passed} passed, ${failures.length} failed`;
    console.log(`${failures.length === 0 ? 'ok    ' : 'FAILED'} ${name.padEnd(16)} ${serverMode.padEnd(20)} ${seconds.toFixed(0).padStart(4)} s  ${countText}`);
  }
}

await runAsScript(import.meta.url, async () => {
  if (!(await testPlatforms(process.argv.slice(2)))) process.exitCode = 1;
});
