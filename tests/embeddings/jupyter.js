/** A notebook in JupyterLab, with the Python package, and the page that nbconvert makes of it. */

import assert from 'node:assert/strict';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { hasScheme, live } from './checks.mjs';
import { besidePython, pinned, pythonInstall, pythonProgram } from './project.mjs';
import { files, program } from './serving.mjs';

/** @typedef {import('@playwright/test').Page} Page */
/** @typedef {import('./checks.mjs').Site} Site */

/** Addresses that nbconvert's page loads, each with its file in packages of npm. */
const LOADED = {
  '**/require.js/*/require.min.js': 'requirejs/require.js',
  '**/@jupyter-widgets/html-manager@*/dist/embed-amd.js': '@jupyter-widgets/html-manager/dist/embed-amd.js',
  '**/anywidget@*/dist/index.js': 'anywidget/dist/index.js',
};
const PACKAGES = ['requirejs@2.3.8', '@jupyter-widgets/html-manager@1.0.15', 'anywidget@0.11.0'];

/** Directory of these packages. */
let packages = '';

const ORIGINAL = { omega: 0.8, samples: 20000, alphas: [0.1, 0.1, 0.1, 0.1, 0.01, 0.01], overlays: ['command', 'exponential'] };

/** @param {Page} page @param {string} menu @param {string[]} path of names in it */
async function choose(page, menu, ...path) {
  await page.locator('.lm-MenuBar-item', { hasText: menu }).click();
  for (const [i, name] of path.entries()) {
    const item = page.locator('.lm-Menu').nth(i).locator('.lm-Menu-item').filter({ has: page.getByText(name, { exact: true }) });
    if (i < path.length - 1) await item.hover();
    else await item.click();
  }
}

/** Opens the notebook as if for the first time, and runs it. @param {Page} page @param {Site} site */
async function run(page, site) {
  await page.goto(new URL('lab/tree/motion.ipynb?reset', site.url).href);
  await page.locator('.jp-Notebook-ExecutionIndicator[data-status="idle"]').waitFor();
  // The page says "Idle" even before there is a kernel.
  await page.waitForFunction(async () => {
    const sessions = await (await fetch('/api/sessions')).json();
    return sessions.some((/** @type {any} */ { kernel }) => kernel.connections > 0 && kernel.execution_state === 'idle');
  });
  // JupyterLab itself connects later than its server says.
  await page.getByText('Python 3 (ipykernel) | Idle').waitFor();
  await choose(page, 'Kernel', 'Restart Kernel and Run All Cells…');
  await page.locator('.jp-Dialog .jp-mod-accept').click();
  // The cell gets its number when it has run.
  await page.locator('.jp-CodeCell .jp-InputArea-prompt', { hasText: '[4]:' }).waitFor();
  await live(page, site);
}

/** @param {Page} page */
const machine = (page) => page.locator('banana-machine');

/** Runs a line in a cell below all others. @param {Page} page @param {string} code @returns {Promise<any>} its value, by JSON */
async function python(page, code) {
  const cell = page.locator('.jp-CodeCell').last();
  await cell.locator('.cm-content').click();
  await page.keyboard.press('ControlOrMeta+A');
  const count = await page.locator('.jp-CodeCell').count();
  await page.keyboard.insertText(`import json; print('=' + json.dumps(${code}))`);
  await page.keyboard.press('Shift+Enter');
  const output = page.locator('.jp-CodeCell').nth(count - 1).locator('.jp-OutputArea-output', { hasText: /^(=|.*Error)/s });
  await output.waitFor();
  await page.locator('.jp-CodeCell').nth(count).waitFor();
  const text = (await output.textContent()) ?? '';
  assert.ok(text.startsWith('='), text);
  return JSON.parse(text.slice(1));
}

/**
 * Evaluates Python code until it has the expected value, because the figure's values arrive later.
 *
 * @param {Page} page
 * @param {string} code
 * @param {unknown} expected
 */
