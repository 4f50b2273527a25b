/** A book by Sphinx in each of its usual themes. */

import { copyScript, expected, follow, nextScheme, pythonInstall, pythonProgram, schemeFromList } from './book.mjs';
import { pinned } from './project.mjs';
import { files } from './serving.mjs';

const THEMES = ['furo', 'pydata_sphinx_theme', 'sphinx_book_theme', 'sphinx_rtd_theme', 'alabaster'];

/** Of those that have one. @type {Record<string, import('./project.mjs').Engine['dark']>} */
const SWITCHES = { furo: nextScheme('.theme-toggle'), pydata_sphinx_theme: schemeFromList, sphinx_book_theme: schemeFromList };

/** @type {import('./project.mjs').Engine} */
export default {
  heading: 'Sphinx',
  versions: () => pinned('sphinx', 'sphinx', ...THEMES.map((theme) => theme.replaceAll('_', '-'))),
  install: pythonInstall,
  async build(directory, { run }) {
    copyScript(directory, '_static');
    for (const theme of THEMES) {
      const options = ['--fail-on-warning', '--quiet', '--define', `html_theme=${theme}`];
      await run(pythonProgram(directory, 'sphinx-build'), [...options, '.', `_build/${theme}`]);
    }
  },
  servings: THEMES.map((theme) => ({ name: theme, serve: files(`_build/${theme}`, '/a/book/'), dark: SWITCHES[theme] })),
  pages: { first: 'index.html', second: 'map.html' },
  go: follow,
  wholePages: true,
  movesItself: true,
  expected,
  allowed: [{ message: /^Got invalid theme mode: \. Resetting to auto\.$/, reason: 'pydata_sphinx_theme says so to readers who have chosen none' }],
};
