import { readFileSync } from 'node:fs';
import { expect } from '@playwright/test';
import { STATE_SEEDS, createRandomStates } from './random-states.js';
import { ALL_FIGURE_NAMES, FIGURE_FACTS, TWO_FIGURE_NAMES } from './figures.js';
import { REDUCED_MOTION, setProperty, waitForFrames, mountFigure, readProperty, showPage, takeEvents, test, testEach, openDisclosures, waitUntilReady } from './support.js';

/** @typedef {import('./support.js').AnyElement} AnyElement */

test.use(REDUCED_MOTION);

test('attributes of every type set the opening state of a figure', async ({ page }) => {
  await showPage(
    page,
    `<banana-machine seed="11" samples="300" alpha4="0.125" model="odometry" noise="triangular" preset="hard" v="-0.5"
       isolate="3" overlays="linearized command"></banana-machine>
     <map-squeeze preset="wall" x="3.25" noise="0.2" conditioned="false" sampler="sub-stepped" steps="4"
       clearance="0.2" samples="77" seed="5" view="close"></map-squeeze>`,
  );
  const [bananaWidget, squeezeWidget] = TWO_FIGURE_NAMES.map((figureName) => page.locator(figureName));
  await waitUntilReady(bananaWidget);
  await squeezeWidget.scrollIntoViewIfNeeded();
  await waitUntilReady(squeezeWidget);
  const bananaConfig = await bananaWidget.evaluate((element) => Reflect.get(element, 'simulation').config);
  expect(bananaConfig).toMatchObject({
    model: 'odometry',
    noise: 'triangular',
    command: { v: -0.5, omega: 1.2, dt: 1.4 },
    isolate: 3,
    samples: 300,
    seed: 11,
  });
  expect(bananaConfig.alphas[3]).toBe(0.125);
  expect(await readProperty(bananaWidget, 'overlays')).toEqual(['command', 'linearized']);
  expect(await squeezeWidget.evaluate((element) => Reflect.get(element, 'simulation').config)).toMatchObject({
    start: { x: 3.25, y: 2.6, theta: Math.PI / 2 },
    alphas: [0.2, 0.2, 0.2, 0.2, 0.05, 0.05],
    conditioned: false,
    sampler: 'sub-stepped',
    steps: 4,
    clearance: 0.2,
    samples: 77,
    seed: 5,
  });
  expect(await readProperty(squeezeWidget, 'view')).toBe('close');
  expect((await takeEvents(page)).map(({ name, target }) => [name, target])).toEqual(TWO_FIGURE_NAMES.map((name) => ['load', name]));
});

test('attributes stay as written until their setting changes, and then reflect the setting', async ({ page }) => {
  await showPage(page, '<banana-machine preset="hard" seed="3"></banana-machine><map-squeeze></map-squeeze>');
  const [bananaMachine, mapSqueeze] = TWO_FIGURE_NAMES.map((figureName) => page.locator(figureName));
  await waitUntilReady(bananaMachine);
  await openDisclosures(bananaMachine);
  const readAttributes = (/** @type {import('@playwright/test').Locator} */ widget) =>
    widget.evaluate((element) => Object.fromEntries([...element.attributes].map(({ name: attributeName, value }) => [attributeName, value])));
  expect(await readAttributes(bananaMachine)).toEqual({ preset: 'hard', seed: '3' });
  // After a change the settings differ from the preset "hard". The values of the preset are then reflected as attributes.
  const alphaAttributes = { alpha1: '0.05', alpha2: '0.05', alpha3: '0.05', alpha4: '0.09', alpha5: '0.01', alpha6: '0.01' };
  await bananaMachine.locator('#v').fill('0.5');
  await waitForFrames(page);
  expect(await readAttributes(bananaMachine)).toEqual({ v: '0.5', omega: '1.2', dt: '1.4', seed: '3', ...alphaAttributes });
  await bananaMachine.getByRole('button', { name: 'Pivot' }).click();
  await waitForFrames(page);
  expect(await readAttributes(bananaMachine)).toEqual({ preset: 'pivot', v: '0.06', omega: '1.5', dt: '1', seed: '3', ...alphaAttributes });
  await bananaMachine.getByLabel('Isolate one').check();
  await bananaMachine.getByRole('checkbox', { name: 'linearized' }).check();
  await waitForFrames(page);
  expect(await readAttributes(bananaMachine)).toMatchObject({ isolate: '4', overlays: 'command ellipse exponential linearized' });
  await bananaMachine.getByLabel('Isolate one').uncheck();
  await waitForFrames(page);
  expect(await readAttributes(bananaMachine)).not.toHaveProperty('isolate');

  await mapSqueeze.scrollIntoViewIfNeeded();
  await waitUntilReady(mapSqueeze);
  await openDisclosures(mapSqueeze);
  await mapSqueeze.getByRole('button', { name: 'Facing a wall' }).click();
  await mapSqueeze.getByLabel('Check samples against the map').uncheck();
  await waitForFrames(page);
  expect(await readAttributes(mapSqueeze)).toEqual({ x: '3.3', conditioned: 'false' });
});

