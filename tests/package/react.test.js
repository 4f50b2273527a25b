// motion-widgets/react as an application has it: its types, the server's HTML, and what the components do on a page.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { cpSync, mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, beforeEach, afterEach, test } from 'node:test';
import { build } from 'vite';
import { ROOT } from '../../scripts/process.mjs';
import { serve } from '../../scripts/serve.mjs';
import { installed, launch } from './support.js';

/** @type {ReturnType<typeof installed>} */
let project;
/** @type {import('@playwright/test').Browser} */
let browser;
/** @type {Awaited<ReturnType<typeof serve>>} */
let server;
/** @type {import('@playwright/test').Page} */
let page;
/** What the console said. @type {string[]} */
let complaints;

/** A page whose props a test changes, with what it heard. */
const APPLICATION = `
  import { createElement, useRef, useState } from 'react';
  import { BananaMachine, MapSqueeze } from 'motion-widgets/react';

  export const heard = [];
  export const page = {};

  export function Application({ first = {} }) {
    const [props, setProps] = useState(first);
    const [stats, setStats] = useState(null);
    const figure = useRef(null);
    Object.assign(page, { figure, setProps, renderings: (page.renderings ?? 0) + 1 });
    const hear = (name) => (event) => {
      // The console would say it.
      event.preventDefault();
      heard.push([name, event.currentTarget === figure.current, ...(event.message ? [event.message] : [])]);
    };
    const handlers = Object.fromEntries(['onLoad', 'onError', 'onInput', 'onChange'].map((name) => [name, hear(name)]));
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

const CLIENT = `
  import { StrictMode, createElement } from 'react';
  import { createRoot, hydrateRoot } from 'react-dom/client';
  import { Application, heard, page } from './application.js';

  const application = (first) => createElement(StrictMode, null, createElement(Application, { first }));
  const place = document.getElementById('root');
  Object.assign(globalThis, {
    heard,
    page,
    hydrate: (first) => hydrateRoot(place, application(first)),
    show: (first) => createRoot(place).render(application(first)),
  });
