import { chromium, expect } from '@playwright/test';
import { CHROME_ARGUMENTS, FULL_CHROME_PROGRAM_NAMES, findChrome } from '../../scripts/browser.mjs';
import { ALL_FIGURE_NAMES, CLOUD_FIGURE_NAMES, FIGURE_FACTS, TWO_FIGURE_NAMES } from './figures.js';
import { NEW_PAGE_TAG, REDUCED_MOTION, setProperty, readBox, readCentre, waitForFrames, mountFigure, readPicture, readProperty, showPage, readState, takeEvents, test, openDisclosures, waitUntilReady } from './support.js';

/** @typedef {import('./support.js').AnyElement} AnyElement */
/** @typedef {import('@playwright/test').Page} Page */

test.use(REDUCED_MOTION);

/** Counts requested animation frames and compiled modules from the start of a page. @param {Page} page */
async function countFramesAndModules(page) {
  await page.addInitScript(() => {
    const frameAndModuleCounts = { frames: 0, compiled: 0, instances: 0 };
    Object.assign(window, { counts: frameAndModuleCounts, requestUncountedFrame: requestAnimationFrame.bind(window) });
    const { requestAnimationFrame: requestFrame } = window;
    window.requestAnimationFrame = (frameCallback) => {
      frameAndModuleCounts.frames++;
      return requestFrame.call(window, frameCallback);
    };
    const { compile, compileStreaming, instantiate } = WebAssembly;
    WebAssembly.compile = (...compileArguments) => (frameAndModuleCounts.compiled++, compile.apply(WebAssembly, compileArguments));
    WebAssembly.compileStreaming = (...compileArguments) => (frameAndModuleCounts.compiled++, compileStreaming.apply(WebAssembly, compileArguments));
    WebAssembly.instantiate = /** @type {any} */ (
      (/** @type {[any, any]} */ ...instantiateArguments) => (frameAndModuleCounts.instances++, instantiate.apply(WebAssembly, instantiateArguments))
    );
  });
}

/**
 * Returns the numbers of animation frames and compiled modules since `countFramesAndModules`.
 * @param {Page} page @returns {Promise<{ frames: number, compiled: number, instances: number }>}
 */
const readPageCounts = (page) => page.evaluate(() => Reflect.get(window, 'counts'));

/** Waits for six animation frames, which `countFramesAndModules` does not count. Figures may request frames meanwhile. @param {Page} page */
const waitForSixFrames = (page) =>
  page.evaluate(async () => {
    for (let i = 0; i < 6; i++) await new Promise(Reflect.get(window, 'requestUncountedFrame'));
  });

test('figures far from the window fetch and compute nothing, and all figures share one module', NEW_PAGE_TAG, async ({ page }) => {
  /** @type {string[]} */
  const fetchedPaths = [];
  page.on('request', (pageRequest) => fetchedPaths.push(new URL(pageRequest.url()).pathname));
  await countFramesAndModules(page);
  await showPage(page, `<div style="height: 5000px"></div>${TWO_FIGURE_NAMES.map((figureName) => `<${figureName}></${figureName}>`).join('')}`, {
    scriptHtml: '<script type="module" src="/external.js"></script>',
  });
  // The test avoids polling, because polling requests animation frames.
  await page.evaluate((widgetTags) => Promise.all(widgetTags.map((widgetTag) => customElements.whenDefined(widgetTag))).then(() => true), [...TWO_FIGURE_NAMES]);
  await waitForSixFrames(page);
  expect(await readPageCounts(page)).toEqual({ frames: 0, compiled: 0, instances: 0 });
  expect(fetchedPaths.filter((fetchedPath) => fetchedPath.endsWith('.wasm'))).toEqual([]);
  for (const figureName of TWO_FIGURE_NAMES) {
    await page.locator(figureName).scrollIntoViewIfNeeded();
    await waitUntilReady(page.locator(figureName));
  }
  expect(await readPageCounts(page)).toMatchObject({ compiled: 1, instances: TWO_FIGURE_NAMES.length });
  expect(fetchedPaths.filter((requestPath) => requestPath.endsWith('.wasm'))).toEqual(['/motion.wasm']);
});

