import AxeBuilder from '@axe-core/playwright';
import { expect } from '@playwright/test';

/**
 * Expects that axe finds nothing to complain of on a page.
 *
 * @param {import('@playwright/test').Page} page
 * @param {string} [when]
 * @param {string} [where] a selector
 */
export async function expectAccessible(page, when, where = ':root') {
  const { violations } = await new AxeBuilder({ page })
    .include(where)
    .withTags(['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'])
    .analyze();
  expect(violations.map(({ id, nodes }) => [id, nodes.map(({ html }) => html)]), when).toEqual([]);
}
