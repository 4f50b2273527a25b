import { expect } from '@playwright/test';
import { ALL_FIGURE_NAMES, FIGURE_FACTS } from './figures.js';
import { REDUCED_MOTION, readBananaResults, waitForFrames, mountFigure, parseNumberIn, openBanana, readPicture, readoutValueOf, showPage, test, testEach, openDisclosures, waitUntilReady, waitUntilSettled } from './support.js';

test.use(REDUCED_MOTION);

/** Names of figures that are the same in English and German. */
const UNTRANSLATED_NAMES = ['Map Squeeze', 'Arc Anatomy'];

/** Returns all messages of a language. @param {string} languageCode @returns {Promise<any>} */
async function loadCatalogue(languageCode) {
  const widgetCatalogues = ALL_FIGURE_NAMES.map(async (figureName) => (await import(`../../www/widgets/${figureName}/${languageCode}.js`))[languageCode]);
  return { ...(await import(`../../www/messages/${languageCode}.js`))[languageCode], ...(await Promise.all(widgetCatalogues)) };
}

/** Returns the path and the message of each entry of a catalogue. @param {any} messageCatalogue @param {string} [parentPath] @returns {[string, string | Function][]} */
function listMessages(messageCatalogue, parentPath = '') {
  return Object.entries(messageCatalogue).flatMap(([messageKey, messageOrGroup]) =>
    typeof messageOrGroup === 'object' ? listMessages(messageOrGroup, `${parentPath}.${messageKey}`) : [[`${parentPath}.${messageKey}`, messageOrGroup]],
  );
}

/** Returns all texts of a figure that a user sees or hears. @param {import('@playwright/test').Locator} widget */
function readVisibleTexts(widget) {
  return widget.evaluate((element) => {
    const shadowRoot = /** @type {ShadowRoot} */ (element.shadowRoot);
    const nodeTexts = [];
    const treeWalker = document.createTreeWalker(shadowRoot, NodeFilter.SHOW_ELEMENT | NodeFilter.SHOW_TEXT);
    while (treeWalker.nextNode()) {
      const textNode = treeWalker.currentNode;
      if (textNode instanceof Element) {
        for (const attributeName of ['aria-label', 'aria-description', 'aria-valuetext', 'title', 'placeholder', 'data-longest']) {
          nodeTexts.push(textNode.getAttribute(attributeName) ?? '');
        }
      } else if (textNode.parentElement?.localName !== 'style' && textNode.parentElement?.localName !== 'textarea') {
        nodeTexts.push(textNode.textContent ?? '');
      }
    }
    // Italics and subscripts split a sentence into several nodes.
    const textElements = [...shadowRoot.querySelectorAll('p, li, dt, dd, th, td, caption, figcaption, legend, label')];
    nodeTexts.push(...textElements.map((textElement) => textElement.textContent ?? ''));
    return nodeTexts.map((nodeText) => nodeText.replace(/\s+/g, ' ').trim()).filter(Boolean);
  });
}

test('the English and German catalogues have the same messages with the same parameters', async () => {
  const [englishMessages, germanMessages] = (await Promise.all(['en', 'de'].map(loadCatalogue))).map((catalogue) => listMessages(catalogue));
  const messageShapesOf = (/** @type {[string, string | Function][]} */ catalogueMessages) =>
    catalogueMessages.map(([messagePath, catalogueMessage]) => [messagePath, typeof catalogueMessage, typeof catalogueMessage === 'function' ? catalogueMessage.length : 0]);
  expect(messageShapesOf(germanMessages)).toEqual(messageShapesOf(englishMessages));
  expect(englishMessages.length).toBeGreaterThan(200);
});

testEach('a German figure contains no English text', async (page, figureName) => {
  const [englishCatalogue, germanCatalogue] = await Promise.all(['en', 'de'].map(loadCatalogue));
  const germanTexts = new Set(listMessages(germanCatalogue).map(([, catalogueMessage]) => catalogueMessage));
  const englishTexts = listMessages(englishCatalogue)
    .map(([, catalogueMessage]) => (typeof catalogueMessage === 'string' ? catalogueMessage : String(catalogueMessage(...'\ue001\ue002\ue003\ue004\ue005'))))
    // The values in a message split its text into parts. Each part is an English text too.
    .flatMap((catalogueMessage) => catalogueMessage.replace(/[*]/g, '').split(/[\ue001-\ue005]/))
    .map((messagePart) => messagePart.replace(/[₀-₉]/g, (/** @type {string} */ subscriptDigit) => String(subscriptDigit.charCodeAt(0) - 0x2080)).trim())
    .filter((messagePart) => /\p{L}{4}/u.test(messagePart) && !UNTRANSLATED_NAMES.includes(messagePart) && !germanTexts.has(messagePart));
  expect(englishTexts.length).toBeGreaterThan(400);
  await showPage(page, `<${figureName} lang="de-AT"></${figureName}>`, {
    scriptHtml: ['motion-widgets', 'de'].map((scriptName) => `<script type="module" src="/${scriptName}.js"></script>`).join(''),
  });
  const widget = page.locator(figureName);
  await waitUntilReady(widget);
  await openDisclosures(widget);
  const visibleTexts = await readVisibleTexts(widget);
  expect(visibleTexts.length).toBeGreaterThan(60);
  expect(englishTexts.filter((englishText) => visibleTexts.some((visibleText) => visibleText === englishText || (englishText.includes(' ') && visibleText.includes(englishText))))).toEqual([]);
});

