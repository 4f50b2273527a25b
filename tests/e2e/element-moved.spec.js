// A figure that is taken from under the reader's hand, or into another document.

import { expect } from '@playwright/test';
import { ALL, HANDLED, KNOWN, heard, property, ready, show, stateOf } from './element-support.js';
import { STILL, centreOf, frames, pictureOf, test } from './support.js';

/** @typedef {import('./element-support.js').AnyElement} AnyElement */
/** @typedef {import('@playwright/test').Locator} Locator */

test.use(STILL);

/**
 * Takes a handle and moves it a little, without letting go.
 *
 * @param {Locator} handle
 */
async function drag(handle) {
  const { x, y } = await centreOf(handle);
  const { mouse } = handle.page();
  await mouse.move(x, y);
  await mouse.down();
  await mouse.move(x + 30, y + 20, { steps: 3 });
  await frames(handle.page());
}

/**
 * How many pixels a metre has in the picture, across and upwards.
 *
 * @param {Locator} widget
 * @returns {Promise<[number, number]>}
 */
function scales(widget) {
  return widget.evaluate((element) => {
    const [{ view }] = /** @type {any} */ (element).pictures;
    return [view.scaleX, view.scaleY];
  });
}

/** @param {Locator} widget @param {string} to */
const move = (widget, to) => widget.evaluate((element, selector) => document.querySelector(selector)?.append(element), to);

for (const name of HANDLED) {
  test(`${name}, moved while a handle is held, is let go of, and its picture fits where it is now`, async ({ page }) => {
    await show(page, `<div id="a" style="width: 1100px"><${name}></${name}></div><div id="b" style="width: 500px"></div>`);
    const widget = page.locator(name);
    await ready(widget);
    const handle = widget.locator('.handle').first();
    const before = await stateOf(widget);
    await drag(handle);
    expect(await property(widget, 'held')).toBe(true);
    const dragged = await stateOf(widget);
    expect(dragged).not.toEqual(before);
    await heard(page);
    await move(widget, '#b');
    await frames(page);
    expect(await property(widget, 'held')).toBe(false);
    await expect(handle).not.toHaveClass(/held/);
    // What was dragged has come to rest where it was let go of.
    expect((await heard(page)).map(({ name }) => name)).toEqual(['change']);
    const [across, upwards] = await scales(widget);
    expect(across / upwards).toBeCloseTo(1, 9);
    await page.mouse.move(700, 300);
    await frames(page);
    expect(await stateOf(widget)).toEqual(dragged);
    await page.mouse.up();
  });

  test(`${name}, removed while a handle is held, comes back as it was left, and is held by nobody`, async ({ page }) => {
    await show(page, `<div id="a" style="width: 1100px"><${name}></${name}></div><div id="b" style="width: 500px"></div>`);
    const widget = page.locator(name);
    await ready(widget);
    await drag(widget.locator('.handle').first());
    const dragged = await stateOf(widget);
    await page.evaluate(async (tag) => {
      const element = /** @type {Element} */ (document.querySelector(tag));
      element.remove();
      await new Promise(requestAnimationFrame);
      document.querySelector('#b')?.append(element);
    }, name);
    await ready(widget);
    expect(await property(widget, 'held')).toBe(false);
    const [across, upwards] = await scales(widget);
    expect(across / upwards).toBeCloseTo(1, 9);
    await page.mouse.move(700, 300);
    await page.mouse.up();
    await frames(page);
    expect(await stateOf(widget)).toEqual(dragged);
    // And it can be taken again.
    await drag(widget.locator('.handle').first());
    expect(await property(widget, 'held')).toBe(true);
    await page.mouse.up();
    expect(await property(widget, 'held')).toBe(false);
    expect(await stateOf(widget)).not.toEqual(dragged);
  });

  test(`${name} under a held handle keeps the proportions of its picture when it gets another size`, async ({ page }) => {
    await show(page, `<div id="a" style="width: 1100px"><${name}></${name}></div>`);
    const widget = page.locator(name);
    await ready(widget);
    await drag(widget.locator('.handle').first());
    await page.locator('#a').evaluate((element) => element.style.setProperty('width', '500px'));
    await frames(page);
    expect(await property(widget, 'held')).toBe(true);
    const [across, upwards] = await scales(widget);
    expect(across / upwards).toBeCloseTo(1, 9);
    await page.mouse.up();
  });
}

