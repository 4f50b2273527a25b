import { npmInstall, pinned } from './project.mjs';
import { files, program } from './serving.mjs';

/** @type {import('./project.mjs').Engine} */
export default {
  heading: 'Starlight',
  node: 22,
  versions: () => pinned('starlight', 'astro', '@astrojs/starlight'),
  install: npmInstall,
  build: (_directory, { run }) => run('npm', ['run', 'build']),
  servings: [
    { name: 'production', serve: files('dist', '/book/') },
    { name: 'development', serve: program((port) => ['npm', ['run', 'dev', '--', '--port', port]], '/book/') },
  ],
  pages: { first: '/motion/', second: '/sensors/' },
  go: (page, path) => page.locator(`.sidebar-content a[href$="${path}"]`).click(),
  wholePages: true,
  movesItself: true,
  dark: (page, on) => page.locator('header starlight-theme-select select').selectOption(on ? 'dark' : 'light'),
  allowed: [{ message: /^WebSocket connection .* failed: Page entered Back-Forward Cache/, reason: 'what Vite says of a page that was left, while developing' }],
  expected: [
    { selector: 'banana-machine >> nth=0', properties: { omega: 0.8, samples: 20000 } },
    { selector: 'banana-machine >> nth=1', properties: { omega: 0.3, samples: 5000 } },
    { selector: 'map-squeeze', properties: { samples: 1000 } },
  ],
};