test('the nearest lang attribute sets language and number format; unknown languages fall back to English', async ({ page }) => {
  const widget = await openBanana(page);
  await page.addScriptTag({ type: 'module', url: '/de.js' });
  const expectPlayButton = (/** @type {string} */ buttonName) => expect(widget.getByRole('button', { name: buttonName, exact: true })).toBeVisible();
  const englishSkew = (await readoutValueOf(widget, 'cross-track skew').textContent()) ?? '';
  await widget.evaluate((element) => element.setAttribute('lang', 'de'));
  await expectPlayButton('Stichproben ziehen');
  const germanSkew = (await readoutValueOf(widget, /[Qq]uer/).textContent()) ?? '';
  expect(germanSkew).toBe(englishSkew.replaceAll('.', ','));
  expect(germanSkew).toMatch(/^−0,\d{3,4} ± 0,\d{3,4}$/);
  expect(parseNumberIn(germanSkew.split(' ± ')[0].replace(',', '.'))).toBeCloseTo((await readBananaResults(widget)).stats.crossTrackSkew, 3);
  await expect(widget.locator('#v')).toHaveAttribute('aria-valuetext', '1,00 m/s');
  await widget.evaluate((element) => element.setAttribute('lang', 'fr'));
  await expectPlayButton('Draw samples');
  await expect(readoutValueOf(widget, 'cross-track skew')).toHaveText(/^−0\.\d{3}/);
  await widget.evaluate((element) => {
    element.removeAttribute('lang');
    /** @type {HTMLElement} */ (element.parentElement).lang = 'de-not a tag';
  });
  await expectPlayButton('Stichproben ziehen');
});

test('a page can replace messages and add languages; a text that is no language tag is refused', async ({ page }) => {
  const widget = await openBanana(page, 'preset="gentle"');
  await openDisclosures(widget);
  const refusalMessage = await page.evaluate(async () => {
    const { setMessages } = await import(new URL('/motion-widgets.js', location.href).href);
    setMessages('fr', { cloud: { drawLabel: 'Jouer' }, banana: { robot: 'Automate', skewSentences: { bent: () => 'À droite.' } } });
    setMessages('en', { pauseLabel: 'Hold' });
    setMessages('ar', { cloud: { drawLabel: 'عيّن' } });
    try {
      setMessages('de_AT', { playLabel: 'Los' });
    } catch (error) {
      return String(error);
    }
  });
  expect(refusalMessage).toBe('RangeError: messages: lang is "de_AT"; allowed is a BCP 47 tag, as "de" or "pt-BR".');
  await expect(widget.getByRole('button', { name: 'Draw samples' })).toBeVisible();
  await widget.evaluate((element) => element.setAttribute('lang', 'fr'));
  await expect(widget.getByRole('button', { name: 'Jouer' })).toBeVisible();
  await expect(widget.getByRole('spinbutton', { name: 'Automate' })).toBeVisible();
  await expect(widget.getByRole('button', { name: 'Step' })).toBeVisible();
  await expect(widget.locator('p[part=caption]')).toHaveText('À droite.');
  // Digits and decimal separators are the Latin ones in all languages.
  await widget.evaluate((element) => element.setAttribute('lang', 'ar-EG'));
  await expect(readoutValueOf(widget, 'cross-track skew')).toHaveText(/^−0\.\d{3}/);
});

test('on a right-to-left page a figure has the same picture, and nothing overflows the figure @nightly', async ({ page, figureName }) => {
  const widget = await mountFigure(page, figureName);
  const planeCanvas = widget.locator('canvas.plane');
  const pictureBefore = await readPicture(planeCanvas);
  await page.evaluate(() => void (document.documentElement.dir = 'rtl'));
  await widget.evaluate((element) => /** @type {any} */ (element).renderer.requestFrame());
  expect(await readPicture(planeCanvas)).toBe(pictureBefore);
  expect(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)).toBeLessThanOrEqual(0);
  const firstSlider = widget.locator('.slider input[type=range]').first();
  await firstSlider.press('Home');
  const valueBefore = Number(await firstSlider.inputValue());
  await firstSlider.press('ArrowUp');
  expect(Number(await firstSlider.inputValue())).toBeGreaterThan(valueBefore);
});

