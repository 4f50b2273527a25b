import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { installNpmPackages, pinnedVersionsOf } from './project.mjs';
import { serveFiles, serveByProgram } from './serving.mjs';

/** Returns a function that serves a site by the server of Next. @param {string} nextCommand @param {string[]} nextArguments */
const serveWithNext = (nextCommand, ...nextArguments) => serveByProgram((port) => ['npx', ['next', nextCommand, '--port', port, ...nextArguments]]);

/** @type {import('./project.mjs').Platform} */
export default {
  heading: 'Next',
  readVersions: () => pinnedVersionsOf('next', 'next', 'react'),
  installPackages: installNpmPackages,
  build: (_directory, { run: runInProject }) => runInProject('npm', ['run', 'build']),
  serverModes: [
    { name: 'production', serve: serveWithNext('start') },
    { name: 'development', serve: serveWithNext('dev') },
    {
      name: 'static export',
      async serve(projectDirectory, exampleTools) {
        // A static export cannot contain partially prerendered pages, which the configuration of the example enables. Trailing slashes suit
        // any file server.
        writeFileSync(join(projectDirectory, 'next.config.ts'), "export default { output: 'export', basePath: '/book', trailingSlash: true };\n");
        await exampleTools.run('npm', ['run', 'build']);
        return serveFiles('out', '/book/')(projectDirectory, exampleTools);
      },
    },
  ],
  pages: { figuresPath: '/', otherPath: '/sensors' },
  goToPage: (page, pagePath) => page.getByRole('link', { name: pagePath === '/' ? 'Motion' : 'Sensors' }).click(),
  setDarkMode: (page, isDark) => page.emulateMedia({ colorScheme: isDark ? 'dark' : 'light' }),
  // After the user has left a page, Next.js keeps the page in the DOM and hides it. For that reason the selectors contain `:visible`.
  expectedFigures: [
    { selector: 'main:visible banana-machine >> nth=0', properties: { omega: 0.8, samples: 20000, alphas: [0.1, 0.05, 0.05, 0.1, 0.01, 0.01] } },
    { selector: 'main:visible banana-machine >> nth=1', properties: { omega: 0, alphas: [0.1, 0.1, 0.1, 0.1, 0, 0] } },
    { selector: 'main:visible map-squeeze', properties: { noise: 0.2, start: { x: 2.05, y: 2.6, theta: 1.5 } } },
  ],
};
