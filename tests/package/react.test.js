// The module motion-widgets/react in an application: its types, the server's HTML, and the behaviour of the components on a page.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { cpSync, mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { buildSync } from 'esbuild';
import { REPOSITORY_ROOT } from '../../scripts/process.mjs';
import { serveProject } from './support.js';

const installedProject = serveProject(prepareProject);
/** @type {import('@playwright/test').Page} */
let page;

/** Source of a React application. Tests change the props by `page.setProps`, and read the events in `receivedEvents`. */
const APPLICATION_SOURCE = `
  import { createElement, useRef, useState } from 'react';
  import { BananaMachine, MapSqueeze } from 'motion-widgets/react';

  export const receivedEvents = [];
  export const page = {};

  export function Application({ first = {} }) {
    const [props, setProps] = useState(first);
    const [stats, setStats] = useState(null);
    const figure = useRef(null);
    Object.assign(page, { figure, setProps, renderings: (page.renderings ?? 0) + 1 });
    const recordEvent = (name) => (event) => {
      // Without preventDefault() the figure would also write the error to the console.
      event.preventDefault();
      receivedEvents.push([name, event.currentTarget === figure.current, ...(event.message ? [event.message] : [])]);
    };
    const handlers = Object.fromEntries(['onLoad', 'onError', 'onInput', 'onChange'].map((name) => [name, recordEvent(name)]));
    const onStats = ({ detail }) => setStats(detail);
    if (props === null) return createElement('p', null, 'It has gone.');
    return createElement('main', null,
      createElement(BananaMachine, { ref: figure, className: 'wide', samples: 2000, alphas: [0.1, 0.1, 0.1, 0.1, 0, 0], onStats, ...handlers, ...props },
        createElement('span', { slot: 'title' }, 'Figure 1')),
      createElement(MapSqueeze, { share: false, conditioned: false, headingLevel: 3 }),
      createElement('p', null, stats ? 'of ' + stats.n : 'none yet'),
    );
  }
`;

const CLIENT_SOURCE = `
  import { StrictMode, createElement } from 'react';
  import { createRoot, hydrateRoot } from 'react-dom/client';
  import { Application, receivedEvents, page } from './application.js';

  const applicationElement = (first) => createElement(StrictMode, null, createElement(Application, { first }));
  const rootElement = document.getElementById('root');
  Object.assign(globalThis, {
    receivedEvents,
    page,
    hydrate: (first) => hydrateRoot(rootElement, applicationElement(first)),
    show: (first) => createRoot(rootElement).render(applicationElement(first)),
  });
`;

function prepareProject() {
  for (const packageName of ['react-dom', 'scheduler']) {
    cpSync(join(REPOSITORY_ROOT, 'node_modules', packageName), join(installedProject.directory, 'node_modules', packageName), { recursive: true });
  }
  mkdirSync(join(installedProject.directory, 'react'));
  writeInProject('application.js', APPLICATION_SOURCE);
  writeInProject('client.js', CLIENT_SOURCE);
  const pageHtmlOf = (/** @type {string} */ serverHtml) => `<!doctype html><html lang="en"><link rel="icon" href="data:,"><div id="root">${serverHtml}</div><script type="module" src="./bundle.js"></script>`;
  writeInProject('index.html', pageHtmlOf(''));
  writeInProject('sent.html', pageHtmlOf(renderServerHtml({ omega: 0.8 })));
  const appDirectory = join(installedProject.directory, 'react');
  // The tests use the development build of React, because it reports errors.
  const esbuildDefine = { 'process.env.NODE_ENV': '"development"' };
  buildSync({ entryPoints: [join(appDirectory, 'client.js')], bundle: true, format: 'esm', define: esbuildDefine, outfile: join(appDirectory, 'bundle.js'), logLevel: 'silent' });
}

/** Writes a file next to the installed package. @param {string} fileName @param {string} fileContents */
function writeInProject(fileName, fileContents) {
  writeFileSync(join(installedProject.directory, 'react', fileName), fileContents);
}

/** Returns the HTML that a server renders for a figure. @param {object} figureProps props, which may contain NaN */
function renderServerHtml(figureProps) {
  const propsSource = JSON.stringify(figureProps, (_, propValue) => (Number.isNaN(propValue) ? 'NaN' : propValue)).replaceAll('"NaN"', 'NaN');
  const serverSource = `
    import { createElement } from 'react';
    import { renderToString } from 'react-dom/server';
    import { Application } from './application.js';
    console.log(renderToString(createElement(Application, { first: ${propsSource} })));`;
  writeInProject('server.mjs', serverSource);
  writeInProject('package.json', '{ "type": "module" }');
  const scriptPath = join(installedProject.directory, 'react/server.mjs');
  return execFileSync(process.execPath, [scriptPath], { encoding: 'utf8', env: { ...process.env, NODE_ENV: 'development' } }).trim();
}

