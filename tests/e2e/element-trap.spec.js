import { expect } from '@playwright/test';
import { ALL, CLOUDS, KNOWN, heard, ready, show, stateOf } from './element-support.js';
import { STILL, frames, pictureOf, test, unfold } from './support.js';

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

/** @param {any} state @param {string[]} path */
const within = (state, path) => path.reduce((value, key) => value[key], state);

for (const [i, name] of ALL.entries()) {
  const other = ALL[(i + 1) % ALL.length];
  const { slider, at, values, button } = KNOWN[name];
  const clouded = CLOUDS.some((each) => each === name);

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
    await unfold(widget);
    await widget.locator(`#${slider}`).fill(String(values[0]));
    await widget.getByRole('button', { name: button, exact: true }).click();
    await frames(page);
    const picture = await pictureOf(widget.locator('canvas.plane'));
    // For this nothing is computed anew.
    if (clouded) await widget.evaluate((element) => (/** @type {AnyElement} */ (element).marked = 3));
    const before = await stateOf(widget);
    await widget.evaluate((element) => void Object.assign(window, { posesBefore: /** @type {AnyElement} */ (element).poses ?? [] }));

    const ofClouds = /** @type {[string, () => Promise<unknown>][]} */ ([
      ['a pointer over the picture', () => widget.locator('canvas.plane').hover({ position: { x: 20, y: 20 } })],
      ['a button', () => widget.getByRole('button', { name: 'Step', exact: true }).dispatchEvent('click')],
    ]);
    const ways = /** @type {typeof ofClouds} */ ([
      ...(clouded ? ofClouds : []),
      ['a slider', () => widget.locator(`#${slider}`).evaluate((slider) => slider.dispatchEvent(new Event('input', { bubbles: true, composed: true })))],
      [
        'a slider that nobody asks about before the frame',
        () =>
          widget.locator(`#${slider}`).evaluate((input, tag) => {
            const element = /** @type {Element} */ (document.querySelector(tag));
            // What these tests note of an event asks the machine.
            element.addEventListener('input', (event) => event.stopPropagation(), { once: true });
            input.dispatchEvent(new Event('input', { bubbles: true, composed: true }));
          }, name),
      ],
      ['a frame', () => widget.evaluate((element) => /** @type {any} */ (element).gesture.commit())],
      // At once: what goes on by itself, as the measuring of costs, may find the damage first and have it mended.
      [
        'a property',
        () =>
          widget.evaluate((element, [name, value]) => {
            const widget = /** @type {AnyElement} */ (element);
            Object.assign(window, { damaged: widget.machine });
            if (widget.machine) widget.machine.__wbg_ptr = 0x7ffffff0;
            Reflect.set(widget, name, value);
          }, /** @type {const} */ ([slider, values[1]])),
      ],
      [
        'a question',
        () =>
          widget.evaluate((element) => {
            const widget = /** @type {AnyElement} */ (element);
            Object.assign(window, { damaged: widget.machine });
            if (widget.machine) widget.machine.__wbg_ptr = 0x7ffffff0;
            void widget.stats;
            // While it is mended, paper has what is shown.
            for (const name of ['beforeprint', 'afterprint']) dispatchEvent(new Event(name));
            // What the reader does then is lost.
            const key = { key: 'ArrowUp', bubbles: true, composed: true, cancelable: true };
            element.shadowRoot?.querySelectorAll('.handle').forEach((handle) => handle.dispatchEvent(new KeyboardEvent('keydown', key)));
          }),
      ],
    ]);
    for (const [way, go] of ways) {
      // Step has something to do where not all of the cloud is shown.
      await heard(page);
      if (!['a property', 'a question'].includes(way)) await damage(widget);
      if (way === 'a button') await widget.evaluate((element) => void element.shadowRoot?.querySelectorAll('button').forEach((button) => (button.disabled = false)));
      await go();
      await mended(widget);
      const told = await heard(page);
      const errors = told.filter(({ name }) => name === 'error');
      expect(errors.map(({ target }) => target), way).toEqual([name]);
      expect(errors[0].message, way).toMatch(/memory access out of bounds|unreachable/);
      expect(told.some(({ name }) => name === 'load')).toBe(false);
      if (way === 'a question') expect(told.map(({ name }) => name)).toEqual(['error']);
      expect(await stateOf(widget), way).toEqual(before);
      // It is not freed in its damaged memory when nothing refers to it any more.
      expect(await page.evaluate(() => Reflect.get(window, 'damaged').__wbg_ptr), way).toBe(0);
      // Compared on the page: they are many.
      const [count, different] = await widget.evaluate((element) => {
        const [before, now] = [Reflect.get(window, 'posesBefore'), /** @type {AnyElement} */ (element).poses ?? []];
        return [now.length - before.length, now.findIndex((/** @type {number} */ pose, /** @type {number} */ i) => !Object.is(pose, before[i]))];
      });
      expect([count, different], way).toEqual([0, -1]);
      await frames(page);
    }
    await page.mouse.move(0, 0);
    if (clouded) await widget.evaluate((element) => (/** @type {AnyElement} */ (element).marked = null));
    expect(await pictureOf(widget.locator('canvas.plane'))).toBe(picture);
    expect(await neighbour.evaluate((element) => /** @type {AnyElement} */ (element).machine === Reflect.get(window, 'neighbour'))).toBe(true);
    expect(/** @type {any} */ (await stateOf(neighbour)).widget).toBe(other);
    await widget.locator(`#${slider}`).fill(String(values[1]));
    expect(within(await stateOf(widget), at)).toBe(values[1]);
  });

  test(`${name} that traps while it leaves the page comes back as it was, and says so as ever`, async ({ page }) => {
    await show(page, `<${name}></${name}>`);
    const widget = page.locator(name);
    await ready(widget);
    await unfold(widget);
    await widget.locator(`#${slider}`).fill(String(values[0]));
    // What was drawn is what it comes back to.
    await frames(page);
    const before = await stateOf(widget);
    const told = await widget.evaluate(async (element, [name, value]) => {
      const told = /** @type {string[]} */ ([]);
      for (const name of ['error', 'load']) element.addEventListener(name, ({ type }) => told.push(type));
      const parent = /** @type {Element} */ (element.parentElement);
      const slider = /** @type {HTMLInputElement} */ (element.shadowRoot?.querySelector(`#${name}`));
      slider.value = String(value);
      slider.dispatchEvent(new Event('input', { bubbles: true, composed: true }));
      // It is out of the document when that takes effect.
      /** @type {AnyElement} */ (element).machine.__wbg_ptr = 0x7ffffff0;
      element.addEventListener('error', (event) => event.preventDefault());
      element.remove();
      await new Promise(requestAnimationFrame);
      const again = new Promise((resolve) => element.addEventListener('load', resolve));
      parent.append(element);
      await again;
      return told;
    }, /** @type {const} */ ([slider, values[1]]));
    expect(told).toEqual(['error', 'load']);
    expect(await stateOf(widget)).toEqual(before);
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
    widget.gesture.commit();
  });
  await expect(widget.getByRole('alert')).toContainText('This interactive figure cannot run here.');
  expect(await heard(page, ['error'])).toHaveLength(2);
  await frames(page);
  expect(await heard(page, ['error'])).toEqual([]);
});

