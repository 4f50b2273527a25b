/** A book by Sphinx with a classic script. Every link loads another document. */

import { join } from 'node:path';
import { copySingleFiles } from './plain.mjs';
import { pinnedVersions, pythonInstall, pythonProgram } from './project.mjs';
import { files } from './serving.mjs';

/** Themes with a switch between light and dark, and one without. @type {Record<string, import('./project.mjs').Engine['dark']>} */
const THEMES = {
  async furo(page, on) {
    const currentTheme = page.locator(`[data-theme="${on ? 'dark' : 'light'}"]`);
    // The button cycles through light, dark, and the system's scheme.
    for (let i = 0; i < 3 && (await currentTheme.count()) === 0; i++) await page.locator('.theme-toggle').filter({ visible: true }).click();
  },
  async pydata_sphinx_theme(page, on) {
    await page.locator('.theme-switch-button').filter({ visible: true }).click();
    await page.locator(`.theme-change-button[data-mode="${on ? 'dark' : 'light'}"]`).filter({ visible: true }).click();
  },
  sphinx_rtd_theme: undefined,
};
const themeNames = Object.keys(THEMES);

/** @type {import('./project.mjs').Engine} */
export default {
  heading: 'Sphinx',
  versions: () => pinnedVersions('sphinx', 'sphinx', ...themeNames.map((theme) => theme.replaceAll('_', '-'))),
  async install(directory, tools) {
    await pythonInstall(directory, tools, []);
  },
  async build(directory, { run }) {
    copySingleFiles(join(directory, '_static'));
    for (const theme of themeNames) {
      const options = ['--fail-on-warning', '--quiet', '--define', `html_theme=${theme}`];
      await run(pythonProgram(directory, 'sphinx-build'), [...options, '.', `_build/${theme}`]);
    }
  },
  servings: themeNames.map((theme) => ({ name: theme, serve: files(`_build/${theme}`, '/a/book/'), dark: THEMES[theme] })),
  pages: { first: 'index.html', second: 'map.html' },
  go: (page, path) => page.locator(`a[href$="${path}"]`).filter({ visible: true }).first().click(),
  expected: [{ selector: 'banana-machine', properties: { omega: 0.8, samples: 20000 } }],
  allowed: [{ message: /^Got invalid theme mode: \. Resetting to auto\.$/, reason: 'pydata_sphinx_theme warns readers who have chosen no mode.' }],
};
