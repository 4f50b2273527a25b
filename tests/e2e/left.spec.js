// Nothing is left of figures that have gone, nor of what was done to one: memory, listeners, observers, nodes.

import { expect } from '@playwright/test';
import { ALL, CLOUDS, ready } from './element-support.js';
import { FRESH, STILL, test } from './support.js';

/** @typedef {import('@playwright/test').CDPSession} Session */
/** @typedef {import('@playwright/test').Page} Page */

test.use(STILL);

// Ten times what they take where nothing else runs.
test.setTimeout(200_000);

/** What a figure makes one of at least, and leaves none of. */
const MADE = ['WebAssembly.Memory', 'ResizeObserver', 'AbortController', 'ShadowRoot'];

/** Events of a slider a frame: as many as no hand makes. */
const A_FRAME = 500;

/** What all figures of a page share. */
const SHARED = ['MutationObserver', 'IntersectionObserver'];

/**
 * How many objects of each class there are, after all that nobody holds was collected.
 *
 * @param {Session} session
 * @param {string[]} classes
 */
async function living(session, classes) {
  // To look objects up collects too, but spares whatever a word on the stack may point to, the same word at each look.
  await session.send('HeapProfiler.collectGarbage');
  /** @type {Record<string, number>} */
  const counts = {};
  for (const name of classes) {
    const { result } = await session.send('Runtime.evaluate', { expression: `${name}.prototype` });
    const { objects } = await session.send('Runtime.queryObjects', { prototypeObjectId: String(result.objectId) });
    const { result: length } = await session.send('Runtime.callFunctionOn', {
      objectId: objects.objectId,
      functionDeclaration: 'function () { return this.length }',
      returnByValue: true,
    });
    await session.send('Runtime.releaseObject', { objectId: String(objects.objectId) });
    counts[name] = length.value;
  }
  return counts;
}

/** What a figure is made with: few samples, where it has some. @param {string} name @returns {{ samples?: number }} */
const fewOf = (name) => (CLOUDS.some((each) => each === name) ? { samples: 200 } : {});

/**
 * A page of whose events nobody takes notes.
 *
 * @param {Page} page
 * @param {string} name
 */
async function openQuietly(page, name) {
  await page.route('**/favicon.ico', (route) => route.fulfill({ status: 204 }));
  await page.goto(`/embed.html?${new URLSearchParams(Object.entries({ widget: name, ...fewOf(name) }).map(([key, value]) => [key, String(value)]))}`);
}

/**
 * What a page takes, after all that nobody holds was collected.
 *
 * @param {Page} page
 * @param {Session} session
 * @param {number} figures that are still held
 */
async function taken(page, session, figures) {
  // A measurement of costs waits for a moment's rest, and its figure with it.
  await expect.poll(async () => (await living(session, ['ShadowRoot'])).ShadowRoot, { timeout: 30_000 }).toBe(figures);
  // What is finalized lets go of more.
  for (let i = 0; i < 3; i++) {
    await session.send('HeapProfiler.collectGarbage');
    await page.evaluate(() => new Promise((resolve) => setTimeout(resolve)));
  }
  const { usedSize: heap } = await session.send('Runtime.getHeapUsage');
  const { nodes, jsEventListeners } = await session.send('Memory.getDOMCounters');
  return { heap, nodes, counts: { jsEventListeners, ...(await living(session, [...MADE, ...SHARED])) } };
}

/**
 * Puts figures on the page, several at a time, and takes them away when each has been drawn.
 *
 * @param {Page} page
 * @param {Session} session
 * @param {string} name
 * @param {number} count
 */
async function mount(page, session, name, count) {
  const AT_ONCE = 10;
  // The engine has addresses for some hundred modules' memories, and does not always collect in time.
  const BETWEEN = 50;
  for (let i = 0; i < count; i += AT_ONCE) {
    await page.evaluate(
      async ([tag, times, few]) => {
        const figures = Array.from({ length: times }, () => Object.assign(document.createElement(tag), few));
        const loaded = figures.map((figure) => new Promise((resolve) => figure.addEventListener('load', resolve, { once: true })));
        document.body.append(...figures);
        await Promise.all(loaded);
        await new Promise(requestAnimationFrame);
        document.body.replaceChildren();
        // They are taken down after the task in which they go.
        await new Promise((resolve) => setTimeout(resolve));
      },
      /** @type {const} */ ([name, AT_ONCE, fewOf(name)]),
    );
    if (i % BETWEEN === 0) await session.send('HeapProfiler.collectGarbage');
  }
}

