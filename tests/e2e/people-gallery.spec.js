import { expect, test as plain } from '@playwright/test';
import { NAMES } from './figures.js';
import { STILL, frames, property, ready, test, unfold } from './support.js';

test.use(STILL);

/** Opens the gallery, with its two figures running. @param {import('@playwright/test').Page} page */
async function openGallery(page) {
  await page.goto('/');
  const figures = NAMES.map((name) => page.locator(name).first());
  for (const figure of figures) {
    await figure.scrollIntoViewIfNeeded();
    await ready(figure);
    await expect(figure.locator('.folds')).toBeVisible();
  }
  return figures;
}

/**
 * Returns the names that the gallery documents.
 *
 * @param {import('@playwright/test').Page} page
 * @param {string} kind
 * @param {string} [of]
 */
async function documented(page, kind, of = 'both') {
  const names = await page.locator(`.api[data-of=${of}][data-kind=${kind}] th code`).allTextContents();
  return names.map((name) => name.replace(/\(.*/, '')).sort();
}

test('the gallery documents every attribute, method, part and custom property, and no other', async ({ page }) => {
  for (const figure of await openGallery(page)) await unfold(figure);
  await expect(page.getByRole('heading', { level: 1 })).toHaveText('The Banana Machine');
  for (const name of ['banana-machine', 'map-squeeze']) {
    const observed = await page.evaluate((tag) => Reflect.get(customElements.get(tag) ?? {}, 'observedAttributes'), name);
    // HTML has them in lower case.
    expect((await documented(page, 'attribute', name)).map((each) => each.toLowerCase()).sort()).toEqual([...observed].sort());
    const missing = await page.locator(name).first().evaluate(
      (element, methods) => methods.filter((method) => typeof Reflect.get(element, method) !== 'function'),
      await documented(page, 'method'),
    );
    expect(missing).toEqual([]);
  }
  const [parts, properties] = await page.evaluate(() => {
    const roots = [...document.querySelectorAll('banana-machine, map-squeeze')].map((element) => element.shadowRoot);
    const parts = roots.flatMap((root) => [...(root?.querySelectorAll('[part]') ?? [])].map((each) => each.getAttribute('part')));
    const styles = roots.flatMap((root) => (root?.adoptedStyleSheets ?? []).flatMap((sheet) => [...sheet.cssRules].map(({ cssText }) => cssText)));
    return [[...new Set(parts)].sort(), [...new Set(styles.join('').match(/--motion-[a-z-]+/g))].sort()];
  });
  // The progress is there while there is some.
  expect(await documented(page, 'part')).toEqual([...parts, 'progress'].sort());
  expect(await documented(page, 'property')).toEqual(properties);
});

test('examples of the gallery start when they are opened, and are what their code says', async ({ page }) => {
  await openGallery(page);
  const examples = page.locator('.example');
  await expect(examples).toHaveCount(5);
  for (const example of await examples.all()) {
    const element = example.locator('banana-machine, map-squeeze');
    expect(await element.evaluate((each) => Reflect.get(each, 'machine') === undefined)).toBe(true);
    await example.locator('summary').first().click();
    await element.locator('canvas').first().scrollIntoViewIfNeeded();
    await expect(element.locator('.cloud button').first()).toBeVisible();
    await frames(page);
    const code = (await example.locator('code').first().textContent()) ?? '';
    const [settings, given] = await element.evaluate((each) => [
      Reflect.get(each, 'machine').config,
      Object.fromEntries([...each.attributes].map(({ name, value }) => [name, value])),
    ]);
    for (const [name, value] of Object.entries(given)) expect(code).toContain(`${name}="${value}"`);
    if ('samples' in given) expect(settings.samples).toBe(Number(given.samples));
    if ('isolate' in given) expect(settings.isolate).toBe(Number(given.isolate));
    if ('sampler' in given) expect(settings.sampler).toBe(given.sampler);
    if (given.lang === 'de') await expect(element.getByRole('button', { name: 'Abspielen' })).toBeVisible();
    await example.locator('summary').first().click();
  }
});

test('both figures of the gallery are at most 720 px high in the column of a book', async ({ page }) => {
  await page.setViewportSize({ width: 700, height: 720 });
  for (const figure of await openGallery(page)) {
    const { height } = await figure.evaluate((element) => element.getBoundingClientRect());
    expect(height).toBeLessThanOrEqual(720);
  }
});

test('two figures of a kind on a page share nothing', async ({ page }) => {
  const [first] = await openGallery(page);
  await page.evaluate(() => document.querySelector('main')?.append(document.createElement('banana-machine')));
  const second = page.locator('banana-machine').last();
  await second.scrollIntoViewIfNeeded();
  await second.getByRole('button', { name: 'Pivot' }).click();
  await frames(page);
  expect([await property(second, 'omega'), await property(first, 'omega')]).toEqual([1.5, 0.5]);
});

plain('the gallery says what is missing without JavaScript', async ({ browser, baseURL }) => {
  const context = await browser.newContext({ javaScriptEnabled: false, baseURL });
  const page = await context.newPage();
  await page.goto('/');
  await expect(page.getByText('needs a browser with JavaScript and WebAssembly')).toBeVisible();
  await context.close();
});