`;

before(async () => {
  project = installed();
  for (const name of ['react-dom', 'scheduler', 'csstype', '@types/react', '@types/react-dom']) {
    cpSync(join(ROOT, 'node_modules', name), join(project.directory, 'node_modules', name), { recursive: true });
  }
  mkdirSync(join(project.directory, 'react'));
  write('application.js', APPLICATION);
  write('client.js', CLIENT);
  const html = (/** @type {string} */ sent) => `<!doctype html><html lang="en"><link rel="icon" href="data:,"><div id="root">${sent}</div><script type="module" src="./client.js"></script>`;
  write('index.html', html(''));
  write('sent.html', html(sent({ omega: 0.8 })));
  write('refused.html', html(sent({ omega: NaN })));
  const root = join(project.directory, 'react');
  await build({
    root,
    base: './',
    // What is not bundled for a server needs no "use client", which a plugin for React would say.
    logLevel: 'error',
    // React says what is wrong while one develops.
    define: { 'process.env.NODE_ENV': '"development"' },
    build: { minify: false, rolldownOptions: { input: ['index.html', 'sent.html', 'refused.html'].map((name) => join(root, name)) } },
  });
  server = await serve(join(root, 'dist'), { port: 0 });
  browser = await launch();
});

after(async () => {
  server?.close();
  await browser?.close();
  project?.remove();
});

beforeEach(async () => {
  complaints = [];
  page = await browser.newPage();
  page.on('console', (message) => {
    if (['error', 'warning'].includes(message.type())) complaints.push(message.text());
  });
  page.on('pageerror', (error) => complaints.push(String(error)));
});

afterEach(() => page.close());

/**
 * @param {string} name
 * @param {string} contents
 */
function write(name, contents) {
  writeFileSync(join(project.directory, 'react', name), contents);
}

/**
 * @param {object} props of the first figure; as source, for JSON has no NaN
 * @returns {string} what a server sends
 */
function sent(props) {
  const text = JSON.stringify(props, (_, value) => (Number.isNaN(value) ? 'NaN' : value)).replaceAll('"NaN"', 'NaN');
  const source = `
    import { createElement } from 'react';
    import { renderToString } from 'react-dom/server';
    import { Application } from './application.js';
    console.log(renderToString(createElement(Application, { first: ${text} })));`;
  write('server.mjs', source);
  write('package.json', '{ "type": "module" }');
  const script = join(project.directory, 'react/server.mjs');
  return execFileSync(process.execPath, [script], { encoding: 'utf8', env: { ...process.env, NODE_ENV: 'development' } }).trim();
}

/** Waits until the page has heard of all samples of the first figure. */
const whole = () => page.getByText('of 2000').waitFor();

/** Waits for all samples of the first figure, which React does not know yet. */
const drawn = () => page.waitForFunction(() => /** @type {any} */ (document.querySelector('banana-machine')).stats?.n === 2000);

/** @param {string} name of the file */
async function open(name) {
  await page.goto(new URL(name, server.address).href);
  await page.waitForFunction(() => 'hydrate' in globalThis);
}

/** @param {Record<string, unknown> | null} props of the first figure; none where it is to go */
const set = (props) => page.evaluate((given) => /** @type {any} */ (globalThis).page.setProps(given), props);

/** @param {string} name of a property of the first figure */
const property = (name) => page.evaluate((key) => /** @type {any} */ (document.querySelector('banana-machine'))[key], name);

/** @returns {Promise<[name: string, onFigure: boolean, message?: string][]>} */
const heard = () => page.evaluate(() => /** @type {any} */ (globalThis).heard);

test('TypeScript knows components, their events, and the tags', () => {
  const lines = `
    import { useRef } from 'react';
    import { BananaMachine, MapSqueeze } from 'motion-widgets/react';
    import type { BananaMachineElement } from 'motion-widgets';

    export function Page() {
      const figure = useRef<BananaMachineElement>(null);
      const skew: number | undefined = figure.current?.stats?.crossTrackSkew;
      return (
        <>
          <BananaMachine ref={figure} omega="0.8" samples={20000} alphas={[0.1, 0.1, 0.1, 0.1, 0, 0]} className="wide" id="first" lang="de"
            style={{ margin: 0 }} share overlays={['command']} headingLevel="3"
            onStats={({ detail, currentTarget }) => console.log(detail.crossTrackSkew.toFixed(2), currentTarget.omega)}
            onError={({ message }) => console.log(message.length)} onChange={({ currentTarget }) => currentTarget.getState()}>
            <span slot="title">Figure 1</span>
          </BananaMachine>
          <MapSqueeze sampler="whole-arc" start={{ x: 0, y: 0, theta: 0 }} onStats={({ detail }) => detail.accepted} key="map" />
          <banana-machine omega="0.8" samples={20000} heading-level="3" class="wide" onstats={({ detail }) => detail.n} />
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
  writeFileSync(join(project.directory, 'typed.tsx'), lines);
  const options = ['--noEmit', '--strict', '--jsx', 'react-jsx', '--target', 'es2023', '--lib', 'es2023,esnext.disposable,dom,dom.iterable', '--types', ''];
  for (const [module, resolution] of [['esnext', 'bundler'], ['nodenext', 'nodenext']]) {
    const args = [join(ROOT, 'node_modules/typescript/bin/tsc'), ...options, '--module', module, '--moduleResolution', resolution, 'typed.tsx'];
    const run = () => execFileSync(process.execPath, args, { cwd: project.directory, encoding: 'utf8' });
    assert.doesNotThrow(run, (error) => assert.fail(/** @type {{ stdout: string }} */ (error).stdout));
  }
});

