import { npmInstall, pinned } from './project.mjs';
import { files, program } from './serving.mjs';

/** @type {import('./project.mjs').Engine} */
export default {
  heading: 'Vite',
  versions: () => pinned('vite', 'vite'),
  install: npmInstall,
  build: (_directory, { run }) => run('npm', ['run', 'build']),
  servings: [
    { name: 'production', serve: files('dist', '/book/') },
    { name: 'development', serve: program((port) => ['npm', ['run', 'dev', '--', '--port', port, '--strictPort']]) },
  ],
  pages: { first: '/' },
  expected: [{ selector: 'banana-machine', properties: { omega: 0.8, samples: 20000 } }],
};
