// What the entries of the package promise to who imports them: Node, TypeScript, and pages that have several.

import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { ROOT } from '../../scripts/process.mjs';
import { serve } from '../../scripts/serve.mjs';
import { installed, launch } from './support.js';

/** @type {ReturnType<typeof installed>} */
let project;
/** @type {import('@playwright/test').Browser} */
let browser;
/** @type {Awaited<ReturnType<typeof serve>>} */
let server;

before(async () => {
  project = installed();
  browser = await launch();
  server = await serve(project.directory, { port: 0 });
});

after(async () => {
  server?.close();
  await browser?.close();
  project?.remove();
});

/**
 * @param {string} source of a module that stands beside the installed package
 * @returns {string} what it prints
 */
function inNode(source) {
  const path = join(project.directory, 'script.mjs');
  writeFileSync(path, source);
  return execFileSync(process.execPath, [path], { encoding: 'utf8' });
}

test('every script of the package can be imported in Node, and leaves no names behind', () => {
  const { exports } = JSON.parse(readFileSync(join(ROOT, 'package.json'), 'utf8'));
  const names = Object.keys(exports).filter((name) => !/\.(json|wasm|css)$/.test(name));
  const addresses = names.map((name) => join('motion-widgets', name));
  assert.ok(addresses.length >= 4, addresses.join(' '));
  const printed = inNode(`
    const before = Object.getOwnPropertyNames(globalThis);
    for (const address of ${JSON.stringify(addresses)}) await import(address);
    console.log(JSON.stringify(Object.getOwnPropertyNames(globalThis).filter((name) => !before.includes(name))));
  `);
  // Lit keeps its notes there, which several copies of it share.
  const ofLit = ['reactiveElementVersions', 'litHtmlVersions', 'litElementVersions', 'litPropertyMetadata'];
  assert.deepEqual(JSON.parse(printed).filter((/** @type {string} */ name) => !ofLit.includes(name)), []);
});

test('the elements with everything inside bring the core along in Node', () => {
  const printed = inNode(`
    import { load } from 'motion-widgets/inlined';
    const { BananaMachine } = await load();
    console.log(new BananaMachine({ samples: 100 }).poses.length);
  `);
  assert.equal(printed, '300\n');
});

test('with the module outside they find it', () => {
  const printed = inNode(`
    import { load } from 'motion-widgets';
    const { BananaMachine } = await load();
    console.log(new BananaMachine({ samples: 100 }).poses.length);
  `);
  assert.equal(printed, '300\n');
});

test('a server component is told that no browser would get the elements', () => {
  const path = join(project.directory, 'server.mjs');
  writeFileSync(path, "import 'motion-widgets';");
  const { stderr } = spawnSync(process.execPath, ['--conditions=react-server', path], { encoding: 'utf8' });
  assert.match(stderr, /Error: motion-widgets is imported by a server component.*'motion-widgets\/react'/);
  // The simulations run anywhere.
  writeFileSync(path, "import { load } from 'motion-widgets/core'; console.log(typeof load);");
  assert.equal(execFileSync(process.execPath, ['--conditions=react-server', path], { encoding: 'utf8' }), 'function\n');
});

