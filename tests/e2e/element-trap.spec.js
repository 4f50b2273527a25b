import { expect } from '@playwright/test';
import { NAMES, heard, ready, show, stateOf } from './element-support.js';
import { STILL, frames, pictureOf, test } from './support.js';

/** @typedef {import('./element-support.js').AnyElement} AnyElement */
/** @typedef {import('@playwright/test').Locator} Locator */

test.use(STILL);

/**
 * Makes the next call into the core touch memory that is not there.
 *
 * @param {Locator} widget
 */
function damage(widget) {
  return widget.evaluate((element) => {
    const { machine } = /** @type {AnyElement} */ (element);
    Object.assign(window, { damaged: machine });
    machine.__wbg_ptr = 0x7ffffff0;
  });
}

/** @param {Locator} widget */
function mended(widget) {
  return expect
    .poll(() => widget.evaluate((element) => {
      const { machine } = /** @type {AnyElement} */ (element);
      return machine !== undefined && machine !== Reflect.get(window, 'damaged');
    }))
    .toBe(true);
}

for (const name of NAMES) {
  const other = NAMES.find((each) => each !== name) ?? name;

  test(`a trap in ${name} is told, mended from its state and seed, and no other element notices`, async ({ page }) => {
    await show(page, `<${name}></${name}><div style="position: fixed; top: 0; width: 300px; opacity: 0.5"><${other} id="other"></${other}></div>`);
    const widget = page.locator(name).first();
    const neighbour = page.locator('#other');
    await ready(widget);
    await ready(neighbour);
    await neighbour.evaluate((element) => {
      element.parentElement?.style.setProperty('top', '5000px');
      Object.assign(window, { neighbour: /** @type {AnyElement} */ (element).machine });
    });
    await widget.locator('#v').fill('0.7');
    await widget.getByRole('button', { name: 'New seed' }).click();
    await frames(page);
    const before = await stateOf(widget);
    const picture = await pictureOf(widget.locator('canvas.plane'));
    await widget.evaluate((element) => void Object.assign(window, { posesBefore: /** @type {AnyElement} */ (element).poses }));

    const ways = /** @type {[string, () => Promise<unknown>][]} */ ([
      ['a pointer over the picture', () => widget.locator('canvas.plane').hover({ position: { x: 20, y: 20 } })],
      ['a button', () => widget.getByRole('button', { name: 'Step' }).dispatchEvent('click')],
      ['a slider', () => widget.locator('#dt').evaluate((slider) => slider.dispatchEvent(new Event('input', { bubbles: true, composed: true })))],
      ['a frame', () => widget.evaluate((element) => /** @type {any} */ (element).commit())],
      // At once: what goes on by itself, as the measuring of costs, may find the damage first and have it mended.
      [
        'a property',
        () =>
          widget.evaluate((element) => {
            const widget = /** @type {AnyElement} */ (element);
            Object.assign(window, { damaged: widget.machine });
            if (widget.machine) widget.machine.__wbg_ptr = 0x7ffffff0;
            widget.omega = 1;
          }),
      ],
      ['a question', () => widget.evaluate((element) => void (/** @type {AnyElement} */ (element).stats))],
    ]);
    for (const [way, go] of ways) {
      // Step has something to do where not all of the cloud is shown.
      await heard(page);
      if (way !== 'a property') await damage(widget);
      if (way === 'a button') await widget.evaluate((element) => void element.shadowRoot?.querySelectorAll('button').forEach((button) => (button.disabled = false)));
      await go();
      await mended(widget);
      const told = await heard(page);
      const errors = told.filter(({ name }) => name === 'error');
      expect(errors.map(({ target }) => target), way).toEqual([name]);
      expect(errors[0].message, way).toMatch(/memory access out of bounds|unreachable/);
      expect(told.some(({ name }) => name === 'load')).toBe(false);
      expect(await stateOf(widget), way).toEqual(before);
      // Compared on the page: they are many.
      const [count, different] = await widget.evaluate((element) => {
        const [before, now] = [Reflect.get(window, 'posesBefore'), /** @type {AnyElement} */ (element).poses ?? []];
        return [now.length - before.length, now.findIndex((/** @type {number} */ pose, /** @type {number} */ i) => !Object.is(pose, before[i]))];
      });
      expect([count, different], way).toEqual([0, -1]);
      await frames(page);
    }
    await page.mouse.move(0, 0);
    await widget.evaluate((element) => (/** @type {AnyElement} */ (element).marked = null));
    expect(await pictureOf(widget.locator('canvas.plane'))).toBe(picture);
    expect(await neighbour.evaluate((element) => /** @type {AnyElement} */ (element).machine === Reflect.get(window, 'neighbour'))).toBe(true);
    expect(/** @type {any} */ (await stateOf(neighbour)).widget).toBe(other);
    await widget.locator('#v').fill('0.4');
    expect(/** @type {any} */ (await stateOf(widget)).command.v).toBe(0.4);
  });
}