test('a core that traps at what the page sets ends in a sentence, though the page sets it anew each time', async ({ page }) => {
  await show(page, '<banana-machine></banana-machine>');
  const widget = page.locator('banana-machine');
  await ready(widget);
  await heard(page);
  await widget.evaluate((element) => {
    const widget = /** @type {any} */ (element);
    const { createMachine } = widget;
    const trapping = (/** @type {object} */ machine) =>
      Object.assign(machine, {
        begin() {
          throw new WebAssembly.RuntimeError('unreachable');
        },
      });
    widget.createMachine = (/** @type {unknown[]} */ ...given) => trapping(createMachine.apply(widget, given));
    trapping(widget.machine);
    widget.addEventListener('error', () => (widget.v = 0.5));
    widget.v = 0.5;
  });
  await expect(widget.getByRole('alert')).toContainText('This interactive figure cannot run here.');
  // Three that were mended, and the last.
  expect(await heard(page, ['error'])).toHaveLength(4);
});

test('a figure whose first core traps before anything was shown says all the same when it is ready, and once', async ({ page }) => {
  await show(page, '');
  await page.evaluate(() => {
    const element = /** @type {any} */ (document.createElement('banana-machine'));
    element.omega = 1.25;
    element.addEventListener('load', () => (element.title = `${element.machine !== undefined}`));
    const { createMachine } = element;
    element.createMachine = (/** @type {unknown[]} */ ...given) => {
      const machine = createMachine.apply(element, given);
      element.createMachine = createMachine;
      machine.begin = () => { throw new WebAssembly.RuntimeError('unreachable'); };
      return machine;
    };
    document.body.append(element);
  });
  const widget = page.locator('banana-machine');
  const told = () => heard(page).then((all) => all.map(({ name }) => name));
  await ready(widget);
  await expect(widget.locator('canvas.plane')).toBeVisible();
  expect(await told()).toEqual(['error', 'load']);
  await expect(widget).toHaveAttribute('title', 'true');
  // One that has been shown is not ready anew.
  await damage(widget);
  await widget.evaluate((element) => /** @type {any} */ (element).gesture.commit());
  await mended(widget);
  expect(await told()).toEqual(['error']);
});