test('TypeScript knows the elements and the core, however it resolves', () => {
  writeFileSync(
    join(project.directory, 'typed.ts'),
    `import 'motion-widgets';
     import { load, type Stats } from 'motion-widgets/core';
     import { load as loadExternal } from 'motion-widgets/external';
     const omega: number | undefined = document.querySelector('banana-machine')?.omega;
     document.createElement('map-squeeze').sampler = 'whole-arc';
     const stats: Stats = new (await load()).BananaMachine({ samples: 10 }).stats;
     await loadExternal('/motion.wasm');
     document.createElement('banana-machine').addEventListener('stats', ({ detail }) => detail.crossTrackSkew.toFixed(2));
     document.createElement('map-squeeze').addEventListener('pointermove', ({ clientX }) => clientX);
     // @ts-expect-error
     document.createElement('map-squeeze').addEventListener('stats', ({ detail }) => detail.crossTrackSkew);
     // @ts-expect-error
     document.createElement('banana-machine').omega = 'fast';
     export { omega, stats };`,
  );
  for (const [module, moduleResolution] of [['esnext', 'bundler'], ['nodenext', 'nodenext']]) {
    const options = ['--noEmit', '--strict', '--target', 'es2023', '--lib', 'es2023,esnext.disposable,dom,dom.iterable'];
    const resolution = ['--module', module, '--moduleResolution', moduleResolution, '--types', ''];
    const tsc = join(ROOT, 'node_modules/typescript/bin/tsc');
    // In the directory of a module, or top-level await is refused.
    writeFileSync(join(project.directory, 'package.json'), '{ "private": true, "type": "module" }');
    const run = () =>
      execFileSync(process.execPath, [tsc, ...options, ...resolution, 'typed.ts'], { cwd: project.directory, encoding: 'utf8' });
    assert.doesNotThrow(run, (error) => assert.fail(/** @type {{ stdout: string }} */ (error).stdout));
  }
});

/**
 * A page with three elements and some of the package's scripts.
 *
 * @param {string} scripts
 * @returns {Promise<{ compiled: number, complaints: string[], requests: string[] }>}
 */
async function pageWith(scripts) {
  const elements = '<banana-machine></banana-machine><banana-machine></banana-machine><map-squeeze></map-squeeze>';
  const page = await browser.newPage();
  /** @type {string[]} */
  const complaints = [];
  /** @type {string[]} */
  const requests = [];
  page.on('pageerror', (error) => complaints.push(String(error)));
  page.on('request', (request) => requests.push(request.url()));
  page.on('console', (message) => {
    if (['error', 'warning'].includes(message.type())) complaints.push(message.text());
  });
  await page.addInitScript(countCompilations);
  await page.route('**/page.html', (route) => {
    route.fulfill({ contentType: 'text/html', body: `<!doctype html><link rel="icon" href="data:,">${scripts}${elements}` });
  });
  await page.goto(`${server.address}page.html`);
  for (const element of await page.locator('banana-machine, map-squeeze').all()) {
    await element.scrollIntoViewIfNeeded();
    await element.locator('canvas').first().waitFor({ timeout: 10_000 });
  }
  const compiled = await page.evaluate(() => /** @type {any} */ (globalThis).compiled);
  await page.close();
  return { compiled, complaints, requests };
}

/** Runs in the page. */
function countCompilations() {
  const counter = Object.assign(globalThis, { compiled: 0 });
  for (const name of /** @type {const} */ (['compile', 'compileStreaming', 'instantiateStreaming'])) {
    const original = /** @type {Function} */ (WebAssembly[name]);
    Object.assign(WebAssembly, {
      [name](/** @type {unknown[]} */ ...args) {
        counter.compiled++;
        return original.apply(WebAssembly, args);
      },
    });
  }
  const { instantiate } = WebAssembly;
  Object.assign(WebAssembly, {
    instantiate(/** @type {any} */ source, /** @type {any} */ imports) {
      if (!(source instanceof WebAssembly.Module)) counter.compiled++;
      return instantiate(source, imports);
    },
  });
}

const DIST = '/node_modules/motion-widgets/dist/';
const script = (/** @type {string} */ name) => `<script type="module" src="${DIST}${name}"></script>`;

test('all elements of a page share one compiled module', async () => {
  for (const name of ['motion-widgets.js', 'external.js']) {
    const { compiled, complaints } = await pageWith(script(name));
    assert.deepEqual(complaints, []);
    assert.equal(compiled, 1, name);
  }
});