test('controls of a figure change its attributes, and removing an attribute restores the default', async ({ page, figureName }) => {
  const widget = await mountFigure(page, figureName);
  const { sliderId, sliderValues: [firstValue, secondValue] } = FIGURE_FACTS[figureName];
  const defaultValue = await readProperty(widget, sliderId);
  await widget.locator(`#${sliderId}`).fill(String(firstValue));
  await expect(widget).toHaveAttribute(sliderId, String(firstValue));
  expect(await readProperty(widget, sliderId)).toBe(firstValue);
  await widget.evaluate((element, [attributeName, attributeText]) => element.setAttribute(attributeName, attributeText), [sliderId, String(secondValue)]);
  expect(await readProperty(widget, sliderId)).toBe(secondValue);
  await expect(widget.locator(`#${sliderId}`)).toHaveValue(String(secondValue));
  await widget.evaluate((element, attributeName) => element.removeAttribute(attributeName), sliderId);
  expect(await readProperty(widget, sliderId)).toBe(defaultValue);
});

test('refused attributes are reported with the core’s error message, and the last valid value stays', async ({ page }) => {
  const widget = await mountFigure(page, 'banana-machine', { attributes: 'v="fast" omega="0.7" model="walking" samples="0" overlays="ellipse stars"' });
  const errorMessages = (await takeEvents(page, ['error'])).map(({ message: errorMessage }) => errorMessage);
  expect(errorMessages).toEqual([
    'model is "walking"; allowed is "velocity" or "odometry"',
    'command.v is "fast"; allowed is a number',
    'samples is 0; allowed is a whole number from 1 to 10000000',
    'overlays[1] is "stars"; allowed is "command" or "ellipse" or "exponential" or "linearized" or "additive"',
  ]);
  const readProperties = async () => Promise.all(['v', 'omega', 'model', 'samples'].map((propertyName) => readProperty(widget, propertyName)));
  expect(await readProperties()).toEqual([1, 0.7, 'velocity', 50000]);
  // A blank attribute is refused as a number, and does not count as zero.
  await widget.evaluate((element) => element.setAttribute('omega', ' '));
  expect((await takeEvents(page, ['error'])).map(({ message: errorMessage }) => errorMessage)).toEqual(['command.omega is " "; allowed is a number']);
  expect(await readProperty(widget, 'omega')).toBe(0.7);
  await widget.evaluate((element) => element.setAttribute('dt', '3'));
  expect(await readProperty(widget, 'dt')).toBe(3);
  await widget.getByRole('button', { name: 'Pivot' }).click();
  expect(await readProperties()).toEqual([0.06, 1.5, 'velocity', 50000]);
});