test('a page with one figure fetches the module of that figure @nightly', async ({ page }) => {
  for (const figureName of ALL_FIGURE_NAMES) {
    const moduleRequest = page.waitForRequest(/\.wasm$/);
    await showPage(page, `<${figureName}></${figureName}>`, { scriptHtml: '<script type="module" src="/external.js"></script>' });
    await waitUntilReady(page.locator(figureName));
    expect(new URL((await moduleRequest).url()).pathname).toMatch(new RegExp(`^/chunks/${figureName}-\\w+\\.wasm$`));
  }
});

test('a script that contains the module compiles the module at once, so that no placeholder is rendered', async ({ page }) => {
  await countFramesAndModules(page);
  // The two imports are evaluated in one task, so that the second script sees what the first has compiled.
  const countRecorderUrl = 'data:text/javascript,window.compiledDuringScript = counts.compiled';
  await showPage(page, '<banana-machine></banana-machine>', { scriptHtml: `<script type="module">import '/motion-widgets.js'; import '${countRecorderUrl}'</script>` });
  await waitUntilReady(page.locator('banana-machine'));
  expect(await page.evaluate(() => Reflect.get(window, 'compiledDuringScript'))).toBe(1);
  const [hasSimulation, hasPlaceholder] = await page.evaluate(async () => {
    const bananaMachine = /** @type {any} */ (document.createElement('banana-machine'));
    document.body.prepend(bananaMachine);
    await bananaMachine.updateComplete;
    return ['.simulation', '.reserved'].map((partSelector) => bananaMachine.shadowRoot.querySelector(partSelector) !== null);
  });
  expect([hasSimulation, hasPlaceholder]).toEqual([true, false]);
});

test('figures within six hundred pixels of the window start, and others do not', async ({ page }) => {
  const figureSections = [560, 620].map((distanceBelow) => `<div style="position: absolute; top: calc(100vh + ${distanceBelow}px); width: 600px"><map-squeeze></map-squeeze></div>`);
  await showPage(page, figureSections.join(''));
  const squeezeFigures = page.locator('map-squeeze');
  await waitUntilReady(squeezeFigures.nth(0));
  expect(await readProperty(squeezeFigures.nth(1), 'simulation')).toBe(undefined);
});

test('a cloud that is out of sight requests no frames, and resumes its growth when it is seen again @nightly', async ({ page, cloudFigureName }) => {
  await page.emulateMedia({ reducedMotion: 'no-preference' });
  await countFramesAndModules(page);
  await showPage(page, `<${cloudFigureName}></${cloudFigureName}><div style="height: 6000px"></div>`);
  const widget = page.locator(cloudFigureName);
  await waitUntilReady(widget);
  const readShownCount = () => widget.evaluate((element) => /** @type {AnyElement} */ (element).simulation.shown);
  const sampleCount = Number(await readProperty(widget, 'samples'));
  await widget.evaluate(async (element) => {
    const statsEvent = new Promise((resolve) => element.addEventListener('stats', resolve, { once: true }));
    /** @type {AnyElement} */ (element).setState({ widget: element.localName, version: 1, shown: 0, playing: true });
    await statsEvent;
    scrollTo(0, 6000);
    // The test's intersection observer fires in the same animation frame as that of the figure.
    await new Promise((resolve) => new IntersectionObserver(([{ isIntersecting }]) => isIntersecting || resolve(undefined)).observe(element));
  });
  expect(await readProperty(widget, 'playing')).toBe(true);
  await waitForSixFrames(page);
  const countsBefore = [(await readPageCounts(page)).frames, await readShownCount()];
  expect(countsBefore[1]).toBeLessThan(sampleCount);
  await waitForSixFrames(page);
  expect([(await readPageCounts(page)).frames, await readShownCount()]).toEqual(countsBefore);
  await page.evaluate(() => scrollTo(0, 0));
  await expect.poll(readShownCount, { timeout: 20_000 }).toBe(sampleCount);
});

test('the promise `settled` waits for the figure and all its samples, in sight and far from the window', async ({ page, cloudFigureName }) => {
  await page.emulateMedia({ reducedMotion: 'no-preference' });
  for (const heightAbove of [0, 6000]) {
    await showPage(page, `<div style="height: ${heightAbove}px"></div><${cloudFigureName}></${cloudFigureName}>`);
    const [shownCount, sampleCount, isPlaying] = await page.locator(cloudFigureName).evaluate(async (element) => {
      const figureElement = /** @type {any} */ (element);
      await figureElement.settled;
      return [figureElement.simulation.shown, figureElement.samples, figureElement.playing];
    });
    expect([shownCount, isPlaying]).toEqual([sampleCount, false]);
  }
});

