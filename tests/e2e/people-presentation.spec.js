import { expect } from '@playwright/test';
import { expectAccessible } from './axe.js';
import { ALL, ready, show } from './element-support.js';
import { STILL, boxOf, centreOf, frames, test } from './support.js';

/** @typedef {import('./element-support.js').AnyElement} AnyElement */

test.use({ ...STILL, viewport: { width: 1920, height: 1080 } });

/** How much larger everything is. @param {import('@playwright/test').Locator} widget */
const zoomOf = (widget) => widget.locator('.surface').evaluate((element) => new DOMMatrix(getComputedStyle(element).transform).a);

for (const controls of [false, true]) {
  test(`on a phone the Banana Machine shows both pictures, equally large, ${controls ? 'with' : 'without'} controls`, async ({ page }) => {
    await page.setViewportSize({ width: 375, height: 667 });
    await show(page, '<banana-machine></banana-machine>');
    const widget = page.locator('banana-machine');
    await ready(widget);
    // A picture whose size follows from its pixels, which follow from its size, never comes to rest.
    const loops = page.evaluate(() => {
      /** @type {string[]} */
      const told = [];
      addEventListener('error', ({ message }) => told.push(message));
      return new Promise((resolve) => document.addEventListener('keyup', ({ key }) => key === 'F9' && resolve(told)));
    });
    await widget.evaluate((element) => element.setAttribute('presentation', ''));
    if (controls) await page.keyboard.press('c');
    await frames(page);
    const boxes = () => Promise.all(['plane', 'twist'].map((name) => boxOf(widget.locator(`canvas.${name}`))));
    const [plane, twist] = await boxes();
    expect(plane.height).toBeGreaterThan(100);
    expect(twist.height).toBe(plane.height);
    for (let i = 0; i < 10; i++) await frames(page);
    expect(await boxes()).toEqual([plane, twist]);
    await page.keyboard.press('F9');
    expect(await loops).toEqual([]);
  });
}

for (const name of ['alpha-calibrator', 'dead-reckoning']) {
  test(`the legends of ${name} are not behind the buttons, however large the window is`, async ({ page }) => {
    await show(page, `<${name} presentation></${name}>`);
    const widget = page.locator(name);
    await ready(widget);
    for (const [width, height] of [[667, 375], [800, 600], [1024, 768], [1280, 720]]) {
      await page.setViewportSize({ width, height });
      await frames(page);
      const buttons = await boxOf(widget.locator('.presenting'));
      const bottom = Math.max(...(await Promise.all((await widget.locator('.presenting button').all()).map(boxOf))).map(({ y, height }) => y + height));
      for (const canvas of await widget.locator('.stage canvas').all()) {
        const { x, y, width: wide } = await boxOf(canvas);
        expect(x + wide <= buttons.x || y >= bottom, `${width} × ${height}: a picture at ${x}, ${y}, buttons down to ${bottom}`).toBe(true);
      }
    }
  });
}

for (const [width, height] of [[375, 667], [667, 375], [640, 480]]) {
  test(`in a window of ${width} × ${height} pixels every figure shows its pictures, beside or above each other, and they come to rest`, async ({ page }) => {
    await page.setViewportSize({ width, height });
    for (const name of ALL) {
      await show(page, `<${name} presentation></${name}>`);
      const widget = page.locator(name);
      await ready(widget);
      await frames(page);
      const canvases = widget.locator('.stage canvas');
      const boxes = async () => Promise.all(Array.from({ length: await canvases.count() }, (_, i) => boxOf(canvases.nth(i))));
      const before = await boxes();
      for (let i = 0; i < 20; i++) await frames(page);
      expect(await boxes(), name).toEqual(before);
      for (const [i, box] of before.entries()) {
        expect(box.height, name).toBeGreaterThan(150);
        for (const other of before.slice(i + 1)) {
          expect(other.x >= box.x + box.width || other.y >= box.y + box.height || box.x >= other.x + other.width || box.y >= other.y + other.height, name).toBe(true);
        }
      }
    }
  });
}