for (const name of ALL) {
  test(`${name} has its style sheets in another document, and back`, async ({ page }) => {
    await show(page, `<div id="a"><${name}></${name}></div><iframe srcdoc="<!doctype html><body style='margin: 8px; background: #123; color: #eee'></body>" width="1100" height="900" style="border: 0"></iframe>`);
    const widget = page.locator(name);
    await ready(widget);
    const before = await stateOf(widget);
    const { slider } = KNOWN[name];
    const picture = await pictureOf(widget.locator('canvas.plane'));
    const frame = page.frameLocator('iframe').locator(name);
    await widget.evaluate((element) => document.querySelector('iframe')?.contentDocument?.body.append(element));
    await ready(frame);
    expect(await stateOf(frame)).toEqual(before);
    /** @param {Locator} figure */
    const styled = (figure) =>
      figure.evaluate((element, id) => {
        const root = /** @type {ShadowRoot} */ (element.shadowRoot);
        const [machine, track] = ['.machine', `#${id}`].map((selector) => getComputedStyle(/** @type {Element} */ (root.querySelector(selector))));
        return { display: machine.display, appearance: track.appearance, scheme: getComputedStyle(/** @type {Element} */ (root.querySelector('.surface'))).colorScheme };
      }, slider);
    const looks = await styled(frame);
    expect(looks.appearance).toBe('none');
    // The ground of that document is dark.
    expect(looks.scheme).toBe('dark');
    await frame.evaluate((element) => window.parent.document.querySelector('#a')?.append(element));
    await ready(widget);
    expect(await styled(widget)).toEqual({ ...looks, scheme: 'light' });
    await expect.poll(() => pictureOf(widget.locator('canvas.plane'))).toBe(picture);
    expect(await heard(page, ['error'])).toEqual([]);
  });

  test(`${name} may begin in another document`, async ({ page }) => {
    await show(page, '<iframe srcdoc="<!doctype html><body></body>" width="1100" height="900"></iframe>');
    await page.waitForFunction((tag) => customElements.get(tag) && document.querySelector('iframe')?.contentDocument?.body, name);
    await page.evaluate((tag) => document.querySelector('iframe')?.contentDocument?.body.append(document.createElement(tag)), name);
    const figure = page.frameLocator('iframe').locator(name);
    await ready(figure);
    await expect(figure.locator(`#${KNOWN[name].slider}`)).toHaveCSS('appearance', 'none');
  });
}

test('a finger whose slider leaves the page holds up no other', async ({ page }) => {
  await show(page, '<banana-machine></banana-machine><banana-machine id="other"></banana-machine>');
  const [first, other] = [page.locator('banana-machine').first(), page.locator('#other')];
  await ready(first);
  await other.scrollIntoViewIfNeeded();
  await ready(other);
  const touch = (/** @type {Element} */ on, /** @type {string} */ type) =>
    on.dispatchEvent(new PointerEvent(type, { pointerType: 'touch', bubbles: true, composed: true }));
  await first.evaluate((element, text) => {
    const send = /** @type {typeof touch} */ (new Function(`return ${text}`)());
    send(/** @type {Element} */ (element.shadowRoot?.querySelector('#v')), 'pointerdown');
    element.remove();
    // A finger that goes up is told to what is under it then.
    send(document.body, 'pointerup');
  }, String(touch));
  await other.locator('#v').fill('0.4');
  expect(await property(page.locator('#other'), 'v')).toBe(0.4);
});
