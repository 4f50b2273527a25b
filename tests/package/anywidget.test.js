// Module for notebooks (anywidget). The tests use models with the methods of models in Jupyter notebooks and in MyST books.

import assert from 'node:assert/strict';
import { join } from 'node:path';
import { test } from 'node:test';
import { REPOSITORY_ROOT } from '../../scripts/process.mjs';
import { settings } from '../../build/settings.js';
import { serveDirectory } from './support.js';

const siteServer = serveDirectory(() => join(REPOSITORY_ROOT, 'dist'));

/**
 * Opens a page that shows a model. The page's global variable `view` is for the test. `log` lists the traits that were set and saved.
 * `end()` removes the figure. `state` has the traits, which are the values of the model.
 *
 * @param {Record<string, unknown>} modelState
 * @param {'notebook' | 'book'} hostKind in a book, some methods of the model throw as MyST's model does, and the figure is in a shadow root
 */
async function openPageShowing(modelState, hostKind) {
  const page = await siteServer.openPage();
  const pageHtml = '<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,"><div id="cell"></div>';
  await page.route('**/page.html', (route) => route.fulfill({ contentType: 'text/html', body: pageHtml }));
  await page.goto(`${siteServer.address}page.html`);
  await page.evaluate(renderModel, { state: modelState, isInBook: hostKind === 'book' });
  return page;
}

/** Renders a figure of a model. Runs in the page. @param {{ state: Record<string, unknown>, isInBook: boolean }} given */
async function renderModel({ state: modelState, isInBook }) {
  const modelListeners = new Map();
  const traitLog = /** @type {unknown[]} */ ([]);
  const throwMissingMember = (/** @type {string} */ memberName) => {
    throw new Error(`${memberName} not implemented yet.`);
  };
  const widgetModel = {
    get: (/** @type {string} */ traitName) => modelState[traitName],
    set(/** @type {string} */ traitName, /** @type {unknown} */ traitValue) {
      traitLog.push([traitName, traitValue]);
      modelState[traitName] = traitValue;
      for (const changeListener of modelListeners.get(`change:${traitName}`) ?? []) changeListener();
    },
    on: (/** @type {string} */ traitName, /** @type {() => void} */ listener) => modelListeners.set(traitName, (modelListeners.get(traitName) ?? new Set()).add(listener)),
    off: (/** @type {string} */ traitName, /** @type {() => void} */ listener) => (isInBook ? throwMissingMember('off') : modelListeners.get(traitName)?.delete(listener)),
    save_changes: () => (isInBook ? throwMissingMember('save_changes') : traitLog.push('saved')),
  };
  const cellElement = /** @type {HTMLElement} */ (document.querySelector('#cell'));
  const el = isInBook ? cellElement.attachShadow({ mode: 'open' }).appendChild(document.createElement('div')) : cellElement;
  const moduleAddress = '/anywidget.js';
  const { default: anywidgetModule } = await import(moduleAddress);
  const removeFigure = anywidgetModule.render({ model: widgetModel, el });
  Object.assign(globalThis, { view: { model: widgetModel, state: modelState, log: traitLog, el, end: removeFigure, listeners: modelListeners } });
}

/** Waits until the figure of a page has all its samples. @param {import('@playwright/test').Page} page */
async function waitUntilComplete(page) {
  await page.locator('canvas').first().waitFor();
  await page.evaluate(() => /** @type {any} */ (globalThis).view.el.firstElementChild.settled);
  await waitForFrames(page);
}

/** Waits for three animation frames. @param {import('@playwright/test').Page} page */
const waitForFrames = (page) =>
  page.evaluate(async () => {
    for (let i = 0; i < 3; i++) await new Promise(requestAnimationFrame);
  });

/**
 * Returns traits of the model, and the figure's properties of the same names.
 *
 * @param {import('@playwright/test').Page} page
 * @param {string[]} requestedNames
 * @returns {Promise<{ traits: Record<string, unknown>, figure: Record<string, unknown> }>}
 */
