import { expect } from '@playwright/test';
import { createRandomGenerator } from '../random.js';
import { expectAccessible } from './axe.js';
import { FIGURE_FACTS } from './figures.js';
import { NEW_PAGE_TAG, REDUCED_MOTION, waitForFrames, mountFigure, readProperty, showPage, readState, takeEvents, test, waitUntilReady } from './support.js';

/** @typedef {import('./support.js').AnyElement} AnyElement */
/** @typedef {import('@playwright/test').Locator} Locator */

test.use(REDUCED_MOTION);

/** Returns the link to the state of a figure. @param {Locator} widget */
const readShareLink = (widget) => widget.evaluate((element) => /** @type {AnyElement} */ (element).shareLink());

/** Returns the fragment of the link to a figure. @param {Locator} widget @returns {Promise<string>} */
const readLinkFragment = async (widget) => new URL(await readShareLink(widget)).hash;

const THREE_FIGURES_HTML = `<banana-machine share></banana-machine>
  <h2 id="what-to-try" style="margin-top: 3000px">What to try</h2>
  <banana-machine share id="second one"></banana-machine>
  <banana-machine></banana-machine>`;

test('a link with the states of two figures and an anchor in its fragment restores both figures', NEW_PAGE_TAG, async ({ page, context: browserContext }) => {
  await showPage(page, THREE_FIGURES_HTML, { urlFragment: '#what-to-try&theme=a%20b' });
  const [firstFigure, secondFigure, thirdFigure] = [0, 1, 2].map((i) => page.locator('banana-machine').nth(i));
  await firstFigure.scrollIntoViewIfNeeded();
  await waitUntilReady(firstFigure);
  const readHash = () => page.evaluate(() => location.hash);
  expect(await readHash()).toBe('#what-to-try&theme=a%20b');
  const historyLength = await page.evaluate(() => history.length);

  await firstFigure.getByRole('button', { name: 'Hard arc' }).click();
  await expect.poll(readHash).toMatch(/^#what-to-try&theme=a%20b&banana-machine\.1=[\w-]+$/);
  await secondFigure.scrollIntoViewIfNeeded();
  await waitUntilReady(secondFigure);
  await secondFigure.getByRole('button', { name: 'Pivot' }).click();
  await expect.poll(readHash).toMatch(/^#what-to-try&theme=a%20b&banana-machine\.1=[\w-]+&banana-machine:second%20one=[\w-]+$/);
  await thirdFigure.scrollIntoViewIfNeeded();
  await waitUntilReady(thirdFigure);
  const hashBefore = await readHash();
  await thirdFigure.getByRole('button', { name: 'Straight' }).click();
  await waitForFrames(page);
  expect(await readHash()).toBe(hashBefore);
  expect(await page.evaluate(() => history.length)).toBe(historyLength);

  const sharedLink = await readShareLink(firstFigure);
  // The fragment of the link begins with the state of the shared figure, because a page scrolls to the first figure of its fragment.
  const [pageAnchor, themePart, firstFigurePart, secondFigurePart] = hashBefore.slice(1).split('&');
  expect(new URL(sharedLink).hash).toBe(`#${[firstFigurePart, pageAnchor, themePart, secondFigurePart].join('&')}`);
  const newPage = await browserContext.newPage();
  await showPage(newPage, THREE_FIGURES_HTML, { urlFragment: new URL(sharedLink).hash });
  const [firstCopy, secondCopy, thirdCopy] = [0, 1, 2].map((i) => newPage.locator('banana-machine').nth(i));
  for (const [copiedFigure, originalFigure] of [[firstCopy, firstFigure], [secondCopy, secondFigure]]) {
    await copiedFigure.scrollIntoViewIfNeeded();
    await waitUntilReady(copiedFigure);
    expect(await readState(copiedFigure)).toEqual(await readState(originalFigure));
  }
  await thirdCopy.scrollIntoViewIfNeeded();
  await waitUntilReady(thirdCopy);
  expect(/** @type {any} */ (await readState(thirdCopy)).command).toEqual({ v: 1, omega: 0, dt: 2 });
  expect(await takeEvents(newPage, ['error', 'input', 'change'])).toEqual([]);
});

test('figures in open and closed shadow roots have their own parts in the fragment of the address @nightly', NEW_PAGE_TAG, async ({ page }) => {
  await page.addInitScript(() => {
    for (const [hostTag, shadowMode] of [['open-host', 'open'], ['closed-host', 'closed']]) {
      customElements.define(hostTag, class extends HTMLElement {
        figure = this.attachShadow({ mode: /** @type {ShadowRootMode} */ (shadowMode) }).appendChild(document.createElement('banana-machine'));
      });
    }
  });
  const shadowHostsHtml = '<open-host></open-host><open-host></open-host><closed-host id="c"></closed-host><banana-machine></banana-machine>';
  await showPage(page, shadowHostsHtml);
  await page.locator('body > banana-machine').scrollIntoViewIfNeeded();
  await waitUntilReady(page.locator('body > banana-machine'));
  const linkKeys = await page.evaluate(async () => {
    const shadowFigures = [...document.querySelectorAll('open-host, closed-host')].map((hostElement) => Reflect.get(hostElement, 'figure'));
    const figureElements = /** @type {AnyElement[]} */ ([...shadowFigures, document.querySelector('body > banana-machine')]);
    return Promise.all(figureElements.map(async (figureElement) => new URL(await figureElement.shareLink()).hash.slice(1).split('=')[0]));
  });
  expect(linkKeys).toEqual([
    'open-host.1/banana-machine.1', 'open-host.2/banana-machine.1', 'closed-host:c/banana-machine.1', 'banana-machine.1',
  ]);
});

test('a link scrolls once to the figure from which it was copied, and a reload does not scroll', NEW_PAGE_TAG, async ({ page, context: browserContext }) => {
  const spacerHtml = '<p style="margin: 2000px 0">Between</p>';
  const pageBody = `${spacerHtml}<banana-machine></banana-machine>${spacerHtml}<banana-machine></banana-machine>${spacerHtml}`;
  await showPage(page, pageBody);
  const nthFigureOf = (/** @type {import('@playwright/test').Page} */ openPage, /** @type {number} */ i) => openPage.locator('banana-machine').nth(i);
  const readFigureTops = (/** @type {import('@playwright/test').Page} */ openPage) =>
    openPage.locator('banana-machine').evaluateAll((figureElements) => figureElements.map((figureElement) => Math.round(figureElement.getBoundingClientRect().top)));
  const linkFragments = [];
  for (const i of [0, 1]) {
    await nthFigureOf(page, i).scrollIntoViewIfNeeded();
    await waitUntilReady(nthFigureOf(page, i));
    // The address already contains the state of the previous figure when the link to the next figure is copied.
    linkFragments.push(await readLinkFragment(nthFigureOf(page, i)));
    await page.evaluate((linkFragment) => history.replaceState(null, '', linkFragment), linkFragments[i]);
  }
  expect(linkFragments[1]).toMatch(/^#banana-machine\.2=.*&banana-machine\.1=/);
  // If the address already contains the state of a figure, a link to the figure contains that state only once.
  expect(await readLinkFragment(nthFigureOf(page, 1))).toBe(linkFragments[1]);
  for (const [i, urlFragment] of linkFragments.entries()) {
    const newPage = await browserContext.newPage();
    await showPage(newPage, pageBody, { urlFragment });
    await waitUntilReady(nthFigureOf(newPage, i));
    await expect.poll(async () => (await readFigureTops(newPage))[i]).toBeCloseTo(0);
    // The page does not scroll to elements that are added or moved later.
    const scrollYAfterMove = await newPage.evaluate(async () => {
      scrollTo(0, 100);
      document.body.append(document.createElement('banana-machine'));
      document.body.append(/** @type {Element} */ (document.querySelector('banana-machine')));
      await new Promise((resolve) => setTimeout(resolve));
      return scrollY;
    });
    expect(scrollYAfterMove).toBe(100);
    await newPage.close();
  }
  await page.evaluate(() => scrollTo(0, 0));
  await page.evaluate((linkFragment) => (location.hash = linkFragment), linkFragments[0]);
  await expect.poll(async () => (await readFigureTops(page))[0]).toBeCloseTo(0);
  await page.evaluate(() => scrollTo(0, 700));
  await page.reload();
  await expect(page.locator('banana-machine:defined')).toHaveCount(2);
  await waitForFrames(page);
  expect(await page.evaluate(() => scrollY)).toBe(700);
});

test('a broken link is reported, and the figure opens with the settings of its attributes', async ({ page }) => {
  for (const brokenState of ['nonsense!', 'q1YqSy0qzszPU7JSMtAzUKoFAA']) {
    await page.goto('about:blank');
    const widget = await mountFigure(page, 'banana-machine', { attributes: 'share v="0.5"', urlFragment: `#banana-machine.1=${brokenState}` });
    const errorEvents = await takeEvents(page, ['error']);
    expect(errorEvents.length, brokenState).toBe(1);
    expect(errorEvents[0].message).toMatch(/^state.*; allowed (is|are) /);
    expect(/** @type {any} */ (await readState(widget)).command.v).toBe(0.5);
  }
});

test('a page with a <base> element keeps its own address @nightly', async ({ page }) => {
  const widget = await mountFigure(page, 'map-squeeze', { attributes: 'share', headHtml: '<base href="/somewhere/else/">' });
  const readAddress = () => page.evaluate(() => location.href);
  await widget.getByRole('button', { name: 'Facing a wall' }).click();
  await expect.poll(readAddress).toMatch(/\/bare\.html#map-squeeze\.1=[\w-]+$/);
  // A later state in the address replaces the earlier state.
  const addressBefore = await readAddress();
  await widget.getByRole('button', { name: 'Open corridor' }).click();
  await expect.poll(readAddress).not.toBe(addressBefore);
  expect(await readAddress()).toMatch(/\/bare\.html#map-squeeze\.1=[\w-]+$/);
});

test('a figure without the attribute share adds nothing to the address, but opens a linked state and updates that part of the address', NEW_PAGE_TAG, async ({ page, context: browserContext, figureName }) => {
  const { sliderId, sliderValues, buttonLabel } = FIGURE_FACTS[figureName];
  const widget = await mountFigure(page, figureName, { urlFragment: '#elsewhere' });
  await widget.evaluate((element, [settingKey, settingValue]) => void Reflect.set(element, settingKey, settingValue), /** @type {const} */ ([sliderId, sliderValues[0]]));
  await widget.getByRole('button', { name: buttonLabel, exact: true }).click();
  await waitForFrames(page);
  expect(await page.evaluate(() => location.hash)).toBe('#elsewhere');
  const sharedLink = await readShareLink(widget);
  expect(sharedLink.split('#')[0]).toBe(page.url().split('#')[0]);
  const newPage = await browserContext.newPage();
  await showPage(newPage, `<${figureName}></${figureName}>`, { urlFragment: new URL(sharedLink).hash });
  await waitUntilReady(newPage.locator(figureName));
  const openedState = await readState(newPage.locator(figureName));
  expect(openedState).toEqual(await readState(widget));
  // From the first change on, the address contains the figure's state. No history entry is added: the "back" button leaves the page.
  const historyLength = await newPage.evaluate(() => history.length);
  await newPage.locator(figureName).locator(`#${sliderId}`).fill(String(sliderValues[1]));
  await expect.poll(async () => (await newPage.evaluate(() => location.hash)) === (await readLinkFragment(newPage.locator(figureName)))).toBe(true);
  expect(newPage.url()).not.toBe(sharedLink);
  expect(await newPage.evaluate(() => history.length)).toBe(historyLength);
  const changedState = await readState(newPage.locator(figureName));
  await newPage.reload();
  await waitUntilReady(newPage.locator(figureName));
  expect(await readState(newPage.locator(figureName))).toEqual(changedState);
});

test('a figure with the attribute share keeps its state in the address, and follows changes of the address', async ({ page, figureName }) => {
  const { sliderId, sliderValues, buttonLabel } = FIGURE_FACTS[figureName];
  await showPage(page, `<${figureName} share></${figureName}><p id="end">The end</p>`);
  const widget = page.locator(figureName);
  await waitUntilReady(widget);
  const readHash = () => page.evaluate(() => location.hash);
  await widget.locator(`#${sliderId}`).fill(String(sliderValues[0]));
  await expect.poll(readHash).toMatch(new RegExp(`^#${figureName}\\.1=[\\w-]+$`));
  const [previousHash, stateBefore] = [await readHash(), await readState(widget)];
  await widget.getByRole('button', { name: buttonLabel, exact: true }).click();
  await expect.poll(readHash).not.toBe(previousHash);
  expect(await readState(widget)).not.toEqual(stateBefore);
  await page.evaluate((urlFragment) => (location.hash = urlFragment), previousHash);
  await expect.poll(() => readState(widget)).toEqual(stateBefore);
  await page.evaluate(() => (location.hash = '#end'));
  await waitForFrames(page);
  expect(await page.evaluate(() => document.querySelector(':target')?.id)).toBe('end');
  expect(await readState(widget)).toEqual(stateBefore);
  expect(await takeEvents(page, ['error'])).toEqual([]);
  await page.evaluate((urlFragment) => (location.hash = urlFragment.slice(0, -9)), previousHash);
  await expect(widget.getByRole('alert')).toHaveText('This link cannot be read: it may be cut off. The figure stays as it was.');
  expect(await readState(widget)).toEqual(stateBefore);
  // A notice about long work hides the other notice until the work ends.
  await widget.evaluate((/** @type {any} */ element) => element.notice.showWork(() => 'long work', () => {}));
  await expect(widget.getByRole('alert')).toHaveText('long work');
  await widget.evaluate((/** @type {any} */ element) => element.notice.endWork());
  await expect(widget.getByRole('alert')).toHaveText(/^This link cannot be read/);
});

test.describe('the menu of a figure', () => {
  test.use({ permissions: ['clipboard-read', 'clipboard-write'] });

test('copies a link, and the code to embed with the address of the script', async ({ page }) => {
  const widget = await mountFigure(page, 'banana-machine');
  await widget.getByRole('button', { name: 'Pivot' }).click();
  await waitForFrames(page);
  const readClipboard = () => page.evaluate(() => navigator.clipboard.readText());
  await widget.getByRole('button', { name: 'Copy link' }).click();
  await expect(widget.getByText('Copied.')).toBeVisible();
  expect(await readClipboard()).toBe(await readShareLink(widget));
  await widget.getByText('Numbers and data').click();
  const embedButton = widget.getByRole('button', { name: 'Copy embed code' });
  await expect(embedButton).toHaveAttribute('title', 'HTML that shows the figure as it is now on a page of your own');
  await embedButton.click();
  await expect.poll(readClipboard).toContain('<banana-machine preset="pivot"></banana-machine>');
  const pageOrigin = new URL(page.url()).origin;
  expect(await readClipboard()).toContain(`<script type="module" src="${pageOrigin}/motion-widgets.js"></script>`);
  await widget.getByRole('button', { name: 'Start over' }).click();
  await expect(widget.getByText('Copied.')).toHaveCount(0);
});

  test('messages state that the code to embed omits the user’s map, and that a link omits a large map @nightly', async ({ page }) => {
    const widget = await mountFigure(page, 'map-squeeze');
    await widget.getByText('Numbers and data').click();
    await widget.getByRole('button', { name: 'Copy embed code' }).click();
    await expect(widget.getByText('Copied.')).toHaveText('Copied.');
    await widget.evaluate((element) => void Object.assign(element, { map: { bounds: [0, 0, 6, 4], walls: [[3, 0, 3, 1.5]] } }));
    await waitForFrames(page);
    await widget.getByRole('button', { name: 'Copy embed code' }).click();
    await expect(widget.getByText('Copied.')).toContainText('Your map is not in it');
    await widget.getByRole('button', { name: 'Copy link' }).click();
    await expect(widget.getByText('Copied.')).toHaveText('Copied.');
    const drawRandom = createRandomGenerator(1);
    // A map of random cells cannot be compressed, and is too long for a link.
    const [columnCount, rowCount] = [4000, 2000];
    const byteCount = (columnCount * rowCount) / 8;
    const floorPlan = { columns: columnCount, rows: rowCount, resolution: 0.05, origin: [0, 0, 0], occupied: Buffer.alloc(byteCount).toString('base64'), unknown: Buffer.from(Array.from({ length: byteCount }, () => 256 * drawRandom())).toString('base64') };
    await widget.evaluate((element, newMap) => void Object.assign(element, { map: newMap }), floorPlan);
    await widget.getByRole('button', { name: 'Copy link' }).click();
    await expect(widget.getByText('Copied.')).toContainText('Your map is too large for a link and is not in it');
    const [stateBefore, urlFragment] = [await readState(widget), await readLinkFragment(widget)];
    await page.goto('about:blank');
    const openedFigure = await mountFigure(page, 'map-squeeze', { attributes: 'seed="3"', urlFragment });
    expect(await readState(openedFigure)).toEqual({ ...stateBefore, map: null, start: await readProperty(await mountFigure(page, 'map-squeeze'), 'start') });
  });
});

test('the menu shows a link that the browser refuses to copy to the clipboard @nightly', async ({ page }) => {
  await page.addInitScript(() => Object.defineProperty(navigator, 'clipboard', { value: undefined }));
  // The window is high: in a lower window, the open disclosure would cover a part of the legend after the page has scrolled.
  await page.setViewportSize({ width: 1280, height: 1300 });
  const widget = await mountFigure(page, 'map-squeeze', { attributes: 'seed="4"' });
  await widget.getByText('Numbers and data').click();
  await widget.getByRole('button', { name: 'Copy embed code' }).click();
  await expect(widget.getByRole('textbox', { name: 'Copy manually' })).toHaveValue(/<map-squeeze seed="4"><\/map-squeeze>/);
  await expectAccessible(page, undefined, 'map-squeeze');
});

test('the code to embed names the script that defined the element', NEW_PAGE_TAG, async ({ page }) => {
  const widget = await mountFigure(page, 'map-squeeze', { scriptHtml: '<script defer src="/motion-widgets.iife.js"></script>' });
  const embedCode = await widget.evaluate((element) => /** @type {AnyElement} */ (element).embedCode());
  expect(embedCode).toContain(`<script defer src="${new URL(page.url()).origin}/motion-widgets.iife.js"></script>`);
});

test('the code to embed names the published script if other pages cannot load the script of this page @nightly', async ({ page }) => {
  await showPage(page, '', { scriptHtml: '' });
  const embedCode = await page.evaluate(async () => {
    const scriptBlob = new Blob([await (await fetch('/motion-widgets.js')).text()], { type: 'text/javascript' });
    await import(URL.createObjectURL(scriptBlob));
    return document.createElement('banana-machine').embedCode();
  });
  expect(embedCode).toBe('<script type="module" src="https://cdn.jsdelivr.net/npm/motion-widgets@0.1/dist/external.js"></script>\n<banana-machine></banana-machine>\n');
});

test('an iframe shows the figure in its address, and reports its height to the page', async ({ page, figureName }) => {
  await page.addInitScript(() => {
    Object.assign(window, { heights: [] });
    addEventListener('message', ({ data }) => data?.type === 'motion-widgets:height' && Reflect.get(window, 'heights').push(data.height));
  });
  const { sliderId, sliderValues: [sliderValue] } = FIGURE_FACTS[figureName];
  await showPage(page, `<iframe src="/embed.html?widget=${figureName}&${sliderId}=${sliderValue}" width="700" height="900"></iframe>`, { scriptHtml: '' });
  const widget = page.frameLocator('iframe').locator(figureName);
  await expect(widget.locator('.folds')).toBeVisible();
  expect(await readProperty(widget, sliderId)).toBe(sliderValue);
  await expect.poll(async () => {
    const [height, reportedHeight] = [await widget.evaluate(() => document.body.getBoundingClientRect().height), await page.evaluate(() => Reflect.get(window, 'heights').at(-1))];
    return Math.abs(height - reportedHeight);
  }).toBeLessThanOrEqual(1);
});
