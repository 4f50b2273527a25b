import { npmInstall, pinned } from './project.mjs';
import { files, program } from './serving.mjs';

/**
 * What the examples in Vite have in common: a page whose links lead to its own fragments.
 *
 * @param {string} example
 * @param {string} library
 * @returns {Pick<import('./project.mjs').Engine, 'versions' | 'install' | 'build' | 'servings' | 'pages' | 'go' | 'dark'>}
 */
export const inVite = (example, library) => ({
  versions: () => pinned(example, library, 'vite'),
  install: npmInstall,
  build: (_directory, { run }) => run('npm', ['run', 'build']),
  servings: [
    { name: 'production', serve: files('dist', '/book/') },
    { name: 'development', serve: program((port) => ['npm', ['run', 'dev', '--', '--port', port, '--strictPort']], '/book/') },
  ],
  pages: { first: '/#motion', second: '/#sensors' },
  go: (page, path) => page.locator(`nav a[href="${path.slice(1)}"]`).click(),
  dark: (page, on) => page.emulateMedia({ colorScheme: on ? 'dark' : 'light' }),
});
