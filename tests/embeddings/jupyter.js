/** Notebook in JupyterLab with the Python package, and the page that nbconvert makes of it. */

import assert from 'node:assert/strict';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { propertiesOf, waitUntilLive, waitForColorScheme } from './checks.mjs';
import { pinnedVersionsOf, pythonDirectoryOf, installPythonPackages, pythonProgramPathOf } from './project.mjs';
import { serveFiles, serveByProgram } from './serving.mjs';

/** @typedef {import('@playwright/test').Page} Page */
/** @typedef {import('./checks.mjs').Site} Site */

/** Files in npm packages, by the address from which the page of nbconvert loads them. */
const PACKAGE_FILES = {
  '**/require.js/*/require.min.js': 'requirejs/require.js',
  '**/@jupyter-widgets/html-manager@*/dist/embed-amd.js': '@jupyter-widgets/html-manager/dist/embed-amd.js',
  '**/anywidget@*/dist/index.js': 'anywidget/dist/index.js',
};
const NPM_PACKAGES = ['requirejs@2.3.8', '@jupyter-widgets/html-manager@1.0.15', 'anywidget@0.11.0'];

let packagesDirectory = '';

const ORIGINAL_SETTINGS = { omega: 0.8, samples: 20000, alphas: [0.1, 0.1, 0.1, 0.1, 0.01, 0.01], overlays: ['command', 'exponential'] };

/** Chooses an item of JupyterLab's menus. @param {Page} page @param {string} menuName @param {string[]} itemNames */
async function chooseMenuItem(page, menuName, ...itemNames) {
  await page.locator('.lm-MenuBar-item', { hasText: menuName }).click();
  for (const [i, itemName] of itemNames.entries()) {
    const menuItem = page.locator('.lm-Menu').nth(i).locator('.lm-Menu-item').filter({ has: page.getByText(itemName, { exact: true }) });
    if (i < itemNames.length - 1) await menuItem.hover();
    else await menuItem.click();
  }
}

/** Opens the notebook as if for the first time, and runs it. @param {Page} page @param {Site} servedSite */
async function runNotebook(page, servedSite) {
  await page.goto(new URL('lab/tree/motion.ipynb?reset', servedSite.url).href);
  await page.locator('.jp-Notebook-ExecutionIndicator[data-status="idle"]').waitFor();
  // Asks the server for a running kernel, because the page says "Idle" even without a kernel.
  await page.waitForFunction(async () => {
    const kernelSessions = await (await fetch('/api/sessions')).json();
    return kernelSessions.some((/** @type {any} */ { kernel }) => kernel.connections > 0 && kernel.execution_state === 'idle');
  });
  // The page of JupyterLab connects to the kernel later than its server reports.
  await page.getByText('Python 3 (ipykernel) | Idle').waitFor();
  await chooseMenuItem(page, 'Kernel', 'Restart Kernel and Run All Cells…');
  await page.locator('.jp-Dialog .jp-mod-accept').click();
  // JupyterLab shows the number of a cell after it has run the cell.
  await page.locator('.jp-CodeCell .jp-InputArea-prompt', { hasText: '[4]:' }).waitFor();
  await waitUntilLive(page, servedSite);
}

/** Returns the Banana Machine of a page. @param {Page} page */
const bananaMachineOf = (page) => page.locator('banana-machine');

/** Evaluates Python code in the last cell of the notebook. @param {Page} page @param {string} pythonCode @returns {Promise<any>} its value */
async function evaluatePython(page, pythonCode) {
  const codeCell = page.locator('.jp-CodeCell').last();
  await codeCell.locator('.cm-content').click();
  await page.keyboard.press('ControlOrMeta+A');
  const cellCount = await page.locator('.jp-CodeCell').count();
  await page.keyboard.insertText(`import json; print('=' + json.dumps(${pythonCode}))`);
  await page.keyboard.press('Shift+Enter');
  const cellOutput = page.locator('.jp-CodeCell').nth(cellCount - 1).locator('.jp-OutputArea-output', { hasText: /^(=|.*Error)/s });
  await cellOutput.waitFor();
  await page.locator('.jp-CodeCell').nth(cellCount).waitFor();
  const outputText = (await cellOutput.textContent()) ?? '';
  assert.ok(outputText.startsWith('='), outputText);
  return JSON.parse(outputText.slice(1));
}

/**
 * Evaluates Python code until its result is the expected value, because the figure's values arrive later.
 *
 * @param {Page} page
 * @param {string} pythonCode
 * @param {unknown} expectedValue
 */