test('a thousand figures that came and went leave nothing', FRESH, async ({ page }) => {
  await openQuietly(page, 'banana-machine');
  await page.evaluate(() => {
    document.body.style.cssText = 'display: grid; grid-template-columns: repeat(10, 120px)';
    document.body.replaceChildren();
  });
  const session = await page.context().newCDPSession(page);
  await session.send('HeapProfiler.enable');
  // What is compiled and kept once for all figures.
  for (const name of ALL) await mount(page, session, name, 50);
  // What the engine has compiled may hold the latest of a class, and no more.
  const most = async () => Math.max(...Object.values(await living(session, MADE)));
  await expect.poll(most, { timeout: 30_000 }).toBeLessThanOrEqual(1);
  const before = await taken(page, session, 0);

  for (const name of ALL) await mount(page, session, name, 200);
  await expect.poll(most, { timeout: 30_000 }).toBeLessThanOrEqual(1);
  const after = await taken(page, session, 0);
  expect({ ...after.counts, ResizeObserver: 0 }).toEqual({ ...before.counts, ResizeObserver: 0 });
  expect(after.nodes).toBe(before.nodes);

  // What one leaves that somebody holds: so it would be seen.
  for (const name of ALL) {
    await page.evaluate(async ([tag, few]) => {
      const figure = Object.assign(document.createElement(tag), few);
      const loaded = new Promise((resolve) => figure.addEventListener('load', resolve));
      document.body.append(figure);
      await loaded;
      await new Promise(requestAnimationFrame);
      figure.remove();
      Object.assign(window, { [tag]: figure });
    }, /** @type {const} */ ([name, fewOf(name)]));
  }
  const held = await taken(page, session, ALL.length);
  expect(held.nodes).toBeGreaterThan(after.nodes);
  // Less than a hundredth of what they would leave if somebody held them: what the engine notes of its own, and keeps, as the
  // code that it has compiled, is some 90 kilobytes of it.
  const [grown, one] = [after.heap - before.heap, (held.heap - after.heap) / ALL.length];
  console.log(`a thousand figures left ${grown} bytes, one that is held ${one}`);
  expect(grown).toBeLessThan((1000 * one) / 100);
});

for (const name of ALL) {
  test(`fifty thousand events of the sliders of ${name} leave nothing`, FRESH, async ({ page }) => {
    await openQuietly(page, name);
    const widget = page.locator(name);
    await ready(widget);
    const session = await page.context().newCDPSession(page);
    await session.send('HeapProfiler.enable');
    const slide = (/** @type {number} */ events) =>
      widget.evaluate(async (element, [count, perFrame]) => {
        const sliders = /** @type {HTMLInputElement[]} */ ([...(element.shadowRoot?.querySelectorAll('input[type=range]') ?? [])]).filter(({ id }) => id !== 'samples' && id !== 'steps');
        for (let i = 0; i < count; i++) {
          const slider = sliders[i % sliders.length];
          // Up and down, the same after so many: what is said for the first time brings a template that is kept.
          const share = Math.abs((((i % 5000) * 0.0137) % 1.2) - 0.6);
          slider.value = String(Number(slider.min) + (Number(slider.max) - Number(slider.min)) * share);
          slider.dispatchEvent(new Event('input', { bubbles: true, composed: true }));
          // The page hears of each.
          await null;
          if (i % perFrame === 0) await new Promise(requestAnimationFrame);
        }
        for (const slider of sliders) {
          slider.value = slider.min;
          slider.dispatchEvent(new Event('input', { bubbles: true, composed: true }));
          slider.dispatchEvent(new Event('change', { bubbles: true, composed: true }));
        }
        for (let i = 0; i < 5; i++) await new Promise(requestAnimationFrame);
        // What takes long is done in slices, a frame each.
        while (element.localName === 'alpha-calibrator' && /** @type {any} */ (element).machine.progress < 1) await new Promise(requestAnimationFrame);
      }, [events, A_FRAME]);
    /** Bytes of WebAssembly's memories. */
    const memory = async () => {
      const { result } = await session.send('Runtime.evaluate', { expression: 'WebAssembly.Memory.prototype' });
      const { objects } = await session.send('Runtime.queryObjects', { prototypeObjectId: String(result.objectId) });
      const { result: bytes } = await session.send('Runtime.callFunctionOn', {
        objectId: objects.objectId,
        functionDeclaration: 'function () { return this.map(({ buffer }) => buffer.byteLength) }',
        returnByValue: true,
      });
      return bytes.value;
    };
    await slide(20_000);
    const before = { ...(await taken(page, session, 1)), memory: await memory() };
    await slide(50_000);
    const after = { ...(await taken(page, session, 1)), memory: await memory() };
    expect(before.memory).toHaveLength(1);
    expect(after.memory).toHaveLength(1);
    // A log is fitted anew by what a slider says when a frame comes: which fits there are, and in which order, is chance, and so are the
    // holes between them. What leaked at each would be much more.
    const chance = name === 'alpha-calibrator' ? 1.25 : 1;
    expect(after.memory[0]).toBeLessThanOrEqual(chance * before.memory[0]);
    const grown = after.heap - before.heap;
    const nodes = after.nodes - before.nodes;
    console.log(`50 000 events on ${name} left ${grown} bytes and ${nodes} nodes`);
    expect(after.counts).toEqual(before.counts);
    // Not one a frame: other words may have other nodes.
    expect(nodes).toBeLessThan(50_000 / A_FRAME);
    // The least that something kept takes is a reference to it, of four bytes, an event; and what it refers to, more.
    expect(grown).toBeLessThan(4 * 50_000);
  });
}