test('elements have the attributes that the table of doc/embedding/figures.md shows', async ({ page, figureName }) => {
  const figuresDocument = readFileSync(new URL('../../doc/embedding/figures.md', import.meta.url), 'utf8');
  const tableExamples = [...figuresDocument.matchAll(/^\| [^|]* \| `<([a-z-]+)( [^`]*)>` \|$/gm)].map(([, figureName, attributes]) => ({ name: figureName, attributes }));
  expect(new Set(tableExamples.map(({ name: figureName }) => figureName)).size).toBe(ALL_FIGURE_NAMES.length);
  await showPage(page, tableExamples.map(({ name: figureName, attributes }) => `<${figureName} class="example" ${attributes}></${figureName}>`).join(''));
  const unknownAttributes = await page.locator('.example').evaluateAll((exampleElements) => exampleElements.flatMap(({ attributes, constructor }) =>
    [...attributes].map(({ name: attributeName }) => attributeName).filter((attributeName) => attributeName !== 'class' && !Reflect.get(constructor, 'observedAttributes').includes(attributeName))));
  expect(unknownAttributes).toEqual([]);
  for (const widget of await page.locator(`${figureName}.example`).all()) {
    await widget.scrollIntoViewIfNeeded();
    await waitUntilReady(widget);
  }
  expect(await takeEvents(page, ['error'])).toEqual([]);
});

/** Fields of states that no single attribute can set. No attribute holds a map. No single attribute sets a list of six α's. */
const VALUES_WITHOUT_ATTRIBUTES = { 'map-squeeze': { map: null, alphas: [0.2, 0.2, 0.2, 0.2, 0.05, 0.05] } };

testEach('the code to embed a figure reproduces the settings of its state, with the attributes in any order', async (page, figureName, isNightly) => {
  await showPage(page, `<${figureName}></${figureName}>`);
  const widget = page.locator(figureName).first();
  await waitUntilReady(widget);
  for (const seed of isNightly ? STATE_SEEDS : STATE_SEEDS.slice(0, 2)) {
    const randomState = { ...createRandomStates(seed)[figureName], ...Reflect.get(VALUES_WITHOUT_ATTRIBUTES, figureName) };
    const [originalConfig, ...copiedConfigs] = await widget.evaluate(async (element, newState) => {
      /** @type {any} */ (element).setState(newState);
      const codeContainer = document.createElement('div');
      codeContainer.innerHTML = /** @type {AnyElement} */ (element).embedCode().split('\n')[1];
      const embeddedCopy = /** @type {HTMLElement} */ (codeContainer.firstElementChild);
      const reorderedCopy = document.createElement(element.localName);
      for (const { name: attributeName, value } of [...embeddedCopy.attributes].reverse()) reorderedCopy.setAttribute(attributeName, value);
      const loadPromises = [embeddedCopy, reorderedCopy].map((figureCopy) => new Promise((resolve) => figureCopy.addEventListener('load', resolve)));
      // The copies are placed in the window, because a figure starts only when it is near the window.
      for (const figureCopy of [embeddedCopy, reorderedCopy]) figureCopy.style.cssText = 'position: fixed; inset: 0';
      element.before(embeddedCopy, reorderedCopy);
      await Promise.all(loadPromises);
      // After a change of its state, a calibrator fits its log in one of the next animation frames.
      while (/** @type {any} */ (element).isBusy) await new Promise(requestAnimationFrame);
      const figureConfigs = [element, embeddedCopy, reorderedCopy].map((figureElement) => /** @type {AnyElement} */ (figureElement).simulation.config);
      for (const figureCopy of [embeddedCopy, reorderedCopy]) figureCopy.remove();
      return figureConfigs;
    }, /** @type {any} */ (randomState));
    for (const copiedConfig of copiedConfigs) expect(copiedConfig, `seed ${seed}`).toEqual(originalConfig);
  }
  expect(await takeEvents(page, ['error'])).toEqual([]);
});

test('a list property accepts a list written as text, and other text is reported', async ({ page }) => {
  await showPage(page, '');
  const errorMessage = await page.evaluate(async () => {
    const figureContainer = document.createElement('div');
    document.body.prepend(figureContainer);
    /** @type {Promise<string>} */
    const messagePromise = new Promise((resolve) => figureContainer.addEventListener('error', ({ message: errorMessage }) => resolve(errorMessage), true));
    figureContainer.innerHTML = '<banana-machine alphas="0.1,0.2,0.1,0.1,0,0" command="[object Object]"></banana-machine><arc-anatomy alphas="[0.1, 0.2, 0.1, 0.1, 0, 0]"></arc-anatomy>';
    return messagePromise;
  });
  expect(errorMessage).toMatch(/^command is "\[object Object\]"; allowed is an object/);
  for (const figureName of ['banana-machine', 'arc-anatomy']) await expect(page.locator(figureName)).toHaveJSProperty('alphas', [0.1, 0.2, 0.1, 0.1, 0, 0]);
});

test('properties that were set before the element was defined are applied, in any order', async ({ page }) => {
  await showPage(page, '', { scriptHtml: '' });
  const propertyValues = await page.evaluate(async () => {
    const floorPlan = { bounds: [0, 0, 6, 4], walls: [[3, 0, 3, 1.5]] };
    const propertyCases = /** @type {[string, Record<string, unknown>, string[]][]} */ ([
      ['banana-machine', { v: 3, alphas: [0.1, 0.1, 0.1, 0.1, 0, 0], overlays: ['ellipse'], theme: 'dark' }, ['v', 'alphas', 'overlays', 'theme']],
      ['banana-machine', { omega: 0.7, preset: 'hard', alpha2: 0.3, alphas: [0.1, 0.1, 0.1, 0.1], model: 'odometry' }, ['omega', 'v', 'dt', 'alphas']],
      ['banana-machine', { marked: 60_000, samples: 70_000 }, ['marked', 'samples']],
      ['dead-reckoning', { step: 30, steps: 40 }, ['step', 'steps']],
      ['map-squeeze', { marked: 3, start: { x: 3, y: 1, theta: 0 }, map: floorPlan }, ['marked', 'start']],
    ]);
    const figureElements = propertyCases.flatMap(([widgetTag, propertyValues]) => [Object.entries(propertyValues), Object.entries(propertyValues).reverse()].map((propertyEntries) =>
      Object.assign(document.createElement(widgetTag), Object.fromEntries(propertyEntries))));
    const loadPromises = figureElements.map((figureElement) => new Promise((resolve) => figureElement.addEventListener('load', resolve)));
    await import(/** @type {any} */ ('/motion-widgets.js'));
    for (const figureElement of figureElements) figureElement.style.cssText = 'position: fixed; inset: 0';
    document.body.append(...figureElements);
    await Promise.all(loadPromises);
    const namesByFigure = propertyCases.flatMap(([, , checkedNames]) => [checkedNames, checkedNames]);
    return figureElements.map((figureElement, i) => namesByFigure[i].map((propertyName) => Reflect.get(figureElement, propertyName)));
  });
  const makePair = (/** @type {unknown[]} */ repeatedValues) => [repeatedValues, repeatedValues];
  expect(propertyValues).toEqual([
    ...makePair([3, [0.1, 0.1, 0.1, 0.1, 0, 0], ['ellipse'], 'dark']),
    ...makePair([0.7, 1, 1.4, [0.1, 0.3, 0.1, 0.1]]),
    ...makePair([60_000, 70_000]),
    ...makePair([30, 40]),
    ...makePair([3, { x: 3, y: 1, theta: 0 }]),
  ]);
  expect(await takeEvents(page, ['error'])).toEqual([]);
});

test('properties that are assigned their own value change nothing @nightly', async ({ page, figureName }) => {
  const widget = await mountFigure(page, figureName);
  await widget.evaluate((element, newState) => /** @type {any} */ (element).setState(newState), /** @type {any} */ (createRandomStates(2)[figureName]));
  await takeEvents(page, ['stats']);
  const assignedCount = await widget.evaluate((element, propertyKeys) => {
    const figureElement = /** @type {any} */ (element);
    const propertyNames = propertyKeys.filter((propertyKey) => propertyKey in figureElement && propertyKey !== 'playing');
    for (const propertyName of propertyNames) figureElement[propertyName] = structuredClone(figureElement[propertyName]);
    for (const { name: attributeName, value } of [...element.attributes]) element.setAttribute(attributeName, value);
    return propertyNames.length;
  }, Object.keys(createRandomStates(2)[figureName]));
  expect(assignedCount).toBeGreaterThan(6);
  expect(await takeEvents(page, ['stats', 'error', 'input', 'change'])).toEqual([]);
});

test('properties take effect at once and are reflected as attributes; properties that the model lacks are null', async ({ page }) => {
  const widget = await mountFigure(page, 'banana-machine');
  expect(await setProperty(widget, 'omega', 1.1)).toBe('');
  expect(await widget.getAttribute('omega')).toBe('1.1');
  const meanTurn = await widget.evaluate((element) => /** @type {AnyElement} */ (element).stats?.exponential.mean[2]);
  const { dt } = await widget.evaluate((element) => /** @type {AnyElement} */ (element).getState().command);
  expect(meanTurn).toBeCloseTo(1.1 * dt, 1);
  expect(await setProperty(widget, 'model', 'odometry')).toBe('');
  expect(await readProperty(widget, 'alpha5')).toBe(null);
  expect(await setProperty(widget, 'alpha5', 0.1)).toContain('alphas has length 5; allowed is an array of 4 numbers');
});

test('refused properties fire an error event that does not bubble; without a listener the console has a warning', async ({ page }) => {
  const widget = await mountFigure(page, 'banana-machine');
  const firedMessages = await widget.evaluate((element) => {
    const firedMessages = /** @type {string[]} */ ([]);
    for (const target of [window, document, document.body]) target.addEventListener('error', () => firedMessages.push('above'));
    element.addEventListener('error', (errorEvent) => firedMessages.push(/** @type {ErrorEvent} */ (errorEvent).message));
    Object.assign(element, { omega: NaN });
    return firedMessages;
  });
  expect(firedMessages).toEqual(['command.omega is NaN; allowed is a number from -1000000 to 1000000']);
  // A page without listeners for errors gets a warning in the console.
  const otherPage = await page.context().newPage();
  await otherPage.goto('/embed.html?widget=banana-machine');
  const warningPromise = otherPage.waitForEvent('console', (consoleMessage) => consoleMessage.type() === 'warning');
  await otherPage.locator('banana-machine').evaluate((element) => Object.assign(element, { theme: 'sepia' }));
  const consoleWarning = await warningPromise;
  expect(consoleWarning.text()).toContain('theme is "sepia"; allowed is "auto" or "light" or "dark"');
  expect(await consoleWarning.args()[1].evaluate((element) => element.localName)).toBe('banana-machine');
  await otherPage.close();
});
