// Three durations of each step of a drag, at the initial sample counts and with a processor four times slower. The first duration is that
// of the animation frame that paints the picture: JavaScript, WebAssembly, style, layout and paint. The second is the time until the text
// is updated. The third is the time between frames.

/** Factor by which Chromium slows the processor. */
export const CPU_SLOWDOWN = 4;

/** Selector of sliders and handles. Handles of walls and sliders of animations change no setting of the simulation, and are left out. */
const DRAGGABLE_SELECTOR = '.slider input[type=range]:not(.playable *), .handle:not(.jamb, .side)';

/**
 * @typedef {object} Drag times in ms, step by step
 * @property {string} widgetTag
 * @property {string} controlName of the slider or handle that is dragged
 * @property {number[]} pictureTimes from the start of the frame after a step until the browser has finished a frame with the new picture
 * @property {number[]} textTimes from the end of that frame until the browser has finished a frame with the new text
 * @property {number[]} frameTimes from one frame to the next, if every frame has a step
 *
 * @param {import('@playwright/test').Browser} browser
 * @param {string} pageUrl of page.html
 * @param {number} stepCount of each drag
 * @returns {Promise<Drag[]>}
 */
export async function measureDrags(browser, pageUrl, stepCount) {
  const browserContext = await browser.newContext({ viewport: { width: 1280, height: 900 }, reducedMotion: 'reduce' });
  const page = await browserContext.newPage();
  await page.goto(pageUrl);
  await page.evaluate(() => document.body.append(document.createElement('map-squeeze')));
  const cdpSession = await browserContext.newCDPSession(page);
  /** @type {Drag[]} */
  const dragTimings = [];
  for (const widgetTag of ['banana-machine', 'map-squeeze']) {
    await page.locator(widgetTag).scrollIntoViewIfNeeded();
    await page.waitForFunction((widgetTag) => document.querySelector(widgetTag)?.shadowRoot?.querySelector('.slider'), widgetTag);
    await page.locator(widgetTag).evaluate((widgetElement) => widgetElement.scrollIntoView({ block: 'start' }));
    const draggedCount = await page.locator(widgetTag).locator(DRAGGABLE_SELECTOR).count();
    await cdpSession.send('Emulation.setCPUThrottlingRate', { rate: CPU_SLOWDOWN });
    for (let i = 0; i < draggedCount; i++) {
      dragTimings.push({ widgetTag, ...(await page.evaluate(measureDrag, { widgetTag, draggableSelector: DRAGGABLE_SELECTOR, i, stepCount })) });
    }
    await cdpSession.send('Emulation.setCPUThrottlingRate', { rate: 1 });
  }
  await browserContext.close();
  return dragTimings;
}

/** Measures the times of one drag. Runs in the page. @param {{ widgetTag: string, draggableSelector: string, i: number, stepCount: number }} options */
async function measureDrag({ widgetTag, draggableSelector, i, stepCount }) {
  const MAX_FRAMES_PER_STEP = 30;
  const figureElement = /** @type {any} */ (document.querySelector(widgetTag));
  const shadowRoot = /** @type {ShadowRoot} */ (figureElement.shadowRoot);
  const draggedElement = /** @type {HTMLInputElement} */ (shadowRoot.querySelectorAll(draggableSelector)[i]);
  const isSlider = draggedElement.localName === 'input';
  // The drag begins after late updates of the previous drag, which could set the value of the slider.
  await figureElement.settled;
  const openingValue = draggedElement.value;
  // A figure clears the canvas before each picture, so that the number of `clearRect` calls is the number of pictures.
  let pictureCount = 0;
  const { clearRect } = CanvasRenderingContext2D.prototype;
  CanvasRenderingContext2D.prototype.clearRect = function (...rectangleSides) {
    pictureCount++;
    clearRect.apply(this, rectangleSides);
  };
  /** Returns the end of the animation frame. A message that the page sends to itself arrives only then. @returns {Promise<number>} */
  const waitForFrameEnd = () =>
    new Promise((resolve) => {
      const { port1, port2 } = new MessageChannel();
      port1.onmessage = () => resolve(performance.now());
      port2.postMessage(undefined);
    });
  /** Returns the end of the animation frame in which a text changes, including texts for screen readers. @returns {Promise<number>} */
  const waitForTextChange = () =>
    new Promise((resolve) => {
      const textObserver = new MutationObserver(() => {
        textObserver.disconnect();
        resolve(waitForFrameEnd());
      });
      const attributeFilter = ['aria-label', 'aria-valuetext'];
      textObserver.observe(shadowRoot, { subtree: true, characterData: true, childList: true, attributes: true, attributeFilter });
    });
  const sendStep = (/** @type {number} */ stepNumber) => {
    if (isSlider) {
      if (stepNumber % 2) draggedElement.stepUp();
      else draggedElement.stepDown();
      draggedElement.dispatchEvent(new InputEvent('input', { bubbles: true, composed: true }));
    } else {
      // Handles are dragged by arrow keys, which have the same effects as a pointer.
      draggedElement.dispatchEvent(new KeyboardEvent('keydown', { key: stepNumber % 2 ? 'ArrowLeft' : 'ArrowRight', bubbles: true, composed: true }));
    }
  };
  /** @type {{ pictureTimes: number[], textTimes: number[], frameTimes: number[] }} */
  const dragTimes = { pictureTimes: [], textTimes: [], frameTimes: [] };
  // During the first six steps, which are not counted, the browser compiles the code.
  for (let stepNumber = -6; stepNumber < stepCount; stepNumber++) {
    await new Promise(requestAnimationFrame);
    const [configBefore, picturesBefore] = [JSON.stringify(figureElement.simulation.config), pictureCount];
    let frameStart = 0;
    // The animation frame is requested before the step, so that this callback runs before the callback of the figure.
    const picturePromise = new Promise((resolve) =>
      requestAnimationFrame(() => {
        frameStart = performance.now();
        resolve(waitForFrameEnd());
      }),
    );
    const textPromise = waitForTextChange();
    sendStep(stepNumber);
    let pictureTime = /** @type {number} */ (await picturePromise);
    // On a busy machine the picture may come an animation frame late.
    for (let frameNumber = 1; pictureCount === picturesBefore || JSON.stringify(figureElement.simulation.config) === configBefore; frameNumber++) {
      if (frameNumber === MAX_FRAMES_PER_STEP) throw new Error(`A step of ${draggedElement.id || draggedElement.className} has no picture after ${MAX_FRAMES_PER_STEP} frames.`);
      await new Promise(requestAnimationFrame);
      pictureTime = await waitForFrameEnd();
    }
    const textTime = await textPromise;
    if (stepNumber < 0) continue;
    dragTimes.pictureTimes.push(pictureTime - frameStart);
    dragTimes.textTimes.push(Math.max(0, textTime - pictureTime));
  }
  let previousFrameTime = 0;
  for (let stepIndex = 0; stepIndex <= stepCount; stepIndex++) {
    const frameTime = /** @type {number} */ (await new Promise(requestAnimationFrame));
    if (stepIndex > 0) dragTimes.frameTimes.push(frameTime - previousFrameTime);
    previousFrameTime = frameTime;
    sendStep(stepIndex);
  }
  CanvasRenderingContext2D.prototype.clearRect = clearRect;
  if (isSlider) {
    draggedElement.value = openingValue;
    for (const eventName of ['input', 'change']) draggedElement.dispatchEvent(new Event(eventName, { bubbles: true, composed: true }));
    await new Promise(requestAnimationFrame);
  }
  return { controlName: draggedElement.id || (draggedElement.getAttribute('aria-label') ?? ''), ...dragTimes };
}
