import { expect } from '@playwright/test';
import axe from 'axe-core';

/**
 * Expects that axe finds no accessibility violation on a page.
 *
 * @param {import('@playwright/test').Page} page
 * @param {string} [pageState]
 * @param {string} [testedSelector]
 */
export async function expectAccessible(page, pageState, testedSelector = ':root') {
  // The Playwright wrapper of axe also checks iframes, which takes twice as long. The tested pages have no iframes.
  if (!(await page.evaluate(() => 'axe' in globalThis))) await page.evaluate(axe.source);
  const accessibilityViolations = await page.evaluate(async (testedSelector) => {
    const ruleTags = ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'];
    const { run } = /** @type {typeof axe} */ (Reflect.get(globalThis, 'axe'));
    const axeResults = await run(testedSelector, { runOnly: { type: 'tag', values: ruleTags }, resultTypes: ['violations'] });
    return axeResults.violations.map(({ id, nodes }) => [id, nodes.map(({ html }) => html)]);
  }, testedSelector);
  expect(accessibilityViolations, pageState).toEqual([]);
}