async function waitForPythonValue(page, pythonCode, expectedValue) {
  let actualValue;
  for (let i = 0; i < 10; i++) {
    actualValue = await evaluatePython(page, pythonCode);
    if (JSON.stringify(actualValue) === JSON.stringify(expectedValue)) return;
  }
  assert.deepEqual(actualValue, expectedValue, pythonCode);
}

/** @type {import('./project.mjs').ServerMode['checks']} */
const JUPYTERLAB_CHECKS = {
  async 'what Python sets is shown, and what is shown is known to Python'(page, servedSite) {
    await runNotebook(page, servedSite);
    await waitForPythonValue(page, '[machine.stats["n"], machine.v, machine.preset, machine.error]', [20000, 1, null, '']);
    assert.ok((await evaluatePython(page, 'len(skews)')) > 0);
    // The second assignment does not wait for the result of the first assignment.
    await evaluatePython(page, '[setattr(machine, "preset", "hard"), setattr(machine, "omega", 0.2)]');
    await waitForPythonValue(page, '[machine.preset, machine.omega, machine.dt, machine.command]', [null, 0.2, 1.4, { v: 1, omega: 0.2, dt: 1.4 }]);
    assert.deepEqual(await bananaMachineOf(page).evaluate(propertiesOf, ['preset', 'omega', 'dt']), { preset: null, omega: 0.2, dt: 1.4 });
  },
  async 'changes by the user reach Python, and keys do not reach the notebook'(page, servedSite) {
    await runNotebook(page, servedSite);
    const omegaSlider = bananaMachineOf(page).getByRole('slider', { name: /ω/ }).first();
    await omegaSlider.focus();
    const cellCount = await page.locator('.jp-Cell').count();
    for (const arrowKey of ['ArrowRight', 'ArrowRight', 'ArrowDown', 'ArrowUp']) await page.keyboard.press(arrowKey);
    // The typed letters and digits are shortcuts of JupyterLab for inserting cells and changing their type.
    for (const typedKey of ['b', 'a', 'm', '1', '2', 'Enter']) await page.keyboard.press(typedKey);
    assert.equal(await page.locator('.jp-Cell').count(), cellCount);
    assert.equal(await page.locator('.jp-CodeCell').count(), cellCount - 3);
    const { omega } = /** @type {{ omega: number }} */ (await bananaMachineOf(page).evaluate(propertiesOf, ['omega']));
    assert.notEqual(omega, ORIGINAL_SETTINGS.omega);
    await waitForPythonValue(page, '[machine.omega, machine.command["omega"]]', [omega, omega]);
  },
  async 'light and dark with JupyterLab'(page, servedSite) {
    await runNotebook(page, servedSite);
    for (const [themeName, colorScheme] of /** @type {const} */ ([['JupyterLab Dark', 'dark'], ['JupyterLab Light', 'light']])) {
      await chooseMenuItem(page, 'Settings', 'Theme', themeName);
      await bananaMachineOf(page).evaluate(waitForColorScheme, colorScheme);
    }
  },
};

/** @type {import('./project.mjs').ServerMode['checks']} */
const EXPORT_CHECKS = {
  async 'live without a kernel, as it was when it was run'(page, servedSite) {
    for (const [urlPattern, packagePath] of Object.entries(PACKAGE_FILES)) await page.route(urlPattern, (route) => route.fulfill({ path: join(packagesDirectory, packagePath) }));
    // The page has no formulas, so that an empty MathJax is enough.
    await page.route('**/mathjax/**', (route) => route.fulfill({ contentType: 'text/javascript', body: '' }));
    await page.goto(new URL('motion.html', servedSite.url).href);
    await waitUntilLive(page, servedSite);
    const omegaSlider = bananaMachineOf(page).getByRole('slider', { name: /ω/ }).first();
    await omegaSlider.focus();
    await page.keyboard.press('ArrowRight');
    assert.notDeepEqual(await bananaMachineOf(page).evaluate(propertiesOf, ['omega']), { omega: ORIGINAL_SETTINGS.omega });
  },
};

/** @type {import('./project.mjs').ServerMode['checks']} */
const VOILA_CHECKS = {
  async 'live with a kernel'(page, servedSite) {
    // Voilà loads style sheets of icons from other servers. Empty style sheets replace them.
    await page.route('**/font-awesome*/**', (route) => route.fulfill({ contentType: 'text/css', body: '' }));
    await page.route('**/fontawesome-free*/**', (route) => route.fulfill({ contentType: 'text/css', body: '' }));
    await page.goto(servedSite.url);
    await waitUntilLive(page, servedSite);
  },
};