async function comesTo(page, code, expected) {
  let said;
  for (let i = 0; i < 10; i++) {
    said = await python(page, code);
    if (JSON.stringify(said) === JSON.stringify(expected)) return;
  }
  assert.deepEqual(said, expected, code);
}

/** @param {Page} page @param {string[]} names */
const shows = (page, names) =>
  machine(page).evaluate((element, wanted) => Object.fromEntries(wanted.map((name) => [name, /** @type {any} */ (element)[name]])), names);

/** @type {import('./project.mjs').Serving['checks']} */
const CHECKS = {
  async 'what Python sets is shown, and what is shown is known to Python'(page, site) {
    await run(page, site);
    await comesTo(page, '[machine.stats["n"], machine.v, machine.preset, machine.error]', [20000, 1, null, '']);
    assert.ok((await python(page, 'len(skews)')) > 0);
    // Two assignments without waiting for the result of the first.
    await python(page, '[setattr(machine, "preset", "hard"), setattr(machine, "omega", 0.2)]');
    await comesTo(page, '[machine.preset, machine.omega, machine.dt, machine.command]', [null, 0.2, 1.4, { v: 1, omega: 0.2, dt: 1.4 }]);
    assert.deepEqual(await shows(page, ['preset', 'omega', 'dt']), { preset: null, omega: 0.2, dt: 1.4 });
    await python(page, 'setattr(machine, "omega", None)');
    await comesTo(page, 'machine.omega', 0);
    // Only the figure knows the number of α's of a model, so it refuses a wrong length.
    const alphas = await python(page, 'machine.alphas');
    await python(page, 'setattr(machine, "alphas", [1, 2, 3])');
    await comesTo(page, '[machine.alphas, "alphas" in machine.error]', [alphas, true]);
    // Ranges are in the declaration, so Python refuses the value without asking the figure.
    const refused = await python(page, `[exec("try: machine.omega = 2e6\\nexcept Exception as error: said = str(error)"), said][1]`);
    assert.equal(refused, 'omega is 2000000.0; allowed is a number from -1000000 to 1000000');
  },
  async 'what the reader changes comes to Python, and no key to the notebook'(page, site) {
    await run(page, site);
    const slider = machine(page).getByRole('slider', { name: /ω/ }).first();
    await slider.focus();
    const cells = await page.locator('.jp-Cell').count();
    for (const key of ['ArrowRight', 'ArrowRight', 'ArrowDown', 'ArrowUp']) await page.keyboard.press(key);
    // Letters and digits that are shortcuts of JupyterLab, for inserting cells and changing their type.
    for (const key of ['b', 'a', 'm', '1', '2', 'Enter']) await page.keyboard.press(key);
    assert.equal(await page.locator('.jp-Cell').count(), cells);
    assert.equal(await page.locator('.jp-CodeCell').count(), cells - 3);
    const { omega } = /** @type {{ omega: number }} */ (await shows(page, ['omega']));
    assert.notEqual(omega, ORIGINAL.omega);
    await comesTo(page, '[machine.omega, machine.command["omega"]]', [omega, omega]);
  },
  async 'light and dark with JupyterLab'(page, site) {
    await run(page, site);
    for (const [theme, scheme] of /** @type {const} */ ([['JupyterLab Dark', 'dark'], ['JupyterLab Light', 'light']])) {
      await choose(page, 'Settings', 'Theme', theme);
      await machine(page).evaluate(hasScheme, scheme);
    }
  },
};

/** @type {import('./project.mjs').Serving['checks']} */
const EXPORTED = {
  async 'live without a kernel, as it was when it was run'(page, site) {
    for (const [address, path] of Object.entries(LOADED)) await page.route(address, (route) => route.fulfill({ path: join(packages, path) }));
    // The page has no formulas.
    await page.route('**/mathjax/**', (route) => route.fulfill({ contentType: 'text/javascript', body: '' }));
    await page.goto(new URL('motion.html', site.url).href);
    await live(page, site);
    const slider = machine(page).getByRole('slider', { name: /ω/ }).first();
    await slider.focus();
    await page.keyboard.press('ArrowRight');
    assert.notDeepEqual(await shows(page, ['omega']), { omega: ORIGINAL.omega });
  },
};

