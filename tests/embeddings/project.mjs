/**
 * Packs the npm and Python packages, and copies each example to a directory outside of this repository, so that nothing of
 * it can be imported by accident. The copies and the packages installed in them are kept between runs.
 *
 * @module
 */

import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { cpSync, existsSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { basename, delimiter, join } from 'node:path';
import { ROOT, mustRun, runOnce, printStep } from '../../scripts/process.mjs';
import { startProgram } from './serving.mjs';
import { CACHE_DIRECTORY } from '../../scripts/toolchain.mjs';

/**
 * Description of an engine: the default export of a file in this folder.
 *
 * @typedef {object} Engine
 * @property {string} heading of its section in doc/embedding/, and its name in the table of doc/embedding.md
 * @property {() => string} versions of its packages, as the files of the example pin them
 * @property {boolean} [python] true if it uses the Python package
 * @property {number} [node] major version of Node that it needs, if newer than that of our package
 * @property {(directory: string, tools: Tools & PackagePaths) => Promise<unknown>} install installs the packages in a fresh copy of the example
 * @property {(directory: string, tools: Tools) => Promise<unknown>} [build]
 * @property {Serving[]} servings ways to serve the site; the first is that for users
 * @property {{ first: string, second?: string }} pages paths; the first has the figures
 * @property {(page: import('@playwright/test').Page, path: string) => Promise<unknown>} [go] clicks a link to a path,
 *   or to "first" or "second" where both have one address
 * @property {(page: import('@playwright/test').Page, on: boolean) => Promise<unknown>} [dark] turns dark mode on or off
 * @property {ExpectedFigure[]} expected figures that the example contains
 * @property {{ message: RegExp, reason: string }[]} [allowed] messages of the console that the engine causes
 *
 * @typedef {object} Serving
 * @property {string} name
 * @property {(directory: string, tools: Tools) => Promise<RunningServer>} serve
 * @property {Record<string, (page: import('@playwright/test').Page, site: import('./checks.mjs').Site) => Promise<void>>} [checks] for
 *   servings that are not sites, in place of the usual checks
 * @property {Engine['dark']} [dark] replaces that of the engine, if only some servings have dark mode
 *
 * @typedef {{ url: string, stop: () => unknown }} RunningServer
 * @typedef {{ selector: string, properties: Record<string, unknown> }} ExpectedFigure selector of a figure, and properties that it must have
 * @typedef {{ tarball: string, wheel: string }} PackagePaths paths of the packages; the wheel (Python) is empty for engines without Python
 * @typedef {object} Tools
 * @property {(command: string, args: string[], env?: Record<string, string>) => Promise<string>} run runs a program in
 *   the copy, asserts that it succeeds, and returns its output
 * @property {(command: string, args: string[], env?: Record<string, string>) => ReturnType<typeof import('./serving.mjs').startProgram>} start
 *   starts a program in the copy and does not wait for its end
 */

/** Environment variables that turn off telemetry and questions of the engines. */
const SILENT_ENVIRONMENT = {
  ASTRO_TELEMETRY_DISABLED: '1',
  NEXT_TELEMETRY_DISABLED: '1',
  DO_NOT_TRACK: '1',
  NO_UPDATE_NOTIFIER: '1',
  CI: '1',
  NO_COLOR: '1',
  FORCE_COLOR: '0',
};

/** Directory for this clone alone, because tests of other clones may run at the same time. */
const SCRATCH_DIRECTORY = join(CACHE_DIRECTORY, 'embeddings', createHash('sha256').update(ROOT).digest('hex').slice(0, 8));

/** Returns the names of all engines. @returns {Promise<string[]>} */
export async function findEngineNames() {
  const { plainEngines } = await import('./plain.mjs');
  return [...Object.keys(plainEngines), ...readdirSync(join(ROOT, 'tests/embeddings')).flatMap((name) => name.match(/^(.+)\.js$/)?.slice(1) ?? [])];
}

/** Returns the description of an engine. @param {string} name @returns {Promise<Engine>} */
export async function loadEngine(name) {
  const { plainEngines } = await import('./plain.mjs');
  return plainEngines[name] ?? (await import(`./${name}.js`)).default;
}

/** Returns packages with the versions that an example pins. @param {string} example @param {string[]} packages */
export function pinnedVersions(example, ...packages) {
  const directory = join(ROOT, 'examples', example);
  const readText = (/** @type {string} */ name) => (existsSync(join(directory, name)) ? readFileSync(join(directory, name), 'utf8') : '');
  const { dependencies = {}, devDependencies = {} } = JSON.parse(readText('package.json') || '{}');
  const versionByPackage = new Map(Object.entries({ ...dependencies, ...devDependencies }));
  for (const [, name, version] of readText('requirements.txt').matchAll(/^([\w.-]+)(?:\[[\w,]+\])?==(\S+)$/gm)) versionByPackage.set(name, version);
  return packages
    .map((name) => {
      const version = versionByPackage.get(name);
      if (!/^\d+\.\d+[\w.]*$/.test(version ?? '')) throw new Error(`examples/${example}: ${name} is ${version}, and must be one version.`);
      return `${name} ${version}`;
    })
    .join(', ');
}

/** Installs the npm packages of an engine. @param {string} _directory @param {Tools & PackagePaths} tools */
export async function installNpmPackages(_directory, { run, tarball }) {
  await run('npm', ['install', '--no-audit', '--no-fund', '--prefer-offline', '--loglevel', 'error', tarball]);
}

/** Returns the directory of an example's Python tools. It is outside of the example, because some engines read all its files. @param {string} directory */
export const pythonDirectoryOf = (directory) => `${directory}.tools`;

/** Returns the path of a program that `installPythonPackages` has installed. @param {string} directory @param {string} name */
export const pythonProgramPath = (directory, name) => join(pythonDirectoryOf(directory), 'bin', name);

/**
 * Installs the Python packages of an engine.
 *
 * @param {string} directory
 * @param {Tools} tools
 * @param {string[]} wheels Python packages that are installed even if their versions have not changed
 */
export async function installPythonPackages(directory, { run }, wheels) {
  await run('python3', ['-m', 'venv', pythonDirectoryOf(directory)]);
  const pip = pythonProgramPath(directory, 'pip');
  const pipArguments = ['install', '--quiet', '--disable-pip-version-check'];
  await run(pip, [...pipArguments, '--requirement', 'requirements.txt', ...wheels]);
  // The package may have changed without a new version.
  if (wheels.length > 0) await run(pip, [...pipArguments, '--force-reinstall', '--no-deps', ...wheels]);
}

/** Packs the present build as npm would publish it, and returns the path of the package. @param {string} directory */
export function packInto(directory) {
  const packageName = execFileSync('npm', ['pack', ROOT, '--ignore-scripts', '--silent', '--pack-destination', directory], { encoding: 'utf8' });
  return join(directory, packageName.trim());
}

/** Packs the npm package, once, and returns its path. */
const packTarball = runOnce(async () => packInto(makeEmptyDirectory('npm')));

/** Builds the wheel of the Python package, once, and returns its path. */
const buildWheel = runOnce(async () => {
  const directory = makeEmptyDirectory('python');
  execFileSync('python3', ['-m', 'pip', 'wheel', '--quiet', '--no-deps', '--wheel-dir', directory, join(ROOT, 'python')]);
  return join(directory, readdirSync(directory)[0]);
});

/** Returns an empty directory for the package of a registry. @param {string} registry */
function makeEmptyDirectory(registry) {
  const directory = join(SCRATCH_DIRECTORY, 'packed', registry);
  rmSync(directory, { recursive: true, force: true });
  mkdirSync(directory, { recursive: true });
  return directory;
}

/** Returns the tools for a copy of an example. @param {string} directory @param {Record<string, string>} env @returns {Tools} */
function toolsIn(directory, env) {
  return {
    async run(command, args, more) {
      const errorMessage = `\`${[command, ...args].join(' ')}\` fails: see above.`;
      const runOptions = { cwd: directory, env: { ...env, ...more }, quiet: true, seconds: 900 };
      return (await mustRun(errorMessage, command, args, runOptions)).output;
    },
    start: (command, args, more) => startProgram(command, args, { cwd: directory, env: { ...env, ...more } }),
  };
}

/** Names of files and directories in the copy of an example that are kept between runs. */
const KEPT_NAMES = ['node_modules', '.venv', '.installed'];

/**
 * Makes a fresh copy of an engine's example with the package installed. The installation is kept until the example's pins, or
 * the package, change.
 *
 * @param {string} name
 * @param {Engine} definition
 */
export async function prepareExample(name, definition) {
  const exampleDirectory = join(ROOT, 'examples', name);
  const directory = join(SCRATCH_DIRECTORY, name);
  const tools = toolsIn(directory, { ...SILENT_ENVIRONMENT, ...(await environmentWithNode(definition)) });
  mkdirSync(directory, { recursive: true });
  for (const entryName of readdirSync(directory)) {
    if (!KEPT_NAMES.includes(entryName)) rmSync(join(directory, entryName), { recursive: true });
  }
  cpSync(exampleDirectory, directory, { recursive: true, filter: (path) => !KEPT_NAMES.includes(basename(path)) });
  const packagePaths = { tarball: await packTarball(), wheel: definition.python ? await buildWheel() : '' };
  const pinFiles = ['package.json', 'requirements.txt'].map((file) => join(exampleDirectory, file)).filter((path) => existsSync(path));
  const packageHash = createHash('sha256');
  for (const path of [...pinFiles, ...Object.values(packagePaths).filter((path) => path !== '')]) packageHash.update(readFileSync(path));
  const stampFile = join(directory, '.installed');
  const currentHash = packageHash.digest('hex');
  if (existsSync(stampFile) && readFileSync(stampFile, 'utf8') === currentHash) return { directory, tools };
  rmSync(stampFile, { force: true });
  removeCaches(join(directory, 'node_modules'));
  printStep(`${name}: installing`);
  await definition.install(directory, { ...tools, ...packagePaths });
  writeFileSync(stampFile, currentHash);
  return { directory, tools };
}

/**
 * Removes our package and caches of bundlers. Neither npm nor a bundler expects that the package changes under the same version.
 *
 * @param {string} modules
 */
function removeCaches(modules) {
  if (!existsSync(modules)) return;
  for (const name of readdirSync(modules)) {
    if (name === 'motion-widgets' || (name.startsWith('.') && name !== '.bin')) rmSync(join(modules, name), { recursive: true });
  }
}

/** Returns an environment with the Node that an engine needs, installed if this one is older. @param {Engine} definition @returns {Promise<Record<string, string>>} */
async function environmentWithNode({ node = 0 }) {
  if (Number.parseInt(process.versions.node) >= node) return {};
  const directory = join(SCRATCH_DIRECTORY, `node-${node}`);
  const bin = join(directory, 'node_modules/node/bin');
  if (!existsSync(bin)) {
    const missingMessage = `Node ${node} is needed and this is ${process.versions.node}: install it from nodejs.org.`;
    await mustRun(missingMessage, 'npm', ['install', '--prefix', directory, '--no-audit', '--no-fund', `node@${node}`], { quiet: true, seconds: 300 });
  }
  return { PATH: [bin, process.env.PATH].join(delimiter) };
}