const readTraitsAndProperties = (page, requestedNames) =>
  page.evaluate((requestedNames) => {
    const { el, state: modelState } = /** @type {any} */ (globalThis).view;
    const pickTraits = (/** @type {any} */ modelOrFigure) => Object.fromEntries(requestedNames.map((traitName) => [traitName, modelOrFigure[traitName]]));
    return { traits: pickTraits(modelState), figure: pickTraits(el.firstElementChild) };
  }, requestedNames);

/** Sets traits of the model, after clearing the recorded calls. @param {import('@playwright/test').Page} page @param {Record<string, unknown>} changedTraits */
const setTraits = async (page, changedTraits) => {
  await page.evaluate((newValues) => {
    const { model: widgetModel, log: callLog } = /** @type {any} */ (globalThis).view;
    callLog.length = 0;
    for (const [traitName, traitValue] of Object.entries(newValues)) widgetModel.set(traitName, traitValue);
  }, changedTraits);
  await waitForFrames(page);
};

/** Traits that every model of a notebook has besides the settings. */
const KERNEL_TRAITS = { stats: null, error: '', _asked: 0, _shown: {} };

test('the figure applies traits under either spelling of their names, and traits without a value get the figure’s value', async () => {
  const modelState = { ...KERNEL_TRAITS, widget: 'banana-machine', omega: 0.8, samples: '2000', reverse_aware: true, 'heading-level': 3, v: null, alphas: null, preset: null, lang: 'de' };
  const page = await openPageShowing(modelState, 'notebook');
  await waitUntilComplete(page);
  const { figure: figureValues, traits: traitValues } = await readTraitsAndProperties(page, ['omega', 'samples', 'reverseAware', 'headingLevel', 'v', 'preset', 'alphas', 'lang']);
  assert.deepEqual(figureValues, { omega: 0.8, samples: 2000, reverseAware: true, headingLevel: '3', v: 1, preset: null, alphas: [0.002, 0.002, 0.1, 0.1, 0.002, 0.002], lang: 'de' });
  assert.equal(traitValues.v, 1);
  assert.equal(traitValues.samples, 2000);
  assert.deepEqual(traitValues.alphas, figureValues.alphas);
  await page.getByRole('button', { name: 'Neuer Startwert' }).waitFor();
  await setTraits(page, { lang: null, omega: null });
  assert.deepEqual((await readTraitsAndProperties(page, ['omega', 'lang'])).figure, { omega: 0, lang: '' });
  await page.getByRole('button', { name: 'New seed' }).waitFor();
});

test('a trait with a trailing underscore, as for Python keywords, is synchronized with the property without the underscore', async () => {
  const startPose = { x: 1, y: 2, theta: 0.5 };
  const page = await openPageShowing({ ...KERNEL_TRAITS, widget: 'odometry-decomposer', from_: startPose }, 'notebook');
  await page.locator('canvas').first().waitFor();
  assert.deepEqual((await readTraitsAndProperties(page, ['from'])).figure, { from: startPose });
  await setTraits(page, { from_: null });
  const { figure: figureValues, traits: traitValues } = await readTraitsAndProperties(page, ['from', 'from_']);
  assert.notDeepEqual(figureValues.from, startPose);
  assert.deepEqual(traitValues.from_, figureValues.from);
});