test('signs are left of their numbers on a right-to-left page, even within right-to-left text', async ({ page, figureName }) => {
  const headHtml = '<script type="module">import { setMessages } from "/motion-widgets.js"; setMessages("he", { playLabel: "נגן" })</script>';
  for (const [figureLanguage, textDirection, numberSelector] of [['en', 'ltr', '.simulation'], ['he', 'rtl', '.simulation :is(bdi, [dir=ltr])']]) {
    await showPage(page, `<div dir="rtl" lang="${figureLanguage}"><${figureName}><p slot="caption">נגן</p></${figureName}></div>`, { headHtml });
    const widget = page.locator(figureName);
    await waitUntilReady(widget);
    await openDisclosures(widget);
    const signTextsAndSides = await widget.evaluate(({ shadowRoot }, numberPart) => {
      const characterRange = new Range();
      const characterBoxOf = (/** @type {Text} */ textNode, /** @type {number} */ characterIndex) => {
        characterRange.setStart(textNode, characterIndex);
        characterRange.setEnd(textNode, characterIndex + 1);
        return characterRange.getBoundingClientRect();
      };
      return [.../** @type {ShadowRoot} */ (shadowRoot).querySelectorAll(numberPart)].flatMap((element) => {
        const treeWalker = document.createTreeWalker(element, NodeFilter.SHOW_TEXT);
        const signTexts = [];
        while (treeWalker.nextNode()) {
          const textNode = /** @type {Text} */ (treeWalker.currentNode);
          const signIndex = textNode.data.search(/\u2212\d/);
          if (signIndex >= 0 && textNode.parentElement?.checkVisibility()) signTexts.push([textNode.data, characterBoxOf(textNode, signIndex).right <= characterBoxOf(textNode, signIndex + 1).left + 0.5]);
        }
        return signTexts;
      });
    }, numberSelector);
    expect(signTextsAndSides.length).toBeGreaterThan(1);
    expect(signTextsAndSides.filter(([, isLeftOfNumber]) => !isLeftOfNumber)).toEqual([]);
    const readTextDirection = (/** @type {string} */ directedPart) => widget.locator(directedPart).evaluate((element) => getComputedStyle(element).direction);
    expect(await readTextDirection('.simulation')).toBe(textDirection);
    expect(await readTextDirection('[slot=caption]')).toBe('rtl');
  }
});

test('texts still change after a page translator has replaced every text node @nightly', async ({ page, figureName }) => {
  // A figure outside the viewport is not drawn. The two figures must therefore be visible.
  await page.setViewportSize({ width: 1280, height: 4000 });
  await showPage(page, `<${figureName} id="translated"></${figureName}><${figureName} id="other"></${figureName}>`);
  const [translatedFigure, otherFigure] = ['#translated', '#other'].map((figureSelector) => page.locator(figureSelector));
  const { sliderId, sliderValues } = FIGURE_FACTS[figureName];
  const readTexts = async () => {
    await waitForFrames(page);
    return Promise.all([translatedFigure, otherFigure].map((widget) => widget.locator('.simulation').evaluate((simulationElement) => simulationElement.textContent)));
  };
  for (const widget of [translatedFigure, otherFigure]) {
    await waitUntilReady(widget);
    await openDisclosures(widget);
  }
  await translatedFigure.evaluate(({ shadowRoot }) => {
    const treeWalker = document.createTreeWalker(/** @type {ShadowRoot} */ (shadowRoot), NodeFilter.SHOW_TEXT);
    const textNodes = /** @type {Text[]} */ ([]);
    while (treeWalker.nextNode()) textNodes.push(/** @type {Text} */ (treeWalker.currentNode));
    for (const textNode of textNodes) {
      const fontElement = document.createElement('font');
      fontElement.append(textNode.data);
      textNode.replaceWith(fontElement);
    }
  });
  for (const sliderValue of sliderValues) {
    const textsBefore = await readTexts();
    for (const widget of [translatedFigure, otherFigure]) await widget.locator(`#${sliderId}`).fill(String(sliderValue));
    for (const widget of [translatedFigure, otherFigure]) await waitUntilSettled(widget);
    const [translatedText, otherText] = await readTexts();
    expect(otherText).not.toBe(textsBefore[1]);
    expect(translatedText).toBe(otherText);
  }
});