test('the promise `settled` resolves for a figure that was resized out of sight', async ({ page, figureName }) => {
  const widget = await mountFigure(page, figureName);
  await widget.evaluate((element) => element.insertAdjacentHTML('beforebegin', '<div style="height: 6000px"></div>'));
  await expect.poll(() => widget.evaluate((element) => /** @type {any} */ (element).renderer.isVisible)).toBe(false);
  const readCanvasWidth = () => widget.locator('canvas').first().evaluate((canvas) => /** @type {HTMLCanvasElement} */ (canvas).width);
  const widthBefore = await readCanvasWidth();
  await page.setViewportSize({ width: 500, height: 720 });
  await expect.poll(readCanvasWidth).not.toBe(widthBefore);
  await widget.evaluate((element) => /** @type {any} */ (element).settled);
});

test('the promise `settled` waits for texts that a slow device renders later than the picture', async ({ page }) => {
  const widget = await mountFigure(page, 'banana-machine');
  const cdpSession = await page.context().newCDPSession(page);
  await cdpSession.send('Emulation.setCPUThrottlingRate', { rate: 6 });
  const sliderSpeeds = await widget.evaluate(async (element) => {
    const figureElement = /** @type {any} */ (element);
    const sliderSpeeds = [];
    for (const v of [0.5, 1.5, 0.6]) {
      figureElement.v = v;
      await figureElement.settled;
      sliderSpeeds.push(figureElement.shadowRoot.getElementById('v').valueAsNumber);
    }
    return sliderSpeeds;
  });
  expect(sliderSpeeds).toEqual([0.5, 1.5, 0.6]);
});

test('a partly grown cloud keeps its size if its figure is moved, or removed and inserted again', async ({ page, cloudFigureName }) => {
  await showPage(page, `<div id="a"><${cloudFigureName}></${cloudFigureName}></div><div id="b"></div>`);
  const widget = page.locator(cloudFigureName);
  await waitUntilReady(widget);
  // With seed 11 every robot is inside the view, so that the view does not zoom out.
  await setProperty(widget, 'seed', 11);
  await openDisclosures(widget);
  const pressButton = (/** @type {string} */ buttonName) => widget.locator('.cloud').getByRole('button', { name: buttonName, exact: true }).click();
  await pressButton('Clear');
  for (let i = 0; i < 5; i++) await pressButton('Step');
  const stateBefore = await readState(widget);
  expect(/** @type {any} */ (stateBefore).shown).toBeGreaterThan(0);
  expect(/** @type {any} */ (stateBefore).shown).toBeLessThan(/** @type {any} */ (stateBefore).samples);
  const pictureBefore = await readPicture(widget.locator('canvas.plane'));
  const isSameSimulation = await widget.evaluate((element) => {
    const { simulation } = /** @type {AnyElement} */ (element);
    document.querySelector('#b')?.append(element);
    return simulation === /** @type {AnyElement} */ (element).simulation;
  });
  expect(isSameSimulation).toBe(true);
  await waitForFrames(page);
  expect(await readState(widget)).toEqual(stateBefore);
  await widget.evaluate(async (element) => {
    element.remove();
    await new Promise(requestAnimationFrame);
    document.querySelector('#a')?.append(element);
  });
  await waitUntilReady(widget);
  expect(await readState(widget)).toEqual(stateBefore);
  await expect.poll(() => readPicture(widget.locator('canvas.plane'))).toBe(pictureBefore);
});