test('a change of the model is applied to the figure, resulting changes return to the model, and an equal value has no effect', async () => {
  const page = await openPageShowing({ ...KERNEL_TRAITS, widget: 'banana-machine', samples: 100, preset: null, omega: null, v: null, dt: null, command: null, isolate: null }, 'notebook');
  await waitUntilComplete(page);
  await setTraits(page, { _asked: 1, preset: 'hard' });
  const { traits: traitValues, figure: figureValues } = await readTraitsAndProperties(page, ['preset', 'v', 'omega', 'dt', 'command']);
  assert.deepEqual(figureValues, { preset: 'hard', v: 1, omega: 1.2, dt: 1.4, command: { v: 1, omega: 1.2, dt: 1.4 } });
  assert.deepEqual(traitValues, figureValues);
  const { traits: { _shown } } = await readTraitsAndProperties(page, ['_shown']);
  assert.deepEqual(_shown, { heard: 1, settings: { ...traitValues, samples: 100, isolate: null } });

  // A kernel may send several changes at once. The figure must not send an earlier value back.
  await page.evaluate(() => {
    const { state: modelState, listeners: modelListeners } = /** @type {any} */ (globalThis).view;
    Object.assign(modelState, { omega: 0.2, v: 0.5 });
    for (const traitName of ['omega', 'v']) for (const listener of modelListeners.get(`change:${traitName}`)) listener();
  });
  await waitForFrames(page);
  const valuesAfterChanges = await readTraitsAndProperties(page, ['preset', 'v', 'omega']);
  assert.deepEqual(valuesAfterChanges.figure, { preset: null, v: 0.5, omega: 0.2 });
  assert.deepEqual(valuesAfterChanges.traits, valuesAfterChanges.figure);

  await setTraits(page, { command: { dt: 1.4, omega: 0.2, v: 0.5 } });
  const callLog = await page.evaluate(() => /** @type {any} */ (globalThis).view.log);
  assert.deepEqual(callLog, [['command', { dt: 1.4, omega: 0.2, v: 0.5 }]]);
});

test('a refused value is reported by the trait `error`, and its trait returns to the last valid value', async () => {
  const page = await openPageShowing({ ...KERNEL_TRAITS, widget: 'banana-machine', samples: 100, alphas: null }, 'notebook');
  await waitUntilComplete(page);
  const { traits: { alphas } } = await readTraitsAndProperties(page, ['alphas']);
  await setTraits(page, { alphas: [1, 2, 3] });
  const { traits: traitValues } = await readTraitsAndProperties(page, ['alphas', 'error']);
  assert.match(String(traitValues.error), /^alphas .*allowed/);
  assert.deepEqual(traitValues.alphas, alphas);
  await setTraits(page, { samples: 200 });
  assert.deepEqual((await readTraitsAndProperties(page, ['samples', 'error'])).traits, { samples: 200, error: '' });
});

test('in a MyST book, whose models cannot save, the figure works, and a removed figure leaves no listeners @nightly', async () => {
  for (const hostKind of /** @type {const} */ (['book', 'notebook'])) {
    const page = await openPageShowing({ widget: 'map-squeeze', preset: 'corridor', samples: '300', view: 'whole' }, hostKind);
    await waitUntilComplete(page);
    const { figure: figureValues, traits: traitValues } = await readTraitsAndProperties(page, ['preset', 'samples', 'view']);
    assert.deepEqual(figureValues, { preset: 'corridor', samples: 300, view: 'whole' });
    await page.getByRole('slider', { name: /noise level/ }).focus();
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press('Tab');
    await waitForFrames(page);
    // The model has only the traits that the page has set.
    assert.deepEqual(Object.keys(await page.evaluate(() => /** @type {any} */ (globalThis).view.state)).sort(), ['preset', 'samples', 'view', 'widget']);
    assert.equal(traitValues.preset, 'corridor');
    const remainsAfterRemoval = await page.evaluate(() => {
      const { el, end, listeners: modelListeners } = /** @type {any} */ (globalThis).view;
      end();
      return { html: el.innerHTML, listeners: [...modelListeners.values()].reduce((sum, { size: listenerCount }) => sum + listenerCount, 0) };
    });
    assert.equal(remainsAfterRemoval.html, '');
    if (hostKind === 'notebook') assert.equal(remainsAfterRemoval.listeners, 0);
  }
});

test('a model without a known widget shows the allowed widgets instead of a figure @nightly', async () => {
  for (const [widget, shownValue] of [[undefined, 'missing'], ['banana', '"banana"']]) {
    const page = await openPageShowing({ widget }, 'book');
    await page.getByText(`This cell shows no figure: widget is ${shownValue}; allowed is ${Object.keys(settings).join(' or ')}.`).waitFor();
  }
});
