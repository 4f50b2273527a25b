import { npmInstall, pinned } from './project.mjs';
import { files, program } from './serving.mjs';

/** @type {import('./project.mjs').Engine} */
export default {
  heading: 'Angular',
  versions: () => pinned('angular', '@angular/core', '@angular/build'),
  // Its command line refuses older ones.
  node: 24,
  install: npmInstall,
  build: (_directory, { run }) => run('npm', ['run', 'build']),
  servings: [
    { name: 'production', serve: files('dist/browser', '/book/') },
    { name: 'development', serve: program((port) => ['npm', ['run', 'dev', '--', '--port', port]]) },
  ],
  pages: { first: '/' },
  go: (page, which) => page.getByRole('button', { name: which === 'second' ? 'Sensors' : 'Motion' }).first().click(),
  expected: [{ selector: 'banana-machine', properties: { omega: 0.8, samples: 20000, alphas: [0.1, 0.05, 0.05, 0.1, 0.01, 0.01] } }],
  allowed: [
    { message: /\/vite-root\/motion\.wasm 404$/, reason: 'Its development server gives the module an address at which it has no file.' },
    { message: /^motion-widgets: the module embedded in a script is used\. .*\/vite-root\//, reason: 'The same: the figure is live without it.' },
  ],
};