test('custom-elements.json says what the elements have', async () => {
  const path = join(project.directory, 'node_modules/motion-widgets/dist/custom-elements.json');
  const { modules } = JSON.parse(readFileSync(path, 'utf8'));
  /** @type {any[]} */
  const declared = modules[0].declarations;
  assert.deepEqual(declared.map(({ tagName }) => tagName).sort(), ['alpha-calibrator', 'arc-anatomy', 'banana-machine', 'dead-reckoning', 'map-squeeze', 'odometry-decomposer']);
  const page = await browser.newPage();
  await page.goto(`${server.address}plain/`);
  for (const { tagName, attributes, members, events, cssParts, cssProperties } of declared) {
    const live = await page.evaluate(async (tag) => {
      const Class = /** @type {any} */ (await customElements.whenDefined(tag));
      const element = document.createElement(tag);
      document.body.prepend(element);
      await new Promise((resolve) => element.addEventListener('load', resolve));
      const frames = async () => {
        for (let i = 0; i < 5; i++) await new Promise(requestAnimationFrame);
      };
      await frames();
      for (const fold of /** @type {ShadowRoot} */ (element.shadowRoot).querySelectorAll('details')) fold.open = true;
      await frames();
      const parts = [.../** @type {ShadowRoot} */ (element.shadowRoot).querySelectorAll('[part]')];
      const styles = [...new Set(Class.elementStyles.map(String))].join('');
      const properties = [...new Set(styles.match(/--motion-[a-z-]+/g))];
      return { attributes: [...Class.observedAttributes], parts: parts.flatMap(({ part }) => [...part]), properties };
    }, tagName);
    const names = (/** @type {{ name: string }[]} */ list) => list.map(({ name }) => name).sort();
    // HTML knows no capitals in them.
    assert.deepEqual(names(attributes).map((name) => name.toLowerCase()).sort(), live.attributes.sort(), tagName);
    for (const name of names(members)) {
      const there = await page.evaluate(([tag, key]) => key in /** @type {Element} */ (document.querySelector(tag)), [tagName, name]);
      assert.ok(there, `${tagName} has ${name}`);
    }
    for (const { name, description } of [...attributes, ...members, ...events, ...cssParts, ...cssProperties]) assert.ok(description, `${name} of ${tagName}`);
    assert.deepEqual(names(events), ['change', 'error', 'input', 'load', 'stats']);
    // The progress is there while there is some.
    assert.deepEqual(names(cssParts), [...new Set([...live.parts, 'progress'])].sort(), `parts of ${tagName}`);
    assert.deepEqual(names(cssProperties), live.properties.sort(), `properties of ${tagName}`);
  }
  await page.close();
});

test('the types say of every property, and of every field of a state, what it is', () => {
  const lines = readFileSync(join(project.directory, 'node_modules/motion-widgets/dist/elements.d.ts'), 'utf8').split('\n');
  const unsaid = lines.filter((line, i) => /^ {2}(readonly )?\w+: /.test(line) && !lines[i - 1].endsWith('*/'));
  const tags = ['banana-machine', 'map-squeeze', 'arc-anatomy', 'odometry-decomposer', 'dead-reckoning', 'alpha-calibrator'];
  assert.deepEqual(unsaid, tags.map((tag) => `  widget: '${tag}';`));
});

test('external.js loads a widget when its tag is met, with the words that the page gave it before', async () => {
  const page = await browser.newPage();
  /** @type {string[]} */
  const requests = [];
  page.on('request', (request) => requests.push(new URL(request.url()).pathname));
  const module = `<script type="module">import { setMessages } from '${DIST}external.js';
    setMessages('fr', { step: 'Un pas', squeeze: { title: 'Le plan' } });</script>`;
  const body = `<!doctype html><html lang="fr"><link rel="icon" href="data:,">${module}<banana-machine></banana-machine><x-late></x-late>`;
  await page.route('**/page.html', (route) => route.fulfill({ contentType: 'text/html', body }));
  await page.goto(`${server.address}page.html`);
  await page.locator('banana-machine canvas').first().waitFor();
  const ofSqueeze = () => requests.filter((path) => path.includes('/map-squeeze-'));
  assert.deepEqual(ofSqueeze(), []);
  // An element that is defined later shows one inside of its own.
  await page.evaluate(() => {
    const Late = class extends HTMLElement {
      connectedCallback() {
        this.attachShadow({ mode: 'open' }).innerHTML = '<map-squeeze></map-squeeze>';
      }
    };
    customElements.define('x-late', Late);
  });
  await page.locator('map-squeeze').scrollIntoViewIfNeeded();
  await page.getByRole('region', { name: 'Le plan' }).getByRole('button', { name: 'Un pas' }).waitFor();
  assert.equal(ofSqueeze().length, 1);
  await page.close();
});