for (const name of ALL) {
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

for (const name of ALL) {
  const { canvases, folded, group } = KNOWN[name];
  /** @param {import('@playwright/test').Page} page */
  const unfolded = async (page) => {
    await show(page, `<${name}></${name}>`);
    const widget = page.locator(name);
    await ready(widget);
    await unfold(widget);
    await heard(page);
    return widget;
  };

  const others = ['new TypeError("of the page")', '"of the page"', 'Object.create(null)', 'Symbol("of the page")'];
  for (const thrown of folded ? ['new Error("of the page")', ...(name === ALL[0] ? others : [])] : []) {
    test(`${name} ends in the sentence where a message of the page throws ${thrown} in a fold, and once`, async ({ page }) => {
      const widget = await unfolded(page);
      await page.evaluate(
        async ([vocabulary, group, key, code]) => {
          const { setMessages } = await import(new URL('/motion-widgets.js', location.href).href);
          setMessages('en', { [vocabulary]: { [group]: { [key]: new Function(`throw ${code}`) } } });
        },
        [...(folded ?? []), thrown],
      );
      await expect(widget.getByRole('alert')).toContainText('This interactive figure cannot run here.');
      await expect(widget.getByRole('alert')).toContainText(/^(Object|Symbol)/.test(thrown) ? /object|symbol/ : 'of the page');
      expect((await heard(page, ['error'])).length).toBe(1);
    });
  }

  test(`${name} says the sentence in English where the page's own words for it throw`, async ({ page }) => {
    const widget = await unfolded(page);
    await widget.evaluate(async (element) => {
      const { setMessages } = await import(new URL('/motion-widgets.js', location.href).href);
      setMessages('fr', { failure: () => { throw new Error('of the page'); } });
      element.setAttribute('lang', 'fr');
      const widget = /** @type {any} */ (element);
      widget.content = () => { throw new Error('no such figure'); };
      widget.requestUpdate();
    });
    await expect(widget.getByRole('alert')).toHaveText('This interactive figure cannot run here. no such figure');
  });

  test(`${name} is mended after a trap in a fold`, async ({ page }) => {
    const widget = await unfolded(page);
    const before = await stateOf(widget);
    await widget.evaluate((element) => {
      const widget = /** @type {any} */ (element);
      const { content } = widget;
      Object.assign(window, { damaged: widget.machine });
      widget.content = (/** @type {unknown} */ reading) => {
        widget.content = content;
        // Lit asks a list for what is in it when all else is done.
        return [content.call(widget, reading), { [Symbol.iterator]() { throw new WebAssembly.RuntimeError('unreachable'); } }];
      };
      widget.requestUpdate();
    });
    await mended(widget);
    await frames(page);
    expect(await stateOf(widget)).toEqual(before);
    await expect(widget.getByRole('alert')).toHaveCount(0);
    expect((await heard(page)).map(({ message }) => message)).toEqual(['unreachable']);
    await expect(widget.locator('canvas')).toHaveCount(canvases);
  });

  test(`${name} hears of an update that is asked for while there is one`, async ({ page }) => {
    const widget = await unfolded(page);
    const rendered = await widget.evaluate(async (element) => {
      const widget = /** @type {any} */ (element);
      const { content } = widget;
      let count = 0;
      widget.content = (/** @type {unknown} */ reading) => {
        if (++count === 1) widget.requestUpdate();
        return content.call(widget, reading);
      };
      widget.requestUpdate();
      // All of that is before anything else of the page has its turn, which might ask for an update too.
      for (let i = 0; i < 10; i++) await widget.updateComplete;
      return count;
    });
    expect(rendered).toBe(2);
  });

  test(`${name} hands the page's own error back, and takes it for no trap`, async ({ page }) => {
    await show(page, `<${name}></${name}>`);
    const widget = page.locator(name);
    await ready(widget);
    await heard(page);
    const [before, after, thrown, kept] = await widget.evaluate((element, [group, field]) => {
      const widget = /** @type {AnyElement} */ (element);
      const { machine } = widget;
      const before = widget.getState();
      const own = new Error('of the page');
      const states = [
        { widget: element.localName, version: 1, get [group]() { throw own; } },
        { get widget() { throw own; }, version: 1 },
        ...(field ? [{ widget: element.localName, version: 1, [group]: { ...before?.[group], get [field]() { throw own; } } }] : []),
      ];
      const thrown = states.map((state) => {
        try {
          widget.setState(/** @type {any} */ (state));
        } catch (error) {
          return error === own || String(error);
        }
      });
      return [before, widget.getState(), thrown, widget.machine === machine];
    }, group);
    const inGroup = group.length > 1 ? [`TypeError: ${group.join('.')} is a property that throws; allowed is a plain value`] : [];
    expect(thrown).toEqual([true, true, ...inGroup]);
    expect(after).toEqual(before);
    expect(kept).toBe(true);
    expect(await heard(page)).toEqual([]);
    // Nobody else hears of what was given before the figure was there.
    const early = await page.evaluate(async ([tag, group]) => {
      const element = /** @type {AnyElement} */ (/** @type {unknown} */ (document.createElement(tag)));
      const told = /** @type {string[]} */ ([]);
      element.addEventListener('error', (event) => told.push(/** @type {ErrorEvent} */ (event).message));
      element.setState(/** @type {any} */ ({ widget: tag, version: 1, get [group]() { throw new Error('of the page'); } }));
      document.body.prepend(element);
      await new Promise((resolve) => element.addEventListener('load', resolve));
      return told;
    }, [name, ...group]);
    expect(early).toEqual(['of the page']);
  });
}

test('a figure whose frame fails keeps no other from its own', async ({ page }) => {
  await show(page, '<banana-machine></banana-machine><map-squeeze></map-squeeze>');
  const [failing, other] = ['banana-machine', 'map-squeeze'].map((name) => page.locator(name));
  await ready(failing);
  await other.scrollIntoViewIfNeeded();
  await ready(other);
  const told = await failing.evaluate(async (element) => {
    const told = /** @type {string[]} */ ([]);
    window.reportError = (error) => void told.push(error.message);
    const { stage } = /** @type {any} */ (element);
    stage.frame = () => { throw new Error('in a frame'); };
    stage.inSight = true;
    stage.wake();
    for (let i = 0; i < 3; i++) await new Promise(requestAnimationFrame);
    return told;
  });
  expect(told).toEqual(['in a frame']);
  await other.evaluate((element) => void (/** @type {AnyElement} */ (element).omega = 1.25));
  await expect(other.locator('#omega')).toHaveAttribute('aria-valuetext', '1.25 rad/s');
});
