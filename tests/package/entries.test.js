// Entry points of the package, imported by Node, by TypeScript, and by pages that import several of them. The version and the options are
// checked too.

import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { cpSync, existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { toPascalCase } from '../../scripts/declarations.mjs';
import { REPOSITORY_ROOT } from '../../scripts/process.mjs';
import { settings } from '../../build/settings.js';
import { serveProject } from './support.js';

const installedProject = serveProject();
const packagedPathOf = (/** @type {string} */ packagePath) => join(installedProject.directory, 'node_modules/motion-widgets', packagePath);

/** Runs a module next to the installed package, and returns what it prints. @param {string} moduleSource */
function runNode(moduleSource) {
  const scriptPath = join(installedProject.directory, 'script.mjs');
  writeFileSync(scriptPath, moduleSource);
  return execFileSync(process.execPath, [scriptPath], { encoding: 'utf8' });
}

test('every script of the package can be imported in Node, and defines no global variables', () => {
  const { exports: packageExports } = JSON.parse(readFileSync(join(REPOSITORY_ROOT, 'package.json'), 'utf8'));
  const scriptNames = Object.keys(packageExports).filter((entryName) => /\.js$/.test(packageExports[entryName].default));
  const importNames = scriptNames.map((scriptName) => join('motion-widgets', scriptName));
  assert.ok(importNames.length >= 4, importNames.join(' '));
  const scriptOutput = runNode(`
    const before = Object.getOwnPropertyNames(globalThis);
    for (const address of ${JSON.stringify(importNames)}) await import(address);
    console.log(JSON.stringify(Object.getOwnPropertyNames(globalThis).filter((name) => !before.includes(name))));
  `);
  // The global variables of Lit are allowed, in which it keeps the versions of its loaded copies.
  const litNames = ['reactiveElementVersions', 'litHtmlVersions', 'litElementVersions', 'litPropertyMetadata'];
  assert.deepEqual(JSON.parse(scriptOutput).filter((/** @type {string} */ name) => !litNames.includes(name)), []);
});

test('the entry point with the elements loads the core in Node', () => {
  const scriptOutput = runNode(`
    import { isFigureTag, load } from 'motion-widgets';
    const { BananaMachine } = await load();
    console.log(new BananaMachine({ samples: 100 }).poses.length, isFigureTag('map-squeeze'), isFigureTag('map'));
  `);
  assert.equal(scriptOutput, '300 true false\n');
});

test('an import in a React server component fails with an explanation', () => {
  const scriptPath = join(installedProject.directory, 'server.mjs');
  writeFileSync(scriptPath, "import 'motion-widgets';");
  const { stderr } = spawnSync(process.execPath, ['--conditions=react-server', scriptPath], { encoding: 'utf8' });
  assert.match(stderr, /Error: motion-widgets is imported by a server component.*'motion-widgets\/react'/);
  // The core has no elements, so that a server can import it.
  writeFileSync(scriptPath, "import { load } from 'motion-widgets/core'; console.log(typeof load);");
  assert.equal(execFileSync(process.execPath, ['--conditions=react-server', scriptPath], { encoding: 'utf8' }), 'function\n');
});

/** Source of a page in TypeScript with React. The page uses components, their events, and tags of the elements. */
const REACT_SOURCE = `
    import { useRef } from 'react';
    import { BananaMachine, MapSqueeze } from 'motion-widgets/react';
    import type { BananaMachineElement } from 'motion-widgets';

    export function Page() {
      const figure = useRef<BananaMachineElement>(null);
      const skew: number | undefined = figure.current?.stats?.crossTrackSkew;
      return (
        <>
          <BananaMachine ref={figure} omega="0.8" samples={20000} alphas={[0.1, 0.1, 0.1, 0.1, 0, 0]} className="wide" id="first" lang="de"
            style={{ margin: 0 }} share overlays={['command']} headingLevel={3}
            onStats={({ detail, currentTarget }) => console.log(detail.crossTrackSkew.toFixed(2), currentTarget.omega)}
            onError={({ message }) => console.log(message.length)} onChange={({ currentTarget }) => currentTarget.getState()}>
            <span slot="title">Figure 1</span>
          </BananaMachine>
          <MapSqueeze sampler="whole-arc" start={{ x: 0, y: 0, theta: 0 }} onStats={({ detail }) => detail.accepted} key="map" />
          <banana-machine omega="0.8" samples={20000} heading-level={3} class="wide" onstats={({ detail }) => detail.n} />
          <map-squeeze share conditioned="false" />
          <p>{skew}</p>
          {/* @ts-expect-error */}
          <BananaMachine omega="fast" />
          {/* @ts-expect-error */}
          <BananaMachine omga={1} />
          {/* @ts-expect-error */}
          <BananaMachine onStats={({ detail }) => detail.accepted} />
          {/* @ts-expect-error */}
          <MapSqueeze sampler="half-arc" />
          {/* @ts-expect-error */}
          <banana-machine model="walking" />
          {/* @ts-expect-error */}
          <banana-machine alphas={[0.1, 0.1, 0.1, 0.1, 0, 0]} />
        </>
      );
    }
`;

test('TypeScript finds the types of elements, React components and core under every module resolution', () => {
  writeFileSync(
    join(installedProject.directory, 'typed.ts'),
    `import 'motion-widgets';
     import 'motion-widgets/motion-widgets.css';
     import { load, type Stats } from 'motion-widgets/core';
     import { load as loadExternal } from 'motion-widgets/external';
     const omega: number | undefined = document.querySelector('banana-machine')?.omega;
     document.createElement('map-squeeze').sampler = 'whole-arc';
     const stats: Stats = new (await load()).BananaMachine({ samples: 10 }).stats;
     await loadExternal('/motion.wasm');
     document.createElement('banana-machine').addEventListener('stats', ({ detail }) => detail.crossTrackSkew.toFixed(2));
     document.createElement('map-squeeze').addEventListener('pointermove', ({ clientX }) => clientX);
     // @ts-expect-error: only banana-machine has a cross-track skew
     document.createElement('map-squeeze').addEventListener('stats', ({ detail }) => detail.crossTrackSkew);
     // @ts-expect-error: omega is a number
     document.createElement('banana-machine').omega = true;
     export { omega, stats };`,
  );
  writeFileSync(join(installedProject.directory, 'typed.tsx'), REACT_SOURCE);
  for (const name of ['@types/react', 'csstype']) cpSync(join(REPOSITORY_ROOT, 'node_modules', name), join(installedProject.directory, 'node_modules', name), { recursive: true });
  // The script must be in the directory of a module, so that top-level await is allowed.
  writeFileSync(join(installedProject.directory, 'package.json'), '{ "private": true, "type": "module" }');
  for (const [moduleOption, resolutionOption] of [['esnext', 'bundler'], ['nodenext', 'nodenext']]) {
    const compilerOptions = ['--noEmit', '--strict', '--jsx', 'react-jsx', '--target', 'es2023', '--lib', 'es2023,esnext.disposable,dom,dom.iterable', '--types', ''];
    const sourceFiles = ['typed.ts', 'typed.tsx'];
    const compilerArguments = [join(REPOSITORY_ROOT, 'node_modules/typescript/bin/tsc'), ...compilerOptions, '--module', moduleOption, '--moduleResolution', resolutionOption, ...sourceFiles];
    const { status: exitStatus, stdout } = spawnSync(process.execPath, compilerArguments, { cwd: installedProject.directory, encoding: 'utf8' });
    assert.equal(exitStatus, 0, stdout);
  }
});

/**
 * Opens a page with three elements and some of the package's scripts. Waits until the elements have drawn.
 *
 * @param {string} scriptNames
 * @returns {Promise<string[]>} addresses of requested WebAssembly modules
 */
async function openPageWith(scriptNames) {
  const elementsHtml = '<banana-machine></banana-machine><banana-machine></banana-machine><map-squeeze></map-squeeze>';
  const page = await installedProject.openPage();
  /** @type {string[]} */
  const requestedUrls = [];
  page.on('request', (pageRequest) => requestedUrls.push(pageRequest.url()));
  await page.route('**/page.html', (route) => {
    route.fulfill({ contentType: 'text/html', body: `<!doctype html><link rel="icon" href="data:,">${scriptNames}${elementsHtml}` });
  });
  await page.goto(`${installedProject.address}page.html`);
  for (const figureElement of await page.locator('banana-machine, map-squeeze').all()) {
    await figureElement.scrollIntoViewIfNeeded();
    await figureElement.locator('canvas').first().waitFor({ timeout: 10_000 });
  }
  return requestedUrls.filter((url) => url.includes('.wasm'));
}

const DIST_PATH = '/node_modules/motion-widgets/dist/';
const scriptTagOf = (/** @type {string} */ name) => `<script type="module" src="${DIST_PATH}${name}"></script>`;

test('custom-elements.json lists the attributes, properties, events and parts of the elements', async () => {
  const { modules: manifestModules } = JSON.parse(readFileSync(packagedPathOf('dist/custom-elements.json'), 'utf8'));
  /** @type {any[]} */
  const elementDeclarations = manifestModules[0].declarations;
  assert.deepEqual(elementDeclarations.map(({ tagName }) => tagName).sort(), Object.keys(settings).sort());
  const page = await installedProject.browser.newPage();
  await page.goto(`${installedProject.address}plain/`);
  for (const { tagName, attributes, members: classMembers, events: elementEvents, cssParts, cssProperties } of elementDeclarations) {
    const sortedNamesOf = (/** @type {{ name: string }[]} */ namedItems) => namedItems.map(({ name }) => name).sort();
    const actualNames = await page.evaluate(async ([widgetTag, memberNames]) => {
      const element = /** @type {any} */ (document.body.appendChild(document.createElement(widgetTag)));
      await customElements.whenDefined(widgetTag);
      await element.settled;
      const { shadowRoot, constructor } = element;
      for (const detailsElement of shadowRoot.querySelectorAll('details')) detailsElement.open = true;
      // A disclosure renders its contents after the browser's `toggle` event.
      while (shadowRoot.querySelector('details[open] > .folded:empty')) await new Promise(requestAnimationFrame);
      // This button of Map Squeeze puts a table with four legs into the room.
      shadowRoot.querySelector('div.table button')?.click();
      await element.settled;
      const cssText = [...new Set(constructor.elementStyles.map(String))].join('');
      return {
        attributes: [...constructor.elementProperties].flatMap(([name, { attribute, reflect, converter }]) => (attribute !== false && (reflect || converter?.toAttribute) ? [(typeof attribute === 'string' ? attribute : name).toLowerCase()] : [])),
        missingMembers: memberNames.filter((name) => !(name in element)),
        parts: [...shadowRoot.querySelectorAll('[part]')].flatMap(({ part: partNames }) => [...partNames]),
        properties: [...new Set(cssText.match(/--motion-[a-z-]+/g))],
      };
    }, /** @type {[string, string[]]} */ ([tagName, sortedNamesOf(classMembers)]));
    // Names of HTML attributes have no capital letters.
    assert.deepEqual(sortedNamesOf(attributes).map((name) => name.toLowerCase()).sort(), actualNames.attributes.sort(), tagName);
    assert.deepEqual(actualNames.missingMembers, [], tagName);
    for (const { name, return: returnType } of classMembers) if (name === 'getState') assert.equal(returnType.type.text, `${toPascalCase(tagName)}State | null`);
    for (const { name, description } of [...attributes, ...classMembers, ...elementEvents, ...cssParts, ...cssProperties]) assert.ok(description, `${name} of ${tagName}`);
    assert.deepEqual(sortedNamesOf(elementEvents), ['change', 'error', 'input', 'load', 'stats']);
    // The element with the part `notice` exists only while there is a notice.
    assert.deepEqual(sortedNamesOf(cssParts), [...new Set([...actualNames.parts, 'notice'])].sort(), `parts of ${tagName}`);
    assert.deepEqual(sortedNamesOf(cssProperties), actualNames.properties.sort(), `properties of ${tagName}`);
  }
});

test('external.js loads a widget when its tag appears, with messages that the page has set before', async () => {
  const page = await installedProject.browser.newPage();
  /** @type {string[]} */
  const requestedPaths = [];
  page.on('request', (request) => requestedPaths.push(new URL(request.url()).pathname));
  const moduleScript = `<script type="module">import { setMessages } from '${DIST_PATH}external.js';
    setMessages('fr', { stepLabel: 'Un pas', squeeze: { title: 'Le plan' } });</script>`;
  const pageHtml = `<!doctype html><html lang="fr"><link rel="icon" href="data:,">${moduleScript}<banana-machine></banana-machine><x-late></x-late>`;
  await page.route('**/page.html', (route) => route.fulfill({ contentType: 'text/html', body: pageHtml }));
  await page.goto(`${installedProject.address}page.html`);
  await page.locator('banana-machine canvas').first().waitFor();
  const listSqueezeRequestPaths = () => requestedPaths.filter((filePath) => filePath.includes('/map-squeeze-'));
  assert.deepEqual(listSqueezeRequestPaths(), []);
  // The element that is defined later has a Map Squeeze in its shadow root.
  await page.evaluate(() => {
    const LateElement = class extends HTMLElement {
      connectedCallback() {
        this.attachShadow({ mode: 'open' }).innerHTML = '<map-squeeze></map-squeeze>';
      }
    };
    customElements.define('x-late', LateElement);
  });
  await page.locator('map-squeeze').scrollIntoViewIfNeeded();
  await page.getByRole('region', { name: 'Le plan' }).getByRole('button', { name: 'Un pas' }).waitFor();
  assert.equal(listSqueezeRequestPaths().length, 1);
});

test('package.json names no file that the package leaves out', () => {
  const { bin, exports, main, types, unpkg, jsdelivr, customElements } = JSON.parse(readFileSync(packagedPathOf('package.json'), 'utf8'));
  /** @type {(value: any) => string[]} */
  const pathsOf = (exportTarget) => (typeof exportTarget === 'string' ? [exportTarget] : Object.values(exportTarget).flatMap(pathsOf));
  const allPaths = [...pathsOf(bin), ...pathsOf(exports), main, types, unpkg, jsdelivr, customElements];
  assert.ok(allPaths.length > 10, allPaths.join(' '));
  assert.deepEqual(allPaths.filter((filePath) => !existsSync(packagedPathOf(filePath))), []);
});

test('doc/calibration.md describes every option of the command that the package installs', () => {
  const { status: exitStatus, stdout } = spawnSync(process.execPath, [packagedPathOf('dist/cli.js'), '--help'], { encoding: 'utf8' });
  assert.equal(exitStatus, 0);
  const commandOptions = new Set(stdout.match(/--[a-z-]+/g));
  assert.ok(commandOptions.size > 15, [...commandOptions].join(' '));
  const calibrationDocument = readFileSync(join(REPOSITORY_ROOT, 'doc/calibration.md'), 'utf8');
  assert.deepEqual([...commandOptions].filter((commandOption) => commandOption !== '--help' && !calibrationDocument.includes(`\`${commandOption}`) && !calibrationDocument.includes(` ${commandOption}`)), []);
});

test('all released packages have the same version', () => {
  const { version: packageVersion } = JSON.parse(readFileSync(packagedPathOf('package.json'), 'utf8'));
  for (const filePath of ['Cargo.toml', 'python/pyproject.toml']) {
    assert.equal(readFileSync(join(REPOSITORY_ROOT, filePath), 'utf8').match(/^version = "(.+)"$/m)?.[1], packageVersion, filePath);
  }
});

test('the classic script is ASCII, so that the encoding of its page has no effect', () => {
  const scriptBytes = readFileSync(join(REPOSITORY_ROOT, 'dist/motion-widgets.iife.js'));
  assert.equal(scriptBytes.find((scriptByte) => scriptByte > 127), undefined);
});

test('two copies of the bundle on a page cause no error @nightly', async () => {
  const classicScript = '<script defer src="/iframe/motion-widgets.iife.js"></script>';
  for (const otherScript of [classicScript, scriptTagOf('external.js?copy')]) {
    await openPageWith(scriptTagOf('external.js') + otherScript);
  }
});

test('a script that imports external.js can set the address of the WebAssembly module', async () => {
  const moduleAddress = `${DIST_PATH}motion.wasm?mine`;
  const manifestModules = await openPageWith(`<script type="module">import { load } from '${DIST_PATH}external.js'; load('${moduleAddress}');</script>`);
  assert.deepEqual(manifestModules, [new URL(moduleAddress, installedProject.address).href]);
});

/** Opens a page with a figure. Its server answers requests for modules with HTML, as some servers do for missing files. @param {string} scriptTag */
async function openWithoutModules(scriptTag) {
  const page = await installedProject.browser.newPage();
  /** @type {string[]} */
  const consoleWarnings = [];
  page.on('console', (consoleMessage) => void (consoleMessage.type() === 'warning' && consoleWarnings.push(consoleMessage.text())));
  await page.route('**/*.wasm', (route) => route.fulfill({ contentType: 'text/html', body: '<!doctype html>' }));
  const pageHtml = `<!doctype html><link rel="icon" href="data:,">${scriptTag}<banana-machine></banana-machine>`;
  await page.route('**/page.html', (route) => route.fulfill({ contentType: 'text/html', body: pageHtml }));
  await page.goto(`${installedProject.address}page.html`);
  return { page, warnings: consoleWarnings };
}

const LOAD_ADVICE = "Copy motion.wasm from the package's dist/ into the site and give its address to load(), or leave the address out";

test('if a module’s file cannot be fetched, the embedded module is used, and a warning names the address and the remedy', async () => {
  const { page, warnings: consoleWarnings } = await openWithoutModules(scriptTagOf('external.js'));
  await page.locator('banana-machine canvas').first().waitFor();
  assert.equal(consoleWarnings.length, 1);
  assert.match(consoleWarnings[0], new RegExp(`${installedProject.address}\\S+\\.wasm answers with text/html, which is no WebAssembly module`));
  assert.ok(consoleWarnings[0].includes(LOAD_ADVICE));
});

test('an address without a module is refused, and the message names the remedy @nightly', async () => {
  const { page } = await openWithoutModules('');
  const loadPromise = page.evaluate(async (importAddress) => (await import(importAddress)).load('/none.wasm'), `${DIST_PATH}external.js`);
  await assert.rejects(loadPromise, (/** @type {Error} */ { message: errorMessage }) => errorMessage.includes('/none.wasm answers with text/html') && errorMessage.includes(LOAD_ADVICE));
});