test('words that were given before a widget came, and are of another shape, are reported; it speaks English', async () => {
  const page = await browser.newPage();
  /** @type {string[]} */
  const complaints = [];
  page.on('pageerror', (error) => complaints.push(String(error)));
  const module = `<script type="module">import { setMessages } from '${DIST}external.js';
    setMessages('fr', { step: 'Un pas', banana: { alphaIsSilent: 'silence', presets: { straight: 'Tout droit' } } });</script>`;
  const body = `<!doctype html><html lang="fr"><link rel="icon" href="data:,">${module}<banana-machine></banana-machine>`;
  await page.route('**/page.html', (route) => route.fulfill({ contentType: 'text/html', body }));
  await page.goto(`${server.address}page.html`);
  await page.getByRole('button', { name: 'Straight' }).waitFor();
  await page.getByRole('button', { name: 'Un pas' }).waitFor();
  assert.deepEqual(complaints, ['TypeError: messages: fr.banana.alphaIsSilent is a string; allowed is a function of 4 values.']);
  await page.close();
});

test('two copies of the bundle on a page get along', async () => {
  for (const [first, second] of [['motion-widgets.js', 'external.js'], ['external.js', 'motion-widgets.iife.js'], ['motion-widgets.js', 'motion-widgets.js?copy']]) {
    const { complaints } = await pageWith(script(first) + script(second));
    assert.deepEqual(complaints, []);
  }
});

test('the address of the external module can be set by the script that imports it', async () => {
  const address = `${DIST}motion.wasm?mine`;
  const { complaints, requests } = await pageWith(
    `<script type="module">import { load } from '${DIST}external.js'; load('${address}');</script>`,
  );
  assert.deepEqual(complaints, []);
  assert.deepEqual(requests.filter((url) => url.includes('.wasm')), [new URL(address, server.address).href]);
});

/** A page with a figure whose modules are answered by a page, as servers do that send their own for whatever they do not have. @param {string} script */
async function withoutModules(script) {
  const page = await browser.newPage();
  /** @type {string[]} */
  const warnings = [];
  page.on('console', (message) => void (message.type() === 'warning' && warnings.push(message.text())));
  await page.route('**/*.wasm', (route) => route.fulfill({ contentType: 'text/html', body: '<!doctype html>' }));
  const body = `<!doctype html><link rel="icon" href="data:,">${script}<banana-machine></banana-machine>`;
  await page.route('**/page.html', (route) => route.fulfill({ contentType: 'text/html', body }));
  await page.goto(`${server.address}page.html`);
  return { page, warnings };
}

const CURE = "Copy motion.wasm from the package's dist/ into the site and give its address to load(), or import 'motion-widgets/inlined'";

test('where the file of a module cannot be had, the embedded one is used, and a warning names its address and the cure', async () => {
  const { page, warnings } = await withoutModules(script('external.js'));
  await page.locator('banana-machine canvas').first().waitFor();
  assert.equal(warnings.length, 1);
  assert.match(warnings[0], new RegExp(`${server.address}\\S+\\.wasm answers with text/html, which is no WebAssembly module`));
  assert.ok(warnings[0].includes(CURE));
  await page.close();
});

test('an address that has no module is refused with the cure', async () => {
  const { page } = await withoutModules('');
  const refused = page.evaluate(async (address) => (await import(address)).load('/none.wasm'), `${DIST}external.js`);
  await assert.rejects(refused, (/** @type {Error} */ { message }) => message.includes('/none.wasm answers with text/html') && message.includes(CURE));
  await page.close();
});