/** @type {import('./project.mjs').Serving['checks']} */
const SERVED = {
  async 'live with a kernel'(page, site) {
    // Voilà loads its icons from the network.
    await page.route('**/font-awesome*/**', (route) => route.fulfill({ contentType: 'text/css', body: '' }));
    await page.route('**/fontawesome-free*/**', (route) => route.fulfill({ contentType: 'text/css', body: '' }));
    await page.goto(site.url);
    await live(page, site);
  },
};

/** @type {import('./project.mjs').Engine} */
export default {
  heading: 'Jupyter',
  versions: () => pinned('jupyter', 'jupyterlab', 'anywidget', 'nbconvert', 'voila'),
  python: true,
  async install(directory, { run: execute, start, wheel }) {
    const tools = besidePython(directory);
    await pythonInstall(directory, { run: execute, start }, [wheel]);
    await execute('npm', ['install', '--prefix', tools, '--ignore-scripts', '--no-audit', '--no-fund', '--loglevel', 'error', ...PACKAGES]);
    // JupyterLab would ask for permission to fetch news.
    const settings = join(tools, 'share/jupyter/lab/settings');
    mkdirSync(settings, { recursive: true });
    writeFileSync(join(settings, 'overrides.json'), '{ "@jupyterlab/apputils-extension:notification": { "fetchNews": "false" } }');
  },
  async build(directory, { run: execute }) {
    packages = join(besidePython(directory), 'node_modules');
    const command = ['nbconvert', '--execute', '--to', 'html', '--output-dir', '_build'];
    await execute(pythonProgram(directory, 'jupyter'), [...command, 'motion.ipynb']);
    assert.ok(readFileSync(join(directory, '_build/motion.html'), 'utf8').includes('widget-state+json'));
  },
  servings: [
    {
      name: 'JupyterLab',
      serve(directory, tools) {
        const options = ['--no-browser', '--allow-root', '--IdentityProvider.token=', '--ServerApp.port_retries=0'];
        // A separate configuration directory, so that this user's settings do not affect the test.
        const own = (/** @type {string} */ name) => join(besidePython(directory), 'own', name);
        const env = { JUPYTER_CONFIG_DIR: own('config'), JUPYTERLAB_SETTINGS_DIR: own('settings'), JUPYTERLAB_WORKSPACES_DIR: own('workspaces') };
        return program((port) => [pythonProgram(directory, 'jupyter'), ['lab', ...options, '--port', port], env])(directory, tools);
      },
      checks: CHECKS,
    },
    {
      name: 'Voilà',
      serve: (directory, tools) => program((port) => [pythonProgram(directory, 'voila'), ['motion.ipynb', '--no-browser', '--port', port]])(directory, tools),
      checks: SERVED,
    },
    { name: 'exported by nbconvert', serve: files('_build'), checks: EXPORTED },
  ],
  pages: { first: 'motion.ipynb' },
  expected: [
    { selector: 'banana-machine', properties: ORIGINAL },
    { selector: 'map-squeeze', properties: { preset: 'corridor', samples: 1000 } },
  ],
  allowed: [
    { message: /^(Unsatisfied version|No satisfying version)/, reason: 'Voilà is built with another JupyterLab.' },
    { message: /^Plugin .* (?:is taking too long to activate|took .* to activate)/, reason: 'JupyterLab on a busy machine.' },
    { message: /^Connection lost, reconnecting/, reason: 'The kernel is started again.' },
    { message: /^WebSocket connection to .* closed before the connection is established/, reason: 'The page was left while it was starting.' },
    { message: /^Could not restore the debugger state/, reason: 'The kernel is started again.' },
    { message: /^History was unable to be retrieved/, reason: 'The kernel is started again.' },
    { message: /^strict mode: use allowUnionTypes/, reason: 'Of the widget manager that nbconvert loads: of its own schema.' },
    { message: /\/anywidget\.js 404$/, reason: 'The widget manager looks beside the page before it asks the network.' },
  ],
};
