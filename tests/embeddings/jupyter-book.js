/** A book by Jupyter Book 1, which is Sphinx with a theme and settings of its own. */

import { copyScript, expected, follow, nextScheme, pythonInstall, pythonProgram } from './book.mjs';
import { pinned } from './project.mjs';
import { files } from './serving.mjs';

/** @type {import('./project.mjs').Engine} */
export default {
  heading: 'Jupyter Book',
  versions: () => pinned('jupyter-book', 'jupyter-book'),
  install: pythonInstall,
  async build(directory, { run }) {
    copyScript(directory, '_static');
    await run(pythonProgram(directory, 'jupyter-book'), ['build', '--warningiserror', '.']);
  },
  servings: [{ name: 'production', serve: files('_build/html', '/a/book/') }],
  pages: { first: 'outcomes.html', second: 'map.html' },
  go: follow,
  wholePages: true,
  dark: nextScheme('.theme-switch-button'),
  expected,
  allowed: [
    { message: /^Got invalid theme mode: \. Resetting to auto\.$/, reason: 'pydata_sphinx_theme says so to readers who have chosen none' },
    { message: /^SyntaxError: Identifier 'THEBE_JS_URL' has already been declared$/, reason: 'sphinx-thebe puts its script there twice' },
  ],
};
