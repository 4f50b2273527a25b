// Installs the package as npm would publish it in a separate directory, with the examples.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { cpSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, renameSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, afterEach, before } from 'node:test';
import { chromium } from '@playwright/test';
import { CHROME_ARGUMENTS, findChrome } from '../../scripts/browser.mjs';
import { REPOSITORY_ROOT } from '../../scripts/process.mjs';
import { startServer } from '../../scripts/serve.mjs';
import { recordMessages, waitUntilComplete } from '../embeddings/checks.mjs';
import { packNpmPackageInto } from '../embeddings/project.mjs';

/** Files of dist/ that an author copies next to a page. */
const COPIED_FILES = ['motion-widgets.iife.js', 'motion-widgets.css', 'embed.html', 'embed.css', 'embed.js'];

/** Copies the examples to a directory, and installs only the packed package there. @param {string} installDirectory */
function installPackage(installDirectory) {
  const tarballPath = packNpmPackageInto(installDirectory);
  const modulesDirectory = join(installDirectory, 'node_modules');
  mkdirSync(modulesDirectory);
  execFileSync('tar', ['-xzf', tarballPath, '-C', modulesDirectory]);
  renameSync(join(modulesDirectory, 'package'), join(modulesDirectory, 'motion-widgets'));
  writeFileSync(join(installDirectory, 'package.json'), '{ "private": true }');
  // Peer dependencies are copied too, because npm leaves them to the application.
  const { peerDependencies } = JSON.parse(readFileSync(join(REPOSITORY_ROOT, 'package.json'), 'utf8'));
  for (const packageName of Object.keys(peerDependencies)) cpSync(join(REPOSITORY_ROOT, 'node_modules', packageName), join(modulesDirectory, packageName), { recursive: true });
  cpSync(join(REPOSITORY_ROOT, 'examples'), installDirectory, { recursive: true });
  for (const name of COPIED_FILES) {
    for (const exampleName of ['classic-script', 'iframe']) cpSync(join(REPOSITORY_ROOT, 'dist', name), join(installDirectory, exampleName, name));
  }
  for (const exampleEntry of readdirSync(join(REPOSITORY_ROOT, 'examples'), { withFileTypes: true })) {
    if (exampleEntry.isDirectory()) symlinkSync(modulesDirectory, join(installDirectory, exampleEntry.name, 'node_modules'));
  }
}

/**
 * Serves a directory for all tests of a file, and launches a browser. After a test its pages are closed. Pages that `openPage` has opened
 * must have printed no errors or warnings.
 *
 * @param {() => string} prepareDirectory returns the directory
 * @param {string} [basePath] path of the site
 */
export function serveDirectory(prepareDirectory, basePath) {
  const siteServer = {
    address: '',
    browser: /** @type {import('@playwright/test').Browser} */ ({}),
    consoleMessages: /** @type {string[]} */ ([]),
    /** Opens a page. @param {import('@playwright/test').BrowserContextOptions} [pageOptions] */
    async openPage(pageOptions) {
      const page = await siteServer.browser.newPage(pageOptions);
      recordMessages(page, siteServer.consoleMessages);
      return page;
    },
  };
  let closeServer = () => {};
  before(async () => {
    // Waits until the test file is evaluated, because `prepareDirectory` may use its variables.
    await null;
    const { address: pageAddress, close: stopServer } = await startServer(prepareDirectory(), { port: 0, base: basePath });
    closeServer = stopServer;
    const browser = await chromium.launch({ executablePath: process.env.CHROME ?? findChrome(), args: CHROME_ARGUMENTS });
    Object.assign(siteServer, { address: pageAddress, browser });
  });
  afterEach(async () => {
    // A closed page aborts its requests, which is no error.
    const testMessages = [...siteServer.consoleMessages];
    for (const browserContext of siteServer.browser.contexts()) await browserContext.close();
    siteServer.consoleMessages = [];
    assert.deepEqual(testMessages, []);
  });
  after(async () => {
    closeServer();
    await siteServer.browser.close();
  });
  return siteServer;
}

/** Installs and serves the package for all tests of a file. @param {() => unknown} [prepareProject] is called after the installation */
export function serveProject(prepareProject) {
  const projectDirectory = mkdtempSync(join(tmpdir(), 'motion-widgets-'));
  after(() => rmSync(projectDirectory, { recursive: true, force: true }));
  const siteServer = serveDirectory(() => {
    installPackage(projectDirectory);
    prepareProject?.();
    return projectDirectory;
  });
  return Object.assign(siteServer, { directory: projectDirectory });
}

/** Opens a page and waits until its figure has all its samples. @param {ReturnType<typeof serveDirectory>} siteServer @param {string} pageAddress */
export async function openWithCloud(siteServer, pageAddress) {
  const page = await siteServer.openPage();
  /** @type {string[]} */
  const requestedUrls = [];
  page.on('request', (request) => requestedUrls.push(request.url()));
  await page.goto(pageAddress);
  const figureFrame = (await page.locator('iframe').count()) > 0 ? page.frameLocator('iframe') : page;
  const cloudCanvas = figureFrame.locator('banana-machine canvas').first();
  await cloudCanvas.waitFor({ timeout: 10_000 }).catch((error) => {
    throw new Error([...siteServer.consoleMessages, error.message].join('\n'));
  });
  await figureFrame.locator('banana-machine').first().evaluate(waitUntilComplete);
  return { page, requests: requestedUrls };
}