for (const name of ALL) {
  test(`${name} fills the screen, legible from the last row, and leaves as it came`, async ({ page }) => {
    await show(page, `<div style="height: 300px"></div><${name}></${name}><div style="height: 3000px"></div>`);
    const widget = page.locator(name);
    await ready(widget);
    await widget.getByRole('button', { name: 'Present' }).scrollIntoViewIfNeeded();
    const [before, scrolled] = [await boxOf(widget), await page.evaluate(() => scrollY)];
    await widget.getByRole('button', { name: 'Present' }).click();
    await expect.poll(() => page.evaluate(() => document.fullscreenElement?.localName)).toBe(name);
    await frames(page);
    expect(await boxOf(widget)).toEqual({ x: 0, y: 0, width: 1920, height: 1080 });
    // Two thirds of the height, and all of the width between them, less what stands beside them.
    const pictures = await Promise.all((await widget.locator('canvas').all()).map(boxOf));
    for (const { height } of pictures) expect(height).toBeGreaterThan(1080 * 0.6);
    // As sharp as the screen.
    const pixels = await widget.locator('canvas').evaluateAll((all) => all.map((each) => /** @type {HTMLCanvasElement} */ (each).width));
    for (const [i, { width }] of pictures.entries()) expect(Math.abs(pixels[i] - width)).toBeLessThanOrEqual(2);
    expect(pictures.reduce((sum, { width }) => sum + width, 0)).toBeGreaterThan(1920 * 0.65);
    const zoom = await zoomOf(widget);
    const sizes = await widget.locator('canvas, .readouts dt, .readouts dd, [part=caption]').evaluateAll((all) => all.map((each) => parseFloat(getComputedStyle(each).fontSize)));
    for (const size of sizes) expect(size * zoom).toBeGreaterThanOrEqual(24);
    // What is taken along is not enlarged.
    const off = await widget.evaluate((element) => {
      const { plate, pictures: [first], stage } = /** @type {any} */ (element);
      if (plate) return [];
      const { documentElement: svg } = new DOMParser().parseFromString(/** @type {any} */ (element).toSVG(), 'image/svg+xml');
      const { clientWidth, clientHeight } = stage.canvasOf(first);
      return [Number(svg.getAttribute('width')) - clientWidth, Number(svg.getAttribute('height')) - clientHeight];
    });
    for (const length of off) expect(Math.abs(length)).toBeLessThanOrEqual(1);
    // Nothing to scroll, and every control behind the key that is named.
    expect(await widget.locator('.surface').evaluate((element) => element.scrollHeight <= element.clientHeight)).toBe(true);
    await expect(widget.locator('.slider').first()).toBeHidden();
    const controls = widget.getByRole('button', { name: 'C Controls' });
    await expect(controls).toBeFocused();
    await expectAccessible(page, undefined, name);
    // To copy what is selected shows no controls.
    await page.keyboard.press('Control+c');
    await expect(controls).toHaveAttribute('aria-pressed', 'false');
    await page.keyboard.press('c');
    await expect(controls).toHaveAttribute('aria-pressed', 'true');
    await expect(widget.locator('.slider').first()).toBeVisible();
    // In the field of a value, it is a letter as any other.
    await widget.locator('.typed').first().click();
    await page.keyboard.press('c');
    await expect(controls).toHaveAttribute('aria-pressed', 'true');
    await page.keyboard.press('Escape');
    await expect(widget).toHaveAttribute('presentation');
    await page.keyboard.press('Escape');
    await expect(widget).not.toHaveAttribute('presentation');
    await expect.poll(() => page.evaluate(() => document.fullscreenElement)).toBe(null);
    await expect.poll(() => page.evaluate(() => scrollY)).toBe(scrolled);
    expect(await boxOf(widget)).toEqual(before);
    await expect(widget.getByRole('button', { name: 'Present' })).toBeFocused();
    await expect(widget.getByRole('button', { name: 'Esc' })).toHaveCount(0);
  });

  test(`${name} fills the window where the screen is not to be had, and nothing behind it has the focus`, async ({ page }) => {
    await page.addInitScript(() => Object.defineProperty(Document.prototype, 'fullscreenEnabled', { value: false }));
    await show(page, `<div><${name}></${name}></div><p inert>Out of reach before, and after</p><p><a id="behind" href="#">Behind</a></p><div style="height: 3000px"></div>`, {
      head: '<style>html { overflow-y: scroll; scrollbar-width: auto } ::-webkit-scrollbar { width: 12px }</style>',
    });
    const widget = page.locator(name);
    await ready(widget);
    await widget.evaluate((element) => void (Reflect.set(element, 'presentation', true)));
    await expect(widget).toHaveAttribute('presentation');
    expect(await boxOf(widget)).toEqual({ x: 0, y: 0, width: 1920, height: 1080 });
    // Meanwhile the figure may get another theme, and the window another size.
    await widget.evaluate((element) => element.setAttribute('theme', 'light'));
    await page.setViewportSize({ width: 1440, height: 810 });
    await frames(page);
    expect(await zoomOf(widget)).toBe(1.5);
    await page.locator('#behind').focus();
    await expect(page.locator('#behind')).not.toBeFocused();
    expect(await page.locator('#behind').evaluate((element) => element.closest('[inert]') !== null)).toBe(true);
    await page.mouse.wheel(0, 500);
    await frames(page);
    expect(await page.evaluate(() => scrollY)).toBe(0);
    await page.keyboard.press('Escape');
    await expect(widget).not.toHaveAttribute('presentation');
    // The focus returns to where it was, a frame later.
    await frames(page);
    await page.locator('#behind').focus();
    await expect(page.locator('#behind')).toBeFocused();
    expect(await page.locator('[inert]').evaluateAll((all) => all.map(({ localName }) => localName))).toEqual(['p']);
    expect(await page.evaluate(() => document.documentElement.style.overflow)).toBe('');
  });
}