test('open disclosures, typed text and height are kept if a figure is moved, or removed and inserted again', async ({ page, figureName }) => {
  await showPage(page, `<div id="a"><${figureName}></${figureName}></div><div id="b"></div>`);
  const widget = page.locator(figureName);
  await waitUntilReady(widget);
  const { fieldInFold } = FIGURE_FACTS[figureName];
  const foldDisclosures = widget.locator('details');
  await expect.poll(() => foldDisclosures.count()).toBeGreaterThan(1);
  await openDisclosures(widget);
  const readOpenFolds = () => foldDisclosures.evaluateAll((foldElements) => foldElements.map((foldElement) => /** @type {HTMLDetailsElement} */ (foldElement).open));
  const openFoldsBefore = await readOpenFolds();
  const fieldInDisclosure = foldDisclosures.nth(fieldInFold.disclosureIndex).locator(fieldInFold.fieldSelector);
  await fieldInDisclosure.fill(fieldInFold.typedText);
  await widget.evaluate((element) => document.querySelector('#b')?.append(element));
  await waitForFrames(page);
  expect(await readOpenFolds()).toEqual(openFoldsBefore);
  const heightBefore = (await readBox(widget)).height;
  const heightsAfter = await widget.evaluate(async (element) => {
    element.remove();
    await new Promise(requestAnimationFrame);
    document.querySelector('#a')?.append(element);
    const heightsAfter = [element.getBoundingClientRect().height];
    await new Promise(requestAnimationFrame);
    return [...heightsAfter, element.getBoundingClientRect().height];
  });
  await waitUntilReady(widget);
  expect(await readOpenFolds()).toEqual(openFoldsBefore);
  await expect(fieldInDisclosure).toHaveValue(fieldInFold.typedText);
  await expect(foldDisclosures.nth(fieldInFold.disclosureIndex).locator('.folded')).not.toBeEmpty();
  // In the first two animation frames after the figure is moved within the page, its height stays the same.
  expect(heightsAfter).toEqual([heightBefore, heightBefore]);
});

test('a figure keeps a change that the user made immediately before its removal', async ({ page, figureName }) => {
  const { sliderId, statePath, sliderValues: [sliderValue] } = FIGURE_FACTS[figureName];
  const widget = await mountFigure(page, figureName);
  const stateAfter = await widget.evaluate(async (element, [sliderId, sliderValue]) => {
    const rangeInput = /** @type {HTMLInputElement} */ (element.shadowRoot?.querySelector(`#${sliderId}`));
    rangeInput.value = String(sliderValue);
    rangeInput.dispatchEvent(new Event('input', { bubbles: true, composed: true }));
    element.remove();
    await new Promise(requestAnimationFrame);
    return /** @type {AnyElement} */ (element).getState();
  }, /** @type {const} */ ([sliderId, sliderValue]));
  expect(stateAfter).toHaveProperty(statePath, sliderValue);
});

test('moving a figure in the document ends the drag of its handle, and fits its picture @nightly', async ({ page, handleFigureName }) => {
  await showPage(page, `<div id="a" style="width: 1100px"><${handleFigureName}></${handleFigureName}></div><div id="b" style="width: 500px"></div>`);
  const widget = page.locator(handleFigureName);
  await waitUntilReady(widget);
  const firstHandle = widget.locator('.handle').first();
  const stateBefore = await readState(widget);
  const { x, y } = await readCentre(firstHandle);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 30, y + 20, { steps: 3 });
  await waitForFrames(page);
  await expect(firstHandle).toHaveClass(/held/);
  const stateAfterDrag = await readState(widget);
  expect(stateAfterDrag).not.toEqual(stateBefore);
  await takeEvents(page);
  await widget.evaluate((element) => document.querySelector('#b')?.append(element));
  await waitForFrames(page);
  await expect(firstHandle).not.toHaveClass(/held/);
  expect((await takeEvents(page)).map(({ name }) => name)).toEqual(['change']);
  await page.mouse.move(700, 300);
  await waitForFrames(page);
  expect(await readState(widget)).toEqual(stateAfterDrag);
  await page.mouse.up();
});

test('a canvas is drawn again after its lost context is restored', async ({ page, figureName }) => {
  const widget = await mountFigure(page, figureName);
  const planeCanvas = widget.locator('canvas.plane');
  const pictureBefore = await readPicture(planeCanvas);
  const blankPicture = await planeCanvas.evaluate((element) => {
    const canvasElement = /** @type {HTMLCanvasElement} */ (element);
    // As after a lost context, the canvas is blank, and `contextrestored` is fired.
    canvasElement.getContext('2d')?.reset();
    const blankPicture = canvasElement.toDataURL();
    canvasElement.dispatchEvent(new Event('contextrestored'));
    return blankPicture;
  });
  expect(blankPicture).not.toBe(pictureBefore);
  expect(await readPicture(planeCanvas)).toBe(pictureBefore);
});

