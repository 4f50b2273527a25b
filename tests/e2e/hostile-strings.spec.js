// Strings that are anybody's, wherever the figures take one: they are text, in the figure and in what is taken along.

import { expect } from '@playwright/test';
import { ALL, heard, ready, show } from './element-support.js';
import { STILL, frames, test, unfolded } from './support.js';

/** @typedef {import('./element-support.js').AnyElement} AnyElement */

test.use(STILL);

/** Markup would set `window.caught`. */
const MARKUP = [
  '<img src="x:" onerror="window.caught = 1">',
  '"><img src=x: onerror=window.caught=1>',
  "' onfocus='window.caught=1' autofocus='",
  '</textarea></title></desc><script>window.caught = 1</script>',
  '${window.caught = 1}',
  '*<b>*&lt;b&gt;&#60;b>',
];

const STRINGS = [
  ...MARKUP,
  '\u202egnp.pam\u2066\u200b\ufeff',
  '\ud800 half of a character \udc00',
  'two\r\nlines,"and",a comma\u2028and another',
  '__proto__',
  'constructor',
  'toString',
  'a'.repeat(1e6),
];

/**
 * Characters of a link at most: of the longest string deflate leaves a thousandth, in base64 a third more; and as much again for
 * the rest of the state.
 */
const LINK = (2 * 4 * 1e6) / 1000 / 3;

/** Characters of a sentence on a file at most: three quotations of 100 (maps/files.js), and words of its own. */
const SENTENCE = 3 * 100 + 400;

/** What no text makes: an element that is not of the figure. */
const FOREIGN = 'script, img, iframe, b, [onerror], [onfocus]';

/**
 * What there is of a figure that is not its text: elements and the names of their attributes.
 *
 * @param {import('@playwright/test').Locator} widget
 */
async function shapeOf(widget) {
  // What samplers cost is measured after every change.
  await expect(widget.locator('[aria-busy=true]')).toHaveCount(0);
  await frames(widget.page());
  return widget.evaluate((element, foreign) => {
    const root = /** @type {ShadowRoot} */ (element.shadowRoot);
    const { caught } = /** @type {any} */ (window);
    const names = [...root.querySelectorAll('*')].map((each) => [each.localName, ...each.getAttributeNames()].join(' '));
    return { caught, foreign: root.querySelectorAll(foreign).length, page: document.querySelectorAll('body *').length, names };
  }, FOREIGN);
}

test('a map of any name has the figure, the picture and the data of any other', async ({ page }) => {
  test.slow();
  await show(page, '<map-squeeze></map-squeeze>');
  const widget = page.locator('map-squeeze');
  await ready(widget);
  await widget.evaluate((element) => element.shadowRoot?.querySelectorAll('details').forEach((fold) => (fold.open = true)));
  await unfolded(widget);
  /** @param {string} name */
  const taken = async (name) => {
    await widget.evaluate((element, name) => {
      /** @type {any} */ (element).map = { name, bounds: [0, 0, 3, 3], walls: [[0, 0, 3, 3]] };
    }, name);
    await frames(page);
    const figure = await widget.evaluate(async (element, { name, longest }) => {
      const squeeze = /** @type {any} */ (element);
      const count = (/** @type {string} */ html) => new DOMParser().parseFromString(html, 'text/html').querySelectorAll('*').length;
      return {
        kept: squeeze.map.name === name && squeeze.getState().map.name === name,
        told: squeeze.shadowRoot.querySelector('.present').textContent.includes(name),
        svg: count(squeeze.toSVG()),
        lines: squeeze.toCSV().split(/[\r\n]/).length,
        code: count(squeeze.embedCode()),
        link: (await squeeze.shareLink()).length < longest,
      };
    }, { name, longest: LINK });
    return { ...figure, ...(await shapeOf(widget)) };
  };
  const plain = await taken('room');
  expect(plain).toMatchObject({ kept: true, told: true, link: true, foreign: 0, caught: undefined });
  for (const name of STRINGS) expect(await taken(name), name.slice(0, 40)).toEqual(plain);
});