/** Waits until the last `stats` event of the first figure has 2000 samples. */
const waitUntilComplete = () => page.getByText('of 2000').waitFor();

/** Opens a page of the application. @param {string} pageName */
async function openPage(pageName) {
  page = await installedProject.openPage();
  await page.goto(new URL(`react/${pageName}`, installedProject.address).href);
  await page.waitForFunction(() => 'hydrate' in globalThis);
}

/** Sets the props of the first figure, or removes it. @param {Record<string, unknown> | null} props */
const setProps = (props) => page.evaluate((newProps) => /** @type {any} */ (globalThis).page.setProps(newProps), props);

/** Returns a property of the first figure. @param {string} propertyName */
const readProperty = (propertyName) => page.evaluate((propertyName) => /** @type {any} */ (document.querySelector('banana-machine'))[propertyName], propertyName);

/** Returns the events that the page received. @returns {Promise<[name: string, onFigure: boolean, message?: string][]>} */
const readReceivedEvents = () => page.evaluate(() => /** @type {any} */ (globalThis).receivedEvents);

test('server rendering writes props as attributes', () => {
  const serverHtml = renderServerHtml({ omega: '0.8', overlays: ['command', 'ellipse'], reverseAware: true, headingLevel: '2', share: true, isolate: null });
  const [openingTag] = serverHtml.match(/<banana-machine[^>]*>/) ?? [];
  const expectedAttributes = { reverseAware: '', omega: '0.8', samples: '2000', overlays: 'command ellipse', share: '', 'heading-level': '2', class: 'wide' };
  const actualAttributes = Object.fromEntries([...(openingTag ?? '').matchAll(/ ([\w-]+)="([^"]*)"/g)].map(([, attributeName, attributeText]) => [attributeName, attributeText]));
  assert.deepEqual(actualAttributes, expectedAttributes);
  assert.match(serverHtml, /<map-squeeze conditioned="false" heading-level="3">/);
  assert.match(serverHtml, /<span slot="title">Figure 1<\/span>/);
});

test('React hydrates the server’s HTML before the elements are defined', async () => {
  await openPage('sent.html');
  await page.evaluate(() => /** @type {any} */ (globalThis).hydrate({ omega: 0.8 }));
  await waitUntilComplete();
  assert.equal(await readProperty('omega'), 0.8);
  assert.deepEqual(await readProperty('alphas'), [0.1, 0.1, 0.1, 0.1, 0, 0]);
  assert.deepEqual((await readReceivedEvents())[0], ['onLoad', true]);
});

test('a new rendering keeps the user’s changes, and properties and events do not cause an endless loop', async () => {
  await openPage('index.html');
  await page.evaluate(() => /** @type {any} */ (globalThis).show({}));
  await waitUntilComplete();
  await page.locator('banana-machine').first().locator('#v').press('ArrowRight');
  await page.waitForFunction(() => /** @type {any} */ (globalThis).receivedEvents.some((/** @type {string[]} */ [eventName]) => eventName === 'onChange'));
  await setProps({ omega: 0.3 });
  await page.waitForFunction(() => /** @type {any} */ (document.querySelector('banana-machine')).omega === 0.3);
  assert.notEqual(await readProperty('v'), 1);
  const renderingCount = await page.evaluate(async () => {
    const { page } = /** @type {any} */ (globalThis);
    for (let i = 0; i < 10; i++) await new Promise(requestAnimationFrame);
    const countBefore = page.renderings;
    for (let i = 0; i < 30; i++) await new Promise(requestAnimationFrame);
    return page.renderings - countBefore;
  });
  assert.equal(renderingCount, 0);
});

test('a refused prop calls onError, and removing a prop restores the opening value @nightly', async () => {
  await openPage('index.html');
  await page.evaluate(() => /** @type {any} */ (globalThis).show({ omega: 0.8, marked: 7, conditioned: false }));
  await waitUntilComplete();
  assert.equal(await readProperty('marked'), 7);
  await page.evaluate(() => /** @type {any} */ (globalThis).page.setProps({ omega: NaN, alphas: [1, 2] }));
  await page.waitForFunction(() => /** @type {any} */ (globalThis).receivedEvents.filter((/** @type {string[]} */ [eventName]) => eventName === 'onError').length === 2);
  assert.equal(await readProperty('omega'), 0.8);
  assert.deepEqual(await readProperty('alphas'), [0.1, 0.1, 0.1, 0.1, 0, 0]);
  await page.evaluate(() => /** @type {any} */ (globalThis).page.setProps({ alphas: undefined }));
  await page.waitForFunction(() => /** @type {any} */ (document.querySelector('banana-machine')).omega === 0);
  assert.deepEqual(await readProperty('alphas'), [0.002, 0.002, 0.1, 0.1, 0.002, 0.002]);
  assert.equal(await readProperty('marked'), null);
});