test('a figure that is inserted again is drawn for the screen, even if it was removed during printing', async ({ page, figureName }) => {
  const widget = await mountFigure(page, figureName);
  await page.emulateMedia({ media: 'print' });
  const canvas = widget.locator('canvas.plane');
  await expect(canvas).toHaveJSProperty('width', 2 * (await canvas.evaluate(({ clientWidth }) => clientWidth)));
  const removedFigure = await widget.evaluateHandle((element) => (element.remove(), element));
  await page.emulateMedia({ media: 'screen' });
  await removedFigure.evaluate((element) => document.body.append(element));
  await waitUntilReady(widget);
  await expect.poll(() => canvas.evaluate((element) => /** @type {HTMLCanvasElement} */ (element).width / element.clientWidth)).toBeCloseTo(1, 1);
});

test('a figure that was removed and inserted again has as many observers as before, and does not redraw its walls when it becomes visible', NEW_PAGE_TAG, async ({ page }) => {
  await page.addInitScript(() => {
    const frameAndModuleCounts = { observers: 0, paths: 0 };
    Object.assign(window, { counts: frameAndModuleCounts });
    const { observe, disconnect } = IntersectionObserver.prototype;
    const intersectionObservers = new Set();
    IntersectionObserver.prototype.observe = function (observedElement) {
      frameAndModuleCounts.observers = intersectionObservers.add(this).size;
      observe.call(this, observedElement);
    };
    IntersectionObserver.prototype.disconnect = function () {
      intersectionObservers.delete(this);
      frameAndModuleCounts.observers = intersectionObservers.size;
      disconnect.call(this);
    };
    const { beginPath } = OffscreenCanvasRenderingContext2D.prototype;
    OffscreenCanvasRenderingContext2D.prototype.beginPath = function () {
      frameAndModuleCounts.paths++;
      beginPath.call(this);
    };
  });
  await showPage(page, '<map-squeeze></map-squeeze><div style="height: 4000px"></div>');
  const widget = page.locator('map-squeeze');
  await waitUntilReady(widget);
  const readCounts = () => page.evaluate(() => ({ ...Reflect.get(window, 'counts') }));
  const countsBefore = await readCounts();
  expect(Math.min(countsBefore.observers, countsBefore.paths)).toBeGreaterThan(0);
  for (const y of [3500, 0]) {
    await page.evaluate((scrollTop) => scrollTo(0, scrollTop), y);
    await waitForFrames(page);
  }
  expect(await readCounts()).toEqual(countsBefore);
  await widget.evaluate(async (element) => {
    const { body } = document;
    element.remove();
    await new Promise(requestAnimationFrame);
    body.prepend(element);
  });
  await waitUntilReady(widget);
  expect((await readCounts()).observers).toBe(countsBefore.observers);
});

test('a figure shows changes that were made while `display: none` hid it @nightly', async ({ page, figureName }) => {
  await showPage(page, `<div id="box"><${figureName}></${figureName}></div>`);
  const widget = page.locator(figureName);
  await waitUntilReady(widget);
  const canvas = widget.locator('canvas.plane');
  const pictureBefore = await readPicture(canvas);
  const setCssDisplay = (/** @type {string} */ displayValue) => page.locator('#box').evaluate((boxElement, displayStyle) => void (/** @type {HTMLElement} */ (boxElement).style.display = displayStyle), displayValue);
  await setCssDisplay('none');
  await waitForFrames(page);
  await setProperty(widget, ...FIGURE_FACTS[figureName].otherSetting);
  await waitForFrames(page);
  await setCssDisplay('block');
  await expect.poll(() => readPicture(canvas)).not.toBe(pictureBefore);
  await expect(widget).toHaveAttribute(FIGURE_FACTS[figureName].otherSetting[0].replace(/[A-Z]/g, (capitalLetter) => `-${capitalLetter.toLowerCase()}`), String(FIGURE_FACTS[figureName].otherSetting[1]));
});

