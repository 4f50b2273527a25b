// Measurement of the time from the start of the page's script to the first cloud on screen, without caches.

/** Stages of the start. The key of a stage is the performance mark that is set at its end. */
const STAGE_OF_MARK = /** @type {const} */ ({
  evaluated: 'the script is evaluated',
  drawn: 'module, simulation, first rendering, first samples drawn',
  shown: 'the frame is handed over',
});

/**
 * Loads the page several times, and measures the stages of its start.
 *
 * @param {import('@playwright/test').Browser} browser
 * @param {string} pageUrl of page.html
 * @param {number} loadCount
 * @returns {Promise<Record<string, number[]>>} ms from the start of the script to the end of each stage, load by load
 */
export async function measureStarts(browser, pageUrl, loadCount) {
  /** @type {Record<string, number[]>} */
  const stageTimes = Object.fromEntries(Object.values(STAGE_OF_MARK).map((stageName) => [stageName, []]));
  for (let loadIndex = 0; loadIndex < loadCount; loadIndex++) {
    // Each load has a new process with its own caches.
    const browserContext = await browser.newContext({ viewport: { width: 1280, height: 900 } });
    const page = await browserContext.newPage();
    await page.addInitScript(markStages);
    // The introduction, an animation of single robots that would delay the cloud, counts as already shown in this session.
    await page.addInitScript(() => sessionStorage.setItem('motion-widgets.introduced', 'yes'));
    await page.goto(pageUrl);
    await page.waitForFunction(() => performance.getEntriesByName('shown').length > 0);
    for (const [markName, stageName] of Object.entries(STAGE_OF_MARK)) {
      stageTimes[stageName].push(await page.evaluate((markName) => performance.measure('', 'begin', markName).duration, markName));
    }
    await browserContext.close();
  }
  return stageTimes;
}

/** Marks the ends of stages that the page does not mark itself. Runs before the page's scripts. */
function markStages() {
  // The cloud counts as drawn once an image of its density or this number of dots is drawn.
  const DOTS_OF_CLOUD = 100;
  let dotCount = 0;
  const { prototype: contextPrototype } = CanvasRenderingContext2D;
  for (const methodName of /** @type {const} */ (['drawImage', 'putImageData', 'arc'])) {
    const originalMethod = /** @type {(...values: any[]) => void} */ (contextPrototype[methodName]);
    /** @this {CanvasRenderingContext2D} @param {any[]} drawArguments */
    contextPrototype[methodName] = function (...drawArguments) {
      originalMethod.apply(this, drawArguments);
      const canvasRoot = this.canvas.getRootNode();
      if (!(canvasRoot instanceof ShadowRoot) || canvasRoot.host.localName !== 'banana-machine') return;
      if ((methodName === 'arc' && ++dotCount < DOTS_OF_CLOUD) || performance.getEntriesByName('drawn').length > 0) return;
      performance.mark('drawn');
      // A message that the page sends to itself arrives after the current animation frame was handed to the screen, and so shown.
      const { port1, port2 } = new MessageChannel();
      port1.onmessage = () => performance.mark('shown');
      port2.postMessage(undefined);
    };
  }
}
