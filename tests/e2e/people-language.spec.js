import { expect } from '@playwright/test';
import { de as sharedGerman } from '../../www/messages/de.js';
import { en as sharedEnglish } from '../../www/messages/en.js';
import { de as bananaGerman } from '../../www/widgets/banana-machine/de.js';
import { en as bananaEnglish } from '../../www/widgets/banana-machine/en.js';
import { de as squeezeGerman } from '../../www/widgets/map-squeeze/de.js';
import { en as squeezeEnglish } from '../../www/widgets/map-squeeze/en.js';
import { openSqueeze } from './squeeze-support.js';
import { STILL, frames, numberIn, open, readout, state, test, unfold } from './support.js';

const de = { ...sharedGerman, banana: bananaGerman, squeeze: squeezeGerman };
const en = { ...sharedEnglish, banana: bananaEnglish, squeeze: squeezeEnglish };

test.use(STILL);

/** Words that are the same in both languages, or a name. */
const SAME = ['PNG', 'SVG', 'CSV', 'Map Squeeze'];

/**
 * @param {any} catalogue
 * @param {string} [path]
 * @returns {[string, string | Function][]} the path of each message, and the message
 */
function messagesOf(catalogue, path = '') {
  return Object.entries(catalogue).flatMap(([key, message]) =>
    typeof message === 'object' ? messagesOf(message, `${path}.${key}`) : [[`${path}.${key}`, message]],
  );
}

/**
 * Everything of a widget that a reader sees or hears.
 *
 * @param {import('@playwright/test').Locator} widget
 */
function said(widget) {
  return widget.evaluate((element) => {
    const root = /** @type {ShadowRoot} */ (element.shadowRoot);
    const texts = [];
    const walker = document.createTreeWalker(root, NodeFilter.SHOW_ELEMENT | NodeFilter.SHOW_TEXT);
    while (walker.nextNode()) {
      const node = walker.currentNode;
      if (node instanceof Element) {
        for (const name of ['aria-label', 'aria-description', 'aria-valuetext', 'title', 'placeholder', 'data-room']) {
          texts.push(node.getAttribute(name) ?? '');
        }
      } else if (node.parentElement?.localName !== 'style' && node.parentElement?.localName !== 'textarea') {
        texts.push(node.textContent ?? '');
      }
    }
    // Italics and subscripts break a sentence into several texts, which are one here.
    const whole = [...root.querySelectorAll('p, li, dt, dd, th, td, caption, figcaption, legend, label')];
    texts.push(...whole.map((node) => node.textContent ?? ''));
    return texts.map((text) => text.replace(/\s+/g, ' ').trim()).filter(Boolean);
  });
}

/** @param {import('@playwright/test').Page} page */
async function german(page) {
  await page.addScriptTag({ type: 'module', url: '/de.js' });
  await page.evaluate(() => (document.documentElement.lang = 'de-AT'));
  await frames(page);
}

test('both catalogues have the same messages, with the same values in them', () => {
  const [english, german] = [messagesOf(en), messagesOf(de)];
  const shape = (/** @type {[string, string | Function][]} */ messages) =>
    messages.map(([path, message]) => [path, typeof message, typeof message === 'function' ? message.length : 0]);
  expect(shape(german)).toEqual(shape(english));
  expect(english.length).toBeGreaterThan(200);
  for (const [path, message] of german) {
    expect(String(typeof message === 'function' ? message('1', '2', '3', '4', '5') : message), path).not.toBe('');
  }
});

