/** Book by Sphinx with a classic script. Every link of the book loads another document. */

import { join } from 'node:path';
import { copySingleFiles } from './plain.mjs';
import { pinnedVersionsOf, installPythonPackages, pythonProgramPathOf } from './project.mjs';
import { serveFiles } from './serving.mjs';

/**
 * Functions that switch a theme between light and dark, by the theme's name. One of the themes has no switch.
 * @type {Record<string, import('./project.mjs').Platform['setDarkMode']>}
 */
const DARK_SWITCH_OF_THEME = {
  async furo(page, isDark) {
    const activeThemeMark = page.locator(`[data-theme="${isDark ? 'dark' : 'light'}"]`);
    // The button cycles through light, dark, and the system's scheme.
    for (let i = 0; i < 3 && (await activeThemeMark.count()) === 0; i++) await page.locator('.theme-toggle').filter({ visible: true }).click();
  },
  async pydata_sphinx_theme(page, isDark) {
    await page.locator('.theme-switch-button').filter({ visible: true }).click();
    await page.locator(`.theme-change-button[data-mode="${isDark ? 'dark' : 'light'}"]`).filter({ visible: true }).click();
  },
  sphinx_rtd_theme: undefined,
};
const themeNames = Object.keys(DARK_SWITCH_OF_THEME);

/** @type {import('./project.mjs').Platform} */
export default {
  heading: 'Sphinx',
  readVersions: () => pinnedVersionsOf('sphinx', 'sphinx', ...themeNames.map((themeName) => themeName.replaceAll('_', '-'))),
  async installPackages(projectDirectory, exampleTools) {
    await installPythonPackages(projectDirectory, exampleTools, []);
  },
  async build(projectDirectory, { run: runInProject }) {
    copySingleFiles(join(projectDirectory, '_static'));
    for (const sphinxTheme of themeNames) {
      const sphinxArguments = ['--fail-on-warning', '--quiet', '--define', `html_theme=${sphinxTheme}`];
      await runInProject(pythonProgramPathOf(projectDirectory, 'sphinx-build'), [...sphinxArguments, '.', `_build/${sphinxTheme}`]);
    }
  },
  serverModes: themeNames.map((sphinxTheme) => ({ name: sphinxTheme, serve: serveFiles(`_build/${sphinxTheme}`, '/a/book/'), setDarkMode: DARK_SWITCH_OF_THEME[sphinxTheme] })),
  pages: { figuresPath: 'index.html', otherPath: 'map.html' },
  goToPage: (page, pagePath) => page.locator(`a[href$="${pagePath}"]`).filter({ visible: true }).first().click(),
  expectedFigures: [{ selector: 'banana-machine', properties: { omega: 0.8, samples: 20000 } }],
  allowedMessages: [{ messagePattern: /^Got invalid theme mode: \. Resetting to auto\.$/, reason: 'pydata_sphinx_theme warns readers who have chosen no mode.' }],
};
