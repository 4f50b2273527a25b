import { expect } from '@playwright/test';
import { STILL, frames, open, test, unfold } from './support.js';
import { openSqueeze } from './squeeze-support.js';

test.use(STILL);

/**
 * The names that the page documents.
 *
 * @param {import('@playwright/test').Page} page
 * @param {string} kind
 * @param {string} [of]
 */
async function documented(page, kind, of = 'both') {
  const names = await page.locator(`.api[data-of=${of}][data-kind=${kind}] th code`).allTextContents();
  return names.map((name) => name.replace(/\(.*/, '')).sort();
}

test('the page documents every attribute, method, part and custom property, and no other', async ({ page }) => {
  const squeeze = await openSqueeze(page);
  await unfold(page.locator('banana-machine').first());
  await unfold(squeeze);
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

test('its examples start when they are opened, and are what their code says', async ({ page }) => {
  await open(page);
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

test('in a window as wide as the column of a book, both figures of the page are at most 720 px high', async ({ page }) => {
  await page.setViewportSize({ width: 700, height: 720 });
  await page.goto('/');
  for (const name of ['banana-machine', 'map-squeeze']) {
    const widget = page.locator(name).first();
    await widget.scrollIntoViewIfNeeded();
    await expect(widget.locator('.folds')).toBeVisible();
    const { height } = await widget.evaluate((element) => element.getBoundingClientRect());
    expect(height, name).toBeLessThanOrEqual(720);
  }
});