test('no English is left in a German widget, in any of its states', async ({ page }) => {
  const banana = await open(page);
  const squeeze = await openSqueeze(page);
  await unfold(banana);
  await unfold(squeeze);
  await german(page);
  const own = new Set(messagesOf(de).map(([, message]) => message));
  const english = messagesOf(en)
    .map(([, message]) => (typeof message === 'string' ? message : message(...'\ue001\ue002\ue003\ue004\ue005')))
    // What is around the values of a message is English too.
    .flatMap((message) => message.replace(/[*]/g, '').split(/[\ue001-\ue005]/))
    .map((part) => part.replace(/[₀-₉]/g, (/** @type {string} */ digit) => String(digit.charCodeAt(0) - 0x2080)).trim())
    .filter((part) => /\p{L}{4}/u.test(part) && !SAME.includes(part) && !own.has(part));
  expect(english.length).toBeGreaterThan(150);
  const check = async (/** @type {string} */ when) => {
    await frames(page);
    for (const widget of [banana, squeeze]) {
      const texts = await said(widget);
      expect(texts.length).toBeGreaterThan(60);
      const left = english.filter((part) =>
        texts.some((text) => text === part || (part.includes(' ') && text.includes(part))),
      );
      expect(left, when).toEqual([]);
    }
  };
  await check('as it opens');
  await banana.getByLabel(de.banana.isolate).check();
  await squeeze.getByLabel(de.squeeze.samplers['sub-stepped']).check();
  await banana.getByRole('spinbutton', { name: de.banana.robot }).fill('3');
  await squeeze.getByRole('spinbutton', { name: de.squeeze.sample }).fill('3');
  await check('with one α alone and the command in parts');
  await banana.getByRole('button', { name: de.banana.presets.straight }).click();
  await squeeze.getByLabel(de.squeeze.condition).uncheck();
  await squeeze.getByRole('button', { name: de.squeeze.own.use }).click();
  await expect(squeeze.locator('.present')).toContainText('Eingegebener Plan: 6,0 m × 4,0 m, 6 Wände');
  await check('with a robot that has no noise, without the condition, in a plan of the reader’s');
  await banana.getByLabel(de.banana.models.odometry).check();
  await squeeze.getByLabel(de.squeeze.own.files).setInputFiles({ name: 'room.txt', mimeType: 'text/plain', buffer: Buffer.from('') });
  await expect(squeeze.locator('.own-map .note')).toContainText('room.txt: Dateien dieser Art');
  await check('with odometry, and a file refused');
});

test('numbers are the language’s: a decimal comma, a true minus, as much as before', async ({ page }) => {
  const widget = await open(page);
  const skew = (await readout(widget, 'cross-track skew').textContent()) ?? '';
  await german(page);
  const schiefe = (await readout(widget, /[Qq]uer/).textContent()) ?? '';
  expect(schiefe).toBe(skew.replaceAll('.', ','));
  expect(schiefe).toMatch(/^−0,\d{3,4} ± 0,\d{3,4}$/);
  const { stats, config } = await state(widget);
  expect(numberIn(schiefe.split(' ± ')[0].replace(',', '.'))).toBeCloseTo(stats.crossTrackSkew, 3);
  await expect(widget.locator('#v')).toHaveAttribute('aria-valuetext', '1,00 m/s');
  expect(config.command.v).toBe(1);
});

test('the nearest lang decides, whenever it changes; a language without words is English', async ({ page }) => {
  const widget = await open(page);
  await page.addScriptTag({ type: 'module', url: '/de.js' });
  const play = (/** @type {string} */ name) => expect(widget.getByRole('button', { name, exact: true })).toBeVisible();
  await widget.evaluate((element) => element.setAttribute('lang', 'de'));
  await play('Abspielen');
  const other = page.locator('map-squeeze').first();
  await other.scrollIntoViewIfNeeded();
  await expect(other.getByRole('button', { name: 'Play' })).toBeVisible();
  await widget.evaluate((element) => element.setAttribute('lang', 'fr'));
  await play('Play');
  await expect(readout(widget, 'cross-track skew')).toHaveText(/^−0\.\d{3}/);
  await widget.evaluate((element) => {
    element.removeAttribute('lang');
    /** @type {HTMLElement} */ (element.parentElement).lang = 'de-not a tag';
  });
  await play('Abspielen');
  // What is said of a reading too.
  await unfold(widget);
  await widget.getByLabel(de.banana.isolate).check();
  await widget.getByRole('button', { name: de.banana.presets.straight }).click();
  const german = await widget.locator('.note').innerText();
  await widget.evaluate((element) => element.setAttribute('lang', 'en'));
  await expect(widget.locator('.note')).toContainText(' multiplies ');
  await widget.evaluate((element) => element.removeAttribute('lang'));
  await expect(widget.locator('.note')).toHaveText(german);
});