test('a file of any name is refused in a sentence that quotes it', async ({ page }) => {
  test.slow();
  await show(page, '<map-squeeze></map-squeeze>');
  const widget = page.locator('map-squeeze');
  await ready(widget);
  await widget.locator('#map-fold summary').click();
  await expect(widget.locator('#map-fold')).toHaveAttribute('open');
  await unfolded(widget);
  /** @type {unknown} */
  let plain;
  for (const name of ['room', ...STRINGS]) {
    for (const ending of ['.txt', '.json', '.yaml']) {
      const sentence = await widget.evaluate(async (element, name) => {
        const root = /** @type {ShadowRoot} */ (element.shadowRoot);
        const dataTransfer = new DataTransfer();
        dataTransfer.items.add(new File(['image: other.png'], name));
        const note = /** @type {HTMLElement} */ (root.querySelector('.own-map .note'));
        const before = note.textContent;
        root.querySelector('section')?.dispatchEvent(new DragEvent('drop', { dataTransfer, bubbles: true, cancelable: true }));
        while (note.hidden || note.textContent === before) await new Promise(requestAnimationFrame);
        return note.textContent ?? '';
      }, name + ending);
      expect(sentence.startsWith(Buffer.from((name + ending).slice(0, 20)).toString()), sentence).toBe(true);
      expect(sentence).toMatch(/; (expected|a floor plan) (is|are) /);
      expect(sentence.length).toBeLessThan(SENTENCE);
    }
    const shape = await shapeOf(widget);
    plain ??= shape;
    expect(shape, name.slice(0, 40)).toEqual(plain);
  }
});

for (const tag of ALL) {
  test(`${tag} takes no attribute, state, link or word for markup`, async ({ page }) => {
    test.slow();
    await show(page, `<${tag}></${tag}>`);
    const widget = page.locator(tag);
    await ready(widget);
    const plain = await shapeOf(widget);
    const names = await widget.evaluate((element) => /** @type {any} */ (element.constructor).observedAttributes);
    expect(names.length).toBeGreaterThan(15);
    // Two quotations of 40 characters of two units (checks.js), the keys of a state or the names of attributes, and a few words.
    const keys = await widget.evaluate((element) => Object.keys(/** @type {AnyElement} */ (element).getState()));
    const longest = 2 * 2 * 40 + Math.max(keys.join(', ').length, names.join(', ').length) + 200;
    for (const text of STRINGS) {
      const refusals = await widget.evaluate(
        async (element, { names, text }) => {
          const figure = /** @type {AnyElement & Record<string, any>} */ (element);
          for (const name of names) {
            // The language of a page may be any.
            if (['lang', 'share', 'presentation', 'title', 'label'].includes(name)) continue;
            figure.setAttribute(name, text);
            figure.removeAttribute(name);
          }
          await figure.updateComplete;
          const messages = [];
          for (const state of [text, { [text]: 1 }, { widget: text }, { ...figure.getState(), seed: text }, { ...figure.getState(), [text]: text }]) {
            try {
              figure.setState(state);
            } catch (error) {
              messages.push(/** @type {Error} */ (error).message);
            }
          }
          location.hash = `${figure.localName}.1=${text.slice(0, 1e4)}`;
          return messages;
        },
        { names, text },
      );
      expect(refusals.length, text.slice(0, 40)).toBe(5);
      const errors = (await heard(page, ['error'])).map(({ message }) => message);
      for (const sentence of [...refusals, ...errors]) {
        expect(sentence).toMatch(/allowed (is|are) /);
        expect(sentence.length).toBeLessThan(longest);
      }
    }
    expect(await shapeOf(widget)).toEqual(plain);

    for (const text of MARKUP) {
      await widget.evaluate(async (element, text) => {
        const { setMessages } = await import(/** @type {string} */ ('/motion-widgets.js'));
        /** @type {(words: any) => any} */
        const said = (words) => {
          if (typeof words === 'string') return text;
          if (typeof words === 'function') return () => text;
          if (Array.isArray(words)) return words.map(said);
          return Object.fromEntries(Object.entries(words).map(([key, value]) => [key, said(value)]));
        };
        setMessages('xx', said(Reflect.get(globalThis, Symbol.for('motion-widgets.messages')).english));
        element.setAttribute('lang', 'xx');
        await /** @type {any} */ (element).updateComplete;
      }, text);
      await expect(widget).toContainText(text.replaceAll('*', ''));
      expect(await shapeOf(widget)).toMatchObject({ foreign: 0, caught: undefined });
    }
  });
}
