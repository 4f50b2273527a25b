import { npmInstall, pinned } from './project.mjs';
import { files, program } from './serving.mjs';

/** @type {import('./project.mjs').Engine} */
export default {
  heading: 'Vue',
  versions: () => pinned('vite-vue', 'vue', 'vite'),
  install: npmInstall,
  build: (_directory, { run }) => run('npm', ['run', 'build']),
  servings: [
    { name: 'production', serve: files('dist', '/book/') },
    { name: 'development', serve: program((port) => ['npm', ['run', 'dev', '--', '--port', port, '--strictPort']], '/book/') },
  ],
  pages: { first: '/#motion', second: '/#sensors' },
  go: (page, path) => page.locator(`nav a[href="${path.slice(1)}"]`).click(),
  dark: (page, on) => page.emulateMedia({ colorScheme: on ? 'dark' : 'light' }),
  expected: [
    { selector: 'banana-machine', properties: { omega: 0.8, samples: 20000, alphas: [0.1, 0.1, 0.1, 0.1, 0.01, 0.01] } },
    { selector: 'map-squeeze', properties: { samples: 1000 } },
  ],
};
