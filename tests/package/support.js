/**
 * Installs the package as npm would publish it in a separate directory, with the examples.
 *
 * @module
 */

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { cpSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, renameSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before } from 'node:test';
import { chromium } from '@playwright/test';
import { CHROME_ARGUMENTS, findChrome } from '../../scripts/browser.mjs';
import { ROOT } from '../../scripts/process.mjs';
import { serve } from '../../scripts/serve.mjs';
import { untilComplete } from '../embeddings/checks.mjs';

/** Files of dist/ that an author copies next to a page. */
const COPIED_FILES = ['motion-widgets.iife.js', 'motion-widgets.css', 'embed.html', 'embed.css', 'embed.js'];

/** Returns a directory with the examples, in which only the packed package is installed. @returns {{ directory: string, remove: () => void }} */
export function installPackage() {
  const directory = mkdtempSync(join(tmpdir(), 'motion-widgets-'));
  // The package has been built already.
  execFileSync('npm', ['pack', ROOT, '--ignore-scripts', '--silent', '--pack-destination', directory]);
  const tarball = readdirSync(directory).find((name) => name.endsWith('.tgz'));
  assert.ok(tarball, 'npm pack makes a tarball');
  const modulesDirectory = join(directory, 'node_modules');
  mkdirSync(modulesDirectory);
  execFileSync('tar', ['-xzf', tarball, '-C', modulesDirectory], { cwd: directory });
  renameSync(join(modulesDirectory, 'package'), join(modulesDirectory, 'motion-widgets'));
  writeFileSync(join(directory, 'package.json'), '{ "private": true }');
  // npm leaves the installation of peer dependencies to the application.
  const { peerDependencies } = JSON.parse(readFileSync(join(ROOT, 'package.json'), 'utf8'));
  for (const name of Object.keys(peerDependencies)) cpSync(join(ROOT, 'node_modules', name), join(modulesDirectory, name), { recursive: true });
  cpSync(join(ROOT, 'examples'), directory, { recursive: true });
  for (const name of COPIED_FILES) {
    for (const example of ['classic-script', 'iframe']) cpSync(join(ROOT, 'dist', name), join(directory, example, name));
  }
  for (const exampleEntry of readdirSync(join(ROOT, 'examples'), { withFileTypes: true })) {
    if (exampleEntry.isDirectory()) symlinkSync(modulesDirectory, join(directory, exampleEntry.name, 'node_modules'));
  }
  return { directory, remove: () => rmSync(directory, { recursive: true, force: true }) };
}

/** Installs and serves the package for all tests of a file. @param {() => unknown} [prepare] is called after the installation */
export function serveProject(prepare) {
  const projectContext = /** @type {{ directory: string, address: string, browser: import('@playwright/test').Browser }} */ ({});
  /** @type {(() => void)[]} */
  const cleanups = [];
  before(async () => {
    // The test file must be evaluated before `prepare` is called.
    await null;
    const { directory, remove } = installPackage();
    cleanups.push(remove);
    projectContext.directory = directory;
    prepare?.();
    const { address, close } = await serve(directory, { port: 0 });
    cleanups.push(close);
    Object.assign(projectContext, { address, browser: await launchBrowser() });
  });
  after(async () => {
    await projectContext.browser?.close();
    for (const end of cleanups.reverse()) end();
  });
  return projectContext;
}

/** Launches the browser of the tests. */
export function launchBrowser() {
  return chromium.launch({ executablePath: process.env.CHROME ?? findChrome(), args: CHROME_ARGUMENTS });
}

/** Collects the errors and warnings of a page. @param {import('@playwright/test').Page} page @returns {string[]} */
export function recordConsoleMessages(page) {
  /** @type {string[]} */
  const consoleMessages = [];
  page.on('console', (message) => void (['error', 'warning'].includes(message.type()) && consoleMessages.push(message.text())));
  page.on('pageerror', (error) => consoleMessages.push(String(error)));
  page.on('requestfailed', (request) => consoleMessages.push(`${request.url()} ${request.failure()?.errorText}`));
  return consoleMessages;
}

/**
 * Opens a page and waits until its figure has all of its samples.
 *
 * @param {import('@playwright/test').Browser} browser
 * @param {string} address
 * @param {(page: import('@playwright/test').Page) => Promise<unknown>} [prepare] before the page is opened
 * @returns {Promise<{ page: import('@playwright/test').Page, requests: string[] }>}
 */
export async function openWithCloud(browser, address, prepare) {
  const page = await browser.newPage();
  await prepare?.(page);
  const consoleMessages = recordConsoleMessages(page);
  /** @type {string[]} */
  const requestedUrls = [];
  page.on('request', (request) => requestedUrls.push(request.url()));
  await page.goto(address);
  const figureFrame = (await page.locator('iframe').count()) > 0 ? page.frameLocator('iframe') : page;
  const canvas = figureFrame.locator('banana-machine canvas').first();
  await canvas.waitFor({ timeout: 10_000 }).catch((error) => {
    throw new Error([...consoleMessages, error.message].join('\n'));
  });
  await figureFrame.locator('banana-machine').first().evaluate(untilComplete);
  assert.deepEqual(consoleMessages, []);
  return { page, requests: requestedUrls };
}