test('what is asked while a core is mended is the last good state, and nothing else fails', async ({ page }) => {
  await show(page, '<banana-machine></banana-machine><div style="height: 4000px"></div>');
  const widget = page.locator('banana-machine');
  await ready(widget);
  await heard(page);
  const asked = await widget.evaluate(async (element) => {
    const widget = /** @type {AnyElement} */ (element);
    const trap = () => {
      throw new WebAssembly.RuntimeError('unreachable');
    };
    const before = JSON.stringify(widget.getState());
    // In the middle of what takes several frames.
    Object.defineProperty(widget.machine, 'advance', { value: trap });
    /** @type {unknown[]} */
    const asked = [];
    widget.addEventListener('error', () => asked.push(widget.stats, widget.poses, JSON.stringify(widget.getState()) === before), { once: true });
    const slider = /** @type {HTMLInputElement} */ (element.shadowRoot?.querySelector('#v'));
    slider.value = '0.25';
    slider.dispatchEvent(new Event('input', { bubbles: true, composed: true }));
    for (let i = 0; i < 3; i++) await new Promise(requestAnimationFrame);
    return asked;
  });
  expect(asked).toEqual([null, null, true]);
  await mended(widget);
  // Out of sight, between a change of the page's and its telling.
  await page.evaluate(() => scrollTo(0, 4000));
  await frames(page);
  await widget.evaluate((element) => {
    const widget = /** @type {AnyElement} */ (element);
    Object.assign(window, { damaged: widget.machine });
    widget.v = 0.5;
    if (widget.machine) widget.machine.__wbg_ptr = 0x7ffffff0;
    return widget.stats;
  });
  await page.evaluate(() => scrollTo(0, 0));
  await mended(widget);
  expect((await heard(page, ['error'])).map(({ message }) => message)).toEqual(['unreachable', expect.stringMatching(/memory access out of bounds|unreachable/)]);
});

test('a core that traps again and again ends in a sentence, not in a loop', async ({ page }) => {
  await show(page, '<banana-machine></banana-machine>');
  const widget = page.locator('banana-machine');
  await ready(widget);
  await heard(page);
  await widget.evaluate((element) => {
    const widget = /** @type {any} */ (element);
    const { createMachine } = widget;
    widget.createMachine = (/** @type {unknown[]} */ ...given) => {
      const machine = createMachine.apply(widget, given);
      machine.__wbg_ptr = 0x7ffffff0;
      return machine;
    };
    widget.machine.__wbg_ptr = 0x7ffffff0;
    widget.commit();
  });
  await expect(widget.getByRole('alert')).toContainText('This interactive figure cannot run here.');
  const errors = (await heard(page, ['error'])).length;
  expect(errors).toBeGreaterThan(1);
  await frames(page);
  expect(await heard(page, ['error'])).toEqual([]);
});

for (const name of NAMES) {
  test(`what fails while ${name} is rendered is said at once`, async ({ page }) => {
    await show(page, `<${name}></${name}>`);
    const widget = page.locator(name);
    await ready(widget);
    await heard(page);
    const shown = await widget.evaluate(async (element) => {
      const widget = /** @type {any} */ (element);
      widget.content = () => {
        throw new TypeError('there is no such figure');
      };
      widget.requestUpdate();
      // The very update in which it fails: nothing else asks for another.
      await widget.updateComplete;
      return widget.shadowRoot.querySelector('[role=alert]')?.textContent;
    });
    expect(shown).toContain('there is no such figure');
    const errors = await heard(page, ['error']);
    expect(errors.map(({ message }) => message)).toEqual(['there is no such figure']);
  });
}
