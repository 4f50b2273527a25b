/**
 * Time from the start of the page's script to the first cloud on screen, in a page without history.
 *
 * @module
 */

import { quartiles } from './timing.js';

/** Marks in order, and the work that ends with each. */
const STAGES = /** @type {const} */ ([
  ['begin', ''],
  ['evaluated', 'the script is evaluated'],
  ['instantiating', 'the element asks for the module'],
  ['instantiated', 'the module is compiled and instantiated'],
  ['drawn', 'machine, first rendering, first samples drawn'],
  ['shown', 'the frame is handed over'],
]);

/**
 * @typedef {object} Start times in ms
 * @property {number} loads
 * @property {import('./timing.js').Quartiles} total
 * @property {{ stage: string, time: import('./timing.js').Quartiles }[]} stages
 */

/**
 * @param {import('@playwright/test').Browser} browser
 * @param {string} address of start.html
 * @param {number} loads
 * @returns {Promise<Start>}
 */
export async function timeStart(browser, address, loads) {
  /** @type {number[][]} */
  const marks = [];
  for (let load = 0; load < loads; load++) {
    // A new process with its own caches.
    const context = await browser.newContext({ viewport: { width: 1280, height: 900 } });
    const page = await context.newPage();
    await page.addInitScript(markStages);
    // The robots of the first sight drive before there is a cloud.
    await page.addInitScript(() => sessionStorage.setItem('motion-widgets.introduced', 'yes'));
    await page.goto(address);
    await page.waitForFunction(() => performance.getEntriesByName('shown').length > 0);
    marks.push(
      await page.evaluate(
        (names) => names.map((name) => performance.getEntriesByName(name)[0].startTime),
        STAGES.map(([name]) => name),
      ),
    );
    await context.close();
  }
  const stages = STAGES.slice(1).map(([, stage], i) => {
    return { stage, time: quartiles(marks.map((times) => times[i + 1] - times[i])) };
  });
  return { loads, total: quartiles(marks.map((times) => times[times.length - 1] - times[0])), stages };
}

/** Runs in the page before any script of its own. */
function markStages() {
  const { compile, instantiate } = WebAssembly;
  WebAssembly.compile = (source) => {
    performance.mark('instantiating');
    return compile(source);
  };
  WebAssembly.instantiate = /** @type {typeof instantiate} */ (
    /** @type {unknown} */ (async (/** @type {any} */ source, /** @type {any} */ imports) => {
      const started = await instantiate(source, imports);
      performance.mark('instantiated');
      return started;
    })
  );
  // A cloud is an image of its density, or this number of dots.
  const DOTS = 100;
  let dots = 0;
  const { prototype } = CanvasRenderingContext2D;
  for (const name of /** @type {const} */ (['drawImage', 'putImageData', 'arc'])) {
    const draw = /** @type {(...values: any[]) => void} */ (prototype[name]);
    /** @this {CanvasRenderingContext2D} @param {any[]} values */
    prototype[name] = function (...values) {
      draw.apply(this, values);
      const root = this.canvas.getRootNode();
      if (!(root instanceof ShadowRoot) || root.host.localName !== 'banana-machine') return;
      if ((name === 'arc' && ++dots < DOTS) || performance.getEntriesByName('drawn').length > 0) return;
      performance.mark('drawn');
      // A message is read once the frame that is being made has been handed to the screen.
      const { port1, port2 } = new MessageChannel();
      port1.onmessage = () => performance.mark('shown');
      port2.postMessage(undefined);
    };
  }
}
