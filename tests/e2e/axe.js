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
  const values = ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'];
  const { violations } = await new AxeBuilder({ page })
    .include(where)
    .options({ runOnly: { type: 'tag', values }, resultTypes: ['violations'] })
    // Only pages with frames from elsewhere, which there are none of, need a second page for the results.
    .setLegacyMode()
    .analyze();
  expect(violations.map(({ id, nodes }) => [id, nodes.map(({ html }) => html)]), when).toEqual([]);
}