test('a page that is restored from the back-forward cache works @nightly', async ({ baseURL }) => {
  const browser = await chromium.launch({
    executablePath: findChrome(FULL_CHROME_PROGRAM_NAMES), args: CHROME_ARGUMENTS, ignoreDefaultArgs: ['--disable-back-forward-cache'],
  });
  const page = await browser.newPage({ baseURL, reducedMotion: 'reduce' });
  await showPage(page, ALL_FIGURE_NAMES.map((name) => `<${name} share></${name}>`).join(''));
  for (const name of ALL_FIGURE_NAMES) {
    await page.locator(name).scrollIntoViewIfNeeded();
    await waitUntilReady(page.locator(name));
  }
  const bananaFigure = page.locator('banana-machine');
  await bananaFigure.scrollIntoViewIfNeeded();
  await setProperty(bananaFigure, 'omega', 1.25);
  const takePictureAndStates = async () => [await readPicture(bananaFigure.locator('canvas.plane')), ...(await Promise.all(ALL_FIGURE_NAMES.map((name) => readState(page.locator(name)))))];
  const pictureAndStatesBefore = await takePictureAndStates();
  await page.evaluate(() => addEventListener('pageshow', ({ persisted }) => void Object.assign(window, { persisted })));
  await page.goto('/embed.html?widget=map-squeeze');
  await page.goBack({ waitUntil: 'commit' });
  await expect.poll(() => page.evaluate(() => Reflect.get(window, 'persisted'))).toBe(true);
  await waitForFrames(page);
  expect(await takePictureAndStates()).toEqual(pictureAndStatesBefore);
  await bananaFigure.locator('#v').fill('0.4');
  await expect.poll(async () => (await takePictureAndStates())[0]).not.toBe(pictureAndStatesBefore[0]);
  await browser.close();
});

test('removed figures free their memory, observers and DOM nodes @nightly', NEW_PAGE_TAG, async ({ page }) => {
  test.setTimeout(200_000);
  await showPage(page, '<banana-machine></banana-machine>');
  await waitUntilReady(page.locator('banana-machine'));
  await page.evaluate(() => document.body.replaceChildren());
  const cdpSession = await page.context().newCDPSession(page);
  await cdpSession.send('HeapProfiler.enable');
  /** Mounts one figure of each kind after the other, and removes each figure after it is drawn. @param {number} roundCount */
  const mountAndRemove = async (roundCount) => {
    for (let roundIndex = 0; roundIndex < roundCount; roundIndex++) {
      for (const name of ALL_FIGURE_NAMES) {
        await page.evaluate(async ([widgetTag, sampleCount]) => {
          const figureElement = /** @type {any} */ (Object.assign(document.createElement(widgetTag), sampleCount));
          document.body.append(figureElement);
          await figureElement.settled;
          figureElement.remove();
        }, /** @type {const} */ ([name, CLOUD_FIGURE_NAMES.includes(name) ? { samples: 200 } : {}]));
      }
    }
  };
  /** Counts the living objects of some classes after a garbage collection. */
  const countPageObjects = async () => {
    await cdpSession.send('HeapProfiler.collectGarbage');
    /** @type {Record<string, number>} */
    const objectCounts = {};
    for (const name of ['WebAssembly.Memory', 'ResizeObserver', 'ShadowRoot', 'MutationObserver', 'IntersectionObserver']) {
      const { result } = await cdpSession.send('Runtime.evaluate', { expression: `${name}.prototype` });
      const { objects } = await cdpSession.send('Runtime.queryObjects', { prototypeObjectId: String(result.objectId) });
      const { result: lengthResult } = await cdpSession.send('Runtime.callFunctionOn', {
        objectId: objects.objectId, functionDeclaration: 'function () { return this.length }', returnByValue: true,
      });
      await cdpSession.send('Runtime.releaseObject', { objectId: String(objects.objectId) });
      objectCounts[name] = lengthResult.value;
    }
    objectCounts.nodes = (await cdpSession.send('Memory.getDOMCounters')).nodes;
    return objectCounts;
  };
  await mountAndRemove(2);
  // The JavaScript engine may keep the latest object of a class for a while.
  await expect.poll(async () => (await countPageObjects()).ShadowRoot, { timeout: 30_000 }).toBeLessThanOrEqual(1);
  const objectCountBefore = await countPageObjects();
  await mountAndRemove(20);
  await expect.poll(async () => (await countPageObjects()).ShadowRoot, { timeout: 30_000 }).toBeLessThanOrEqual(1);
  const objectCountAfter = await countPageObjects();
  for (const [className, objectCount] of Object.entries(objectCountAfter)) expect.soft(objectCount - objectCountBefore[className], className).toBeLessThanOrEqual(2);
});