test('a catalogue of another shape is refused by name, and what is shorter does', async ({ page }) => {
  const widget = await open(page);
  const complaints = await page.evaluate(async () => {
    const url = new URL('/motion-widgets.js', location.href).href;
    const { setMessages } = await import(url);
    const rows = [['v² dans v̂', 'étale le nuage'], ['ω² dans v̂', 'aussi']];
    const given = [
      { alphaIsSilent: 'silence' },
      { alphaIsSilent: (/** @type {any} */ a, /** @type {any} */ b, /** @type {any} */ c, /** @type {any} */ d, /** @type {any} */ e) => `${a}${b}${c}${d}${e}` },
      { settings: { alphas: { effects: { velocity: rows } } } },
      { settings: { alphas: { effects: { velocity: [...rows, ...rows, ...rows] } } } },
      { settings: { alphas: { effects: 'x' } } },
      { settings: null },
      { readouts: { nominal: () => 'x' } },
      { readouts: { ellipse: 'x' } },
    ];
    return given.map((banana) => {
      try {
        setMessages('fr', { banana });
      } catch (error) {
        return String(error).replace('TypeError: messages: fr.banana.', '').replace(/one of .*/, 'one of');
      }
    });
  });
  expect(complaints).toEqual([
    'alphaIsSilent is a string; allowed is a function of 4 values.',
    'alphaIsSilent is a function of 5 values; allowed is a function of 4 values.',
    'settings.alphas.effects.velocity is a list of 2; allowed is a list of 6.',
    'settings.alphas.effects.velocity.0 is a list of 2; allowed is a list of 3.',
    'settings.alphas.effects is a string; allowed is a group.',
    'settings is null; allowed is a group.',
    'readouts.nominal is a function of 0 values; allowed is a string.',
    'readouts.ellipse is a string; allowed is one of',
  ]);
  // Of fewer values than there are: what is left out is not said.
  await page.evaluate(async () => {
    const url = new URL('/motion-widgets.js', location.href).href;
    const { setMessages } = await import(url);
    setMessages('fr', { banana: { alphaIsSilent: (/** @type {string} */ alpha) => `${alpha} se tait.`, bend: { right: () => 'À droite.' } } });
  });
  await widget.evaluate((element) => element.setAttribute('lang', 'fr'));
  await expect(widget.locator('.caption > span')).toHaveText('À droite.');
  await widget.getByRole('button', { name: 'Straight' }).click();
  await unfold(widget);
  await widget.getByLabel('Isolate one').check();
  await expect(widget.locator('.note')).toHaveText('α₄ se tait.');
  expect((await said(widget)).filter((text) => text.includes('undefined') && !text.endsWith('exact skew undefined'))).toEqual([]);
});

test('a page may replace words and add languages, and is told of a message that is none', async ({ page }) => {
  const widget = await open(page);
  await unfold(widget);
  const complaint = await page.evaluate(async () => {
    const url = new URL('/motion-widgets.js', location.href).href;
    const { setMessages } = await import(url);
    setMessages('fr', { play: 'Jouer', banana: { robot: 'Automate' } });
    setMessages('en', { pause: 'Hold' });
    try {
      setMessages('fr', { banana: { robots: 'x' } });
    } catch (error) {
      return String(error);
    }
  });
  expect(complaint).toMatch(/^TypeError: messages: fr\.banana\.robots is a string; allowed is one of title, /);
  await expect(widget.getByRole('button', { name: 'Play' })).toBeVisible();
  await widget.evaluate((element) => element.setAttribute('lang', 'fr'));
  await expect(widget.getByRole('button', { name: 'Jouer' })).toBeVisible();
  await expect(widget.getByRole('spinbutton', { name: 'Automate' })).toBeVisible();
  await expect(widget.getByRole('button', { name: 'Step' })).toBeVisible();
});

test('words for what is no language are refused', async ({ page }) => {
  await open(page);
  const complaints = await page.evaluate(async () => {
    const { setMessages } = await import(new URL('/motion-widgets.js', location.href).href);
    return ['de_AT', 'constructor', '__proto__', '', 'no tag', undefined, 3].map((lang) => {
      try {
        setMessages(lang, { play: 'Los' });
      } catch (error) {
        return String(error);
      }
    });
  });
  const refused = (/** @type {string | undefined} */ lang) => `RangeError: messages: lang is ${lang}; allowed is a BCP 47 tag, as "de" or "pt-BR".`;
  expect(complaints).toEqual(['"de_AT"', '"constructor"', '"__proto__"', '""', '"no tag"', 'undefined', '3'].map(refused));
  // What every object has is no message.
  const inherited = await page.evaluate(async () => {
    const { setMessages } = await import(new URL('/motion-widgets.js', location.href).href);
    return ['constructor', '__proto__'].map((key) => {
      try {
        setMessages('de', JSON.parse(`{ "exports": { "${key}": {} } }`));
      } catch (error) {
        return String(error).replace(/one of .*/, 'one of');
      }
    });
  });
  expect(inherited).toEqual(['constructor', '__proto__'].map((key) => `TypeError: messages: de.exports.${key} is a group; allowed is one of`));
});

test('what is no language kills no widget', async ({ page }) => {
  const widget = await open(page);
  for (const lang of ['constructor', 'CONSTRUCTOR', '__proto__', 'constructor-x', 'tostring', 'de_AT', '-', '']) {
    await widget.evaluate((element, given) => element.setAttribute('lang', given), lang);
    await widget.locator('#v').fill('0.4');
    await widget.getByRole('button', { name: 'Straight' }).click();
    await expect(widget.locator('.caption > span')).toContainText('The cloud');
    await expect(readout(widget, 'cross-track skew')).toHaveText(/^−?0[.]\d/);
    await expect(widget.getByRole('alert')).toHaveCount(0);
  }
});