/** @type {import('./project.mjs').Platform} */
export default {
  heading: 'Jupyter',
  readVersions: () => pinnedVersionsOf('jupyter', 'jupyterlab', 'anywidget', 'nbconvert', 'voila'),
  usesPython: true,
  async installPackages(projectDirectory, { run: runInExample, start, pythonWheel }) {
    const toolsDirectory = pythonDirectoryOf(projectDirectory);
    await installPythonPackages(projectDirectory, { run: runInExample, start }, [pythonWheel]);
    await runInExample('npm', ['install', '--prefix', toolsDirectory, '--ignore-scripts', '--no-audit', '--no-fund', '--loglevel', 'error', ...NPM_PACKAGES]);
    // JupyterLab would otherwise ask for permission to fetch news.
    const settingsDirectory = join(toolsDirectory, 'share/jupyter/lab/settings');
    mkdirSync(settingsDirectory, { recursive: true });
    writeFileSync(join(settingsDirectory, 'overrides.json'), '{ "@jupyterlab/apputils-extension:notification": { "fetchNews": "false" } }');
  },
  async build(projectDirectory, { run: runInExample }) {
    packagesDirectory = join(pythonDirectoryOf(projectDirectory), 'node_modules');
    const nbconvertArguments = ['nbconvert', '--execute', '--to', 'html', '--output-dir', '_build'];
    await runInExample(pythonProgramPathOf(projectDirectory, 'jupyter'), [...nbconvertArguments, 'motion.ipynb']);
    assert.ok(readFileSync(join(projectDirectory, '_build/motion.html'), 'utf8').includes('widget-state+json'));
  },
  serverModes: [
    {
      name: 'JupyterLab',
      serve: serveByProgram((port, projectDirectory) => {
        const jupyterLabArguments = ['--no-browser', '--allow-root', '--IdentityProvider.token=', '--ServerApp.port_retries=0'];
        // JupyterLab has a separate configuration directory, so that this user's settings do not affect the test.
        const ownDirectoryOf = (/** @type {string} */ name) => join(pythonDirectoryOf(projectDirectory), 'own', name);
        const jupyterEnvironment = { JUPYTER_CONFIG_DIR: ownDirectoryOf('config'), JUPYTERLAB_SETTINGS_DIR: ownDirectoryOf('settings'), JUPYTERLAB_WORKSPACES_DIR: ownDirectoryOf('workspaces') };
        return [pythonProgramPathOf(projectDirectory, 'jupyter'), ['lab', ...jupyterLabArguments, '--port', port], jupyterEnvironment];
      }),
      checks: JUPYTERLAB_CHECKS,
    },
    {
      name: 'Voilà',
      serve: serveByProgram((port, projectDirectory) => [pythonProgramPathOf(projectDirectory, 'voila'), ['motion.ipynb', '--no-browser', '--port', port]]),
      checks: VOILA_CHECKS,
    },
    { name: 'exported by nbconvert', serve: serveFiles('_build'), checks: EXPORT_CHECKS },
  ],
  pages: { figuresPath: 'motion.ipynb' },
  expectedFigures: [
    { selector: 'banana-machine', properties: ORIGINAL_SETTINGS },
    { selector: 'map-squeeze', properties: { preset: 'corridor', samples: 1000 } },
  ],
  allowedMessages: [
    { messagePattern: /^(Unsatisfied version|No satisfying version)/, reason: 'Voilà is built with another JupyterLab.' },
    { messagePattern: /^Plugin .* (?:is taking too long to activate|took .* to activate)/, reason: 'JupyterLab on a busy machine.' },
    { messagePattern: /^Connection lost, reconnecting/, reason: 'The kernel is started again.' },
    { messagePattern: /^WebSocket connection to .* closed before the connection is established/, reason: 'The page was left while it was starting.' },
    { messagePattern: /^Could not restore the debugger state/, reason: 'The kernel is started again.' },
    { messagePattern: /^History was unable to be retrieved/, reason: 'The kernel is started again.' },
    { messagePattern: /^strict mode: use allowUnionTypes/, reason: 'The widget manager that nbconvert loads warns of its own schema.' },
    { messagePattern: /\/anywidget\.js 404$/, reason: 'The widget manager looks beside the page before it asks the network.' },
  ],
};