/** What stands on a figure with its controls, each by itself. */
const GROUPS = ['.stage', '.presenting', '[part=caption]', '[part=readouts]', 'fieldset', '.presets', '.folds'].map((each) => `${each}:not(details *)`).join();

/** The names and boxes of all that is seen of them. @param {import('@playwright/test').Locator} widget */
const groupsOf = (widget) => widget.locator(GROUPS).evaluateAll((all) =>
  all.filter((each) => each.checkVisibility()).map((each) => {
    const { left, top, right, bottom } = each.getBoundingClientRect();
    return { name: `${each.localName}.${each.className || each.querySelector('legend')?.textContent}`, left, top, right, bottom };
  }),
);

/** @param {import('@playwright/test').Locator} widget */
const scrollTop = (widget) => widget.locator('.surface').evaluate((element) => element.scrollTop);

for (const name of ALL) {
  for (const lang of ['en', 'de']) {
    for (const [width, height] of [[1280, 720], [1920, 1080]]) {
      test(`${name} shows its controls beside a large picture, ${width} × ${height} px, in ${lang}`, async ({ page }) => {
        await page.setViewportSize({ width, height });
        await show(page, `<${name} lang="${lang}" presentation></${name}>`, {
          script: '<script type="module" src="/motion-widgets.js"></script><script type="module" src="/de.js"></script>',
        });
        const widget = page.locator(name);
        await ready(widget);
        await expect(widget.locator('.presenting button').first()).toBeFocused();
        await page.keyboard.press('c');
        await expect(widget.locator('.folds')).toBeVisible();
        await frames(page);
        const groups = await groupsOf(widget);
        // Picture, buttons of the presentation, sentence, figures, at least two groups of controls, folds.
        expect(groups.length).toBeGreaterThanOrEqual(7);
        /** @type {string[]} */
        const over = [];
        for (const [i, one] of groups.entries()) {
          for (const other of groups.slice(i + 1)) {
            const apart = one.right <= other.left + 0.5 || other.right <= one.left + 0.5 || one.bottom <= other.top + 0.5 || other.bottom <= one.top + 0.5;
            // The buttons stand in the margin of a picture, clear of its legend.
            const margin = one.name.includes('stage') && other.name.includes('presenting');
            if (!apart && !margin) over.push(`${one.name} and ${other.name}`);
          }
        }
        expect(over).toEqual([]);
        for (const picture of await widget.locator('canvas').all()) expect((await boxOf(picture)).height).toBeGreaterThanOrEqual(0.4 * height);
        // All of it is on the screen.
        for (const each of groups) expect(each.bottom, each.name).toBeLessThanOrEqual(height);
        expect(await widget.locator('.surface').evaluate((element) => element.scrollWidth <= element.clientWidth)).toBe(true);
        // What a fold adds is scrolled to, by keys and by wheel, and what leads back out stays.
        await widget.locator('summary').nth(1).click();
        await frames(page);
        await widget.locator('.presenting button').first().focus();
        await page.keyboard.press('End');
        await expect.poll(async () => (await boxOf(widget.locator('.folds'))).y + (await boxOf(widget.locator('.folds'))).height).toBeLessThanOrEqual(height + 0.5);
        expect(await scrollTop(widget)).toBeGreaterThan(0);
        await expect(widget.locator('.presenting')).toBeInViewport();
        expect((await boxOf(widget.locator('canvas').first())).y).toBeGreaterThanOrEqual(-1);
        await page.keyboard.press('Home');
        await expect.poll(() => scrollTop(widget)).toBe(0);
        await page.mouse.move(width / 2, height - 20);
        await page.mouse.wheel(0, 200);
        await expect.poll(() => scrollTop(widget)).toBeGreaterThan(0);
      });
    }
  }
}