test('a server sends what attributes say', () => {
  const html = sent({ omega: '0.8', overlays: ['command', 'ellipse'], reverseAware: true, headingLevel: '2', share: true, isolate: null });
  const [tag] = html.match(/<banana-machine[^>]*>/) ?? [];
  const attributes = { reverseAware: '', omega: '0.8', samples: '2000', overlays: 'command ellipse', share: '', 'heading-level': '2', class: 'wide' };
  const named = Object.fromEntries([...(tag ?? '').matchAll(/ ([\w-]+)="([^"]*)"/g)].map(([, name, text]) => [name, text]));
  assert.deepEqual(named, attributes);
  assert.match(html, /<map-squeeze conditioned="false" heading-level="3">/);
  assert.match(html, /<span slot="title">Figure 1<\/span>/);
});

test('what the server has sent is taken over, before its elements are there', async () => {
  await open('sent.html');
  await page.evaluate(() => /** @type {any} */ (globalThis).hydrate({ omega: 0.8 }));
  await whole();
  assert.equal(await property('omega'), 0.8);
  assert.deepEqual(await property('alphas'), [0.1, 0.1, 0.1, 0.1, 0, 0]);
  assert.deepEqual((await heard())[0], ['onLoad', true]);
  assert.deepEqual(complaints, []);
});

test('an element that the reader has used before React came stays as it is, and React hears of it', async () => {
  await open('sent.html');
  await drawn();
  await page.getByRole('slider', { name: /^v,/ }).first().press('ArrowRight');
  const v = await property('v');
  assert.notEqual(v, 1);
  await page.evaluate(() => /** @type {any} */ (globalThis).hydrate({ omega: 0.8 }));
  await page.getByText('of 2000').waitFor();
  assert.equal(await property('v'), v);
  assert.deepEqual((await heard())[0], ['onLoad', true]);
  assert.deepEqual(complaints, []);
});

test('what an element has refused before React came, React hears of', async () => {
  await open('refused.html');
  await drawn();
  assert.match(complaints.splice(0).join(), /omega is "NaN"/);
  await page.evaluate(() => /** @type {any} */ (globalThis).hydrate({ omega: NaN }));
  await page.getByText('of 2000').waitFor();
  assert.match((await heard()).join(), /onError,true,.*omega is NaN; allowed/);
  assert.deepEqual(complaints, []);
});

test('a list in JSX, and a page that is rendered at every figure, leave what the reader does', async () => {
  await open('index.html');
  await page.evaluate(() => /** @type {any} */ (globalThis).show({}));
  await whole();
  await page.getByRole('slider', { name: /^α1/ }).press('ArrowRight');
  await page.waitForFunction(() => /** @type {any} */ (globalThis).heard.some((/** @type {string[]} */ [name]) => name === 'onChange'));
  await set({ omega: 0.3 });
  await page.waitForFunction(() => /** @type {any} */ (document.querySelector('banana-machine')).omega === 0.3);
  assert.notEqual(await property('alpha1'), 0.1);
  // Nothing goes round and round.
  const renderings = await page.evaluate(async () => {
    const { page } = /** @type {any} */ (globalThis);
    for (let i = 0; i < 10; i++) await new Promise(requestAnimationFrame);
    const before = page.renderings;
    for (let i = 0; i < 30; i++) await new Promise(requestAnimationFrame);
    return page.renderings - before;
  });
  assert.equal(renderings, 0);
  assert.deepEqual(complaints, []);
});

test('a prop that is refused is told, one that goes leaves the element as it opens', async () => {
  await open('index.html');
  await page.evaluate(() => /** @type {any} */ (globalThis).show({ omega: 0.8, marked: 7, conditioned: false }));
  await whole();
  assert.equal(await property('marked'), 7);
  await page.evaluate(() => /** @type {any} */ (globalThis).page.setProps({ omega: NaN, alphas: [1, 2] }));
  await page.waitForFunction(() => /** @type {any} */ (globalThis).heard.filter((/** @type {string[]} */ [name]) => name === 'onError').length === 2);
  assert.equal(await property('omega'), 0.8);
  assert.deepEqual(await property('alphas'), [0.1, 0.1, 0.1, 0.1, 0, 0]);
  await page.evaluate(() => /** @type {any} */ (globalThis).page.setProps({ alphas: undefined }));
  await page.waitForFunction(() => /** @type {any} */ (document.querySelector('banana-machine')).omega === 0.5);
  assert.deepEqual(await property('alphas'), [0.05, 0.05, 0.05, 0.09, 0.01, 0.01]);
  assert.equal(await property('marked'), null);
  assert.deepEqual(complaints, []);
});

test('a component that goes leaves nothing', async () => {
  await open('index.html');
  await page.evaluate(() => /** @type {any} */ (globalThis).show({}));
  await whole();
  await page.evaluate(() => Object.assign(globalThis, { left: document.querySelector('banana-machine') }));
  await set(null);
  await page.getByText('It has gone.').waitFor();
  const { elements, more } = await page.evaluate(() => {
    const { left, heard } = /** @type {any} */ (globalThis);
    const before = heard.length;
    for (const type of ['load', 'error', 'input', 'change']) left.dispatchEvent(new Event(type));
    return { elements: document.querySelectorAll('banana-machine, map-squeeze').length, more: heard.length - before };
  });
  assert.deepEqual({ elements, more }, { elements: 0, more: 0 });
  await set({ omega: 0.2 });
  await whole();
  assert.equal(await property('omega'), 0.2);
  assert.deepEqual(complaints, []);
});