test('what a page begins ends by its button, and the page stays where it was', async ({ page }) => {
  await page.addInitScript(() => Object.defineProperty(Document.prototype, 'fullscreenEnabled', { value: false }));
  await show(page, '<div style="height: 900px"></div><banana-machine></banana-machine>');
  const widget = page.locator('banana-machine');
  await ready(widget);
  // The figure begins in sight, and the button that gets the focus at the end is below the window. Without the figure there is
  // nothing to scroll.
  await page.evaluate(() => scrollTo(0, 250));
  await frames(page);
  await widget.evaluate((element) => void Object.assign(element, { presentation: '' }));
  await widget.getByRole('button', { name: 'Esc' }).click();
  await expect(widget).not.toHaveAttribute('presentation');
  await expect(widget.locator('.to-present')).toBeFocused();
  await frames(page);
  expect(await page.evaluate(() => scrollY)).toBe(250);
});

test('what the browser ends by a key of its own has ended, and the pictures have the window’s pixels again', async ({ page }) => {
  await show(page, '<banana-machine></banana-machine>');
  const widget = page.locator('banana-machine');
  await ready(widget);
  await widget.getByRole('button', { name: 'Present' }).click();
  await expect.poll(() => page.evaluate(() => document.fullscreenElement?.localName)).toBe('banana-machine');
  await page.evaluate(() => document.exitFullscreen());
  await expect(widget).not.toHaveAttribute('presentation');
  await expect(widget.locator('.to-present')).toBeFocused();
  await page.setViewportSize({ width: 1600, height: 900 });
  await frames(page);
  const canvas = widget.locator('canvas.plane');
  const { width } = await boxOf(canvas);
  expect(Math.abs(Number(await canvas.evaluate((element) => Reflect.get(element, 'width'))) - width)).toBeLessThanOrEqual(2);
});

test('a screen that is granted when the presentation has ended is given back', async ({ page }) => {
  await show(page, '<banana-machine></banana-machine>');
  const widget = page.locator('banana-machine');
  await ready(widget);
  await page.evaluate(() => {
    const { requestFullscreen } = Element.prototype;
    Element.prototype.requestFullscreen = function () {
      const asked = requestFullscreen.call(this);
      Object.assign(window, { asked });
      return asked;
    };
    addEventListener('click', () => (/** @type {any} */ (document.querySelector('banana-machine')).presentation = false), { once: true });
  });
  await widget.getByRole('button', { name: 'Present' }).click();
  await page.evaluate(() => Reflect.get(window, 'asked'));
  await expect(widget).not.toHaveAttribute('presentation');
  await expect.poll(() => page.evaluate(() => document.fullscreenElement)).toBe(null);
});

test('of two figures that are presented the second one takes the place of the first', async ({ page }) => {
  await show(page, '<banana-machine></banana-machine><p></p><map-squeeze></map-squeeze>');
  const [first, second] = [page.locator('banana-machine'), page.locator('map-squeeze')];
  await ready(first);
  await ready(second);
  const present = (/** @type {import('@playwright/test').Locator} */ widget, presentation = true) =>
    widget.evaluate((element, presentation) => void Object.assign(element, { presentation }), presentation);
  const reach = () => page.evaluate(() => ['banana-machine', 'p', 'map-squeeze'].map((name) => document.querySelector(name)?.matches('[inert]')));
  await present(first);
  expect(await reach()).toEqual([false, true, true]);
  await present(second);
  await expect(first).not.toHaveAttribute('presentation');
  expect(await reach()).toEqual([true, true, false]);
  await expect.poll(() => page.evaluate(() => document.fullscreenElement?.localName)).toBe('map-squeeze');
  await expect(second.getByRole('button', { name: 'C Controls' })).toBeFocused();
  await present(second, false);
  expect(await reach()).toEqual([false, false, false]);
  expect(await page.evaluate(() => document.documentElement.style.overflow)).toBe('');
});

test('a handle stays under the pointer while the picture is enlarged', async ({ page }) => {
  await show(page, '<banana-machine presentation></banana-machine>');
  const widget = page.locator('banana-machine');
  await ready(widget);
  const handle = widget.getByRole('slider', { name: 'End of the commanded arc' });
  const from = await centreOf(handle);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x + 60, from.y - 40, { steps: 4 });
  await frames(page);
  const to = await centreOf(handle);
  expect(Math.hypot(to.x - from.x - 60, to.y - from.y + 40)).toBeLessThan(2);
  await page.mouse.up();
});
