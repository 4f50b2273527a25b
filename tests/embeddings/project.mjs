// Projects for the tests: packs the npm and Python packages, and copies each example to a directory outside of this repository. There no
// file of the repository can be imported by accident. The copies and the packages installed in them are kept between runs.

import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { cpSync, existsSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { basename, delimiter, join } from 'node:path';
import { REPOSITORY_ROOT, runOrThrow, memoizeWork, printStep } from '../../scripts/process.mjs';
import { startProgram } from './serving.mjs';
import { CACHE_DIRECTORY } from '../../scripts/toolchain.mjs';

/**
 * Description of a platform (a tool that makes web pages, such as Hugo), which a file in this folder exports by default.
 *
 * @typedef {object} Platform
 * @property {string} heading of its section in doc/embedding/, and its name in the table of doc/embedding.md
 * @property {() => string} readVersions of its packages, as the files of the example pin them
 * @property {boolean} [usesPython] true if it uses the Python package
 * @property {number} [nodeMajor] major version of Node that it needs, if newer than that of our package
 * @property {(directory: string, tools: Tools & PackagePaths) => Promise<unknown>} installPackages installs the packages in a fresh copy of the example
 * @property {(directory: string, tools: Tools) => Promise<unknown>} [build]
 * @property {ServerMode[]} serverModes ways to serve the site, such as a development server; readers get the first
 * @property {{ figuresPath: string, otherPath?: string }} pages paths of the page with the figures and of a page without
 * @property {(page: import('@playwright/test').Page, path: string) => Promise<unknown>} [goToPage] clicks a link to a path,
 *   or to "figuresPath" or "otherPath" if both pages have the same address
 * @property {(page: import('@playwright/test').Page, isDark: boolean) => Promise<unknown>} [setDarkMode] turns dark mode on or off
 * @property {ExpectedFigure[]} expectedFigures figures that the example contains
 * @property {{ messagePattern: RegExp, reason: string }[]} [allowedMessages] messages of the console that the platform causes
 * 
 * @typedef {object} ServerMode
 * @property {string} name
 * @property {(directory: string, tools: Tools) => Promise<RunningServer>} serve
 * @property {Record<string, (page: import('@playwright/test').Page, site: import('./checks.mjs').Site) => Promise<void>>} [checks] for
 *   modes that are not sites, in place of the usual checks
 * @property {Platform['setDarkMode']} [setDarkMode] replaces that of the platform, if only some modes have dark mode
 * 
 * @typedef {{ url: string, stop: () => unknown }} RunningServer
 * @typedef {{ selector: string, properties: Record<string, unknown> }} ExpectedFigure selector of a figure, and properties that it must have
 * @typedef {{ npmTarball: string, pythonWheel: string }} PackagePaths paths of the packages; pythonWheel is empty for platforms without Python
 * @typedef {object} Tools
 * @property {(command: string, args: string[], env?: Record<string, string>) => Promise<string>} run runs a program in
 *   the copy, asserts that it succeeds, and returns its output
 * @property {(command: string, args: string[], env?: Record<string, string>) => ReturnType<typeof import('./serving.mjs').startProgram>} start
 *   starts a program in the copy and does not wait for its end
 */

/** Environment variables that turn off telemetry and interactive questions of the platforms. */
const SILENT_ENVIRONMENT = {
  ASTRO_TELEMETRY_DISABLED: '1',
  NEXT_TELEMETRY_DISABLED: '1',
  DO_NOT_TRACK: '1',
  NO_UPDATE_NOTIFIER: '1',
  CI: '1',
  NO_COLOR: '1',
  FORCE_COLOR: '0',
};

/** Directory of the packages and copies for this clone of the repository. Tests of other clones may run at the same time. */
const SCRATCH_DIRECTORY = join(CACHE_DIRECTORY, 'embeddings', createHash('sha256').update(REPOSITORY_ROOT).digest('hex').slice(0, 8));

/** Returns the names of all tested platforms, such as "hugo" or "next". @returns {Promise<string[]>} */
export async function findPlatformNames() {
  const { plainPlatforms } = await import('./plain.mjs');
  return [...Object.keys(plainPlatforms), ...readdirSync(join(REPOSITORY_ROOT, 'tests/embeddings')).flatMap((fileName) => fileName.match(/^(.+)\.js$/)?.slice(1) ?? [])];
}

/** Returns the description of a platform. @param {string} platformName @returns {Promise<Platform>} */
export async function loadPlatform(platformName) {
  const { plainPlatforms } = await import('./plain.mjs');
  return plainPlatforms[platformName] ?? (await import(`./${platformName}.js`)).default;
}

/** Returns packages with the versions to which an example pins them. @param {string} exampleName @param {string[]} packageNames */
export function pinnedVersionsOf(exampleName, ...packageNames) {
  const exampleDirectory = join(REPOSITORY_ROOT, 'examples', exampleName);
  const readText = (/** @type {string} */ fileName) => (existsSync(join(exampleDirectory, fileName)) ? readFileSync(join(exampleDirectory, fileName), 'utf8') : '');
  const { dependencies = {}, devDependencies = {} } = JSON.parse(readText('package.json') || '{}');
  const versionByPackage = new Map(Object.entries({ ...dependencies, ...devDependencies }));
  for (const [, packageName, pinnedVersion] of readText('requirements.txt').matchAll(/^([\w.-]+)(?:\[[\w,]+\])?==(\S+)$/gm)) versionByPackage.set(packageName, pinnedVersion);
  return packageNames
    .map((packageName) => {
      const pinnedVersion = versionByPackage.get(packageName);
      if (!/^\d+\.\d+[\w.]*$/.test(pinnedVersion ?? '')) throw new Error(`examples/${exampleName}: ${packageName} is ${pinnedVersion}, and must be one version.`);
      return `${packageName} ${pinnedVersion}`;
    })
    .join(', ');
}

/** Installs the npm packages of a platform's example. @param {string} _directory @param {Tools & PackagePaths} tools */
export async function installNpmPackages(_directory, { run: runInProject, npmTarball }) {
  await runInProject('npm', ['install', '--no-audit', '--no-fund', '--prefer-offline', '--loglevel', 'error', npmTarball]);
}

/**
 * Returns the directory of an example's Python tools. The directory is outside of the example, because some platforms read all files of an
 * example.
 * @param {string} projectDirectory
 */
export const pythonDirectoryOf = (projectDirectory) => `${projectDirectory}.tools`;

/** Returns the path of a program that `installPythonPackages` has installed. @param {string} projectDirectory @param {string} programName */
export const pythonProgramPathOf = (projectDirectory, programName) => join(pythonDirectoryOf(projectDirectory), 'bin', programName);

/**
 * Installs the Python packages of a platform's example.
 *
 * @param {string} projectDirectory
 * @param {Tools} tools
 * @param {string[]} pythonWheelPaths Python packages that are installed even if their versions have not changed
 */
export async function installPythonPackages(projectDirectory, { run: runInProject }, pythonWheelPaths) {
  await runInProject('python3', ['-m', 'venv', pythonDirectoryOf(projectDirectory)]);
  const pipPath = pythonProgramPathOf(projectDirectory, 'pip');
  const pipArguments = ['install', '--quiet', '--disable-pip-version-check'];
  await runInProject(pipPath, [...pipArguments, '--requirement', 'requirements.txt', ...pythonWheelPaths]);
  // The package may have changed although its version is the same.
  if (pythonWheelPaths.length > 0) await runInProject(pipPath, [...pipArguments, '--force-reinstall', '--no-deps', ...pythonWheelPaths]);
}

/** Packs the present build as npm would publish it, and returns the path of the package. @param {string} projectDirectory */
export function packNpmPackageInto(projectDirectory) {
  const tarballName = execFileSync('npm', ['pack', REPOSITORY_ROOT, '--ignore-scripts', '--silent', '--pack-destination', projectDirectory], { encoding: 'utf8' });
  return join(projectDirectory, tarballName.trim());
}

/** Packs the npm package once, and returns the path of the packed file. */
const packNpmPackage = memoizeWork(async () => packNpmPackageInto(makeEmptyDirectory('npm')));

/** Builds the wheel of the Python package once, and returns its path. */
const buildPythonWheel = memoizeWork(async () => {
  const projectDirectory = makeEmptyDirectory('python');
  execFileSync('python3', ['-m', 'pip', 'wheel', '--quiet', '--no-deps', '--wheel-dir', projectDirectory, join(REPOSITORY_ROOT, 'python')]);
  return join(projectDirectory, readdirSync(projectDirectory)[0]);
});

/** Returns an empty directory for a package of a registry. @param {string} registryName */
function makeEmptyDirectory(registryName) {
  const projectDirectory = join(SCRATCH_DIRECTORY, 'packed', registryName);
  rmSync(projectDirectory, { recursive: true, force: true });
  mkdirSync(projectDirectory, { recursive: true });
  return projectDirectory;
}

/** Returns functions that run programs in the directory of an example. @param {string} projectDirectory @param {Record<string, string>} toolEnvironment @returns {Tools} */
function createTools(projectDirectory, toolEnvironment) {
  return {
    async run(programName, commandArguments, moreEnvironment) {
      const errorMessage = `\`${[programName, ...commandArguments].join(' ')}\` fails: see above.`;
      const runOptions = { cwd: projectDirectory, env: { ...toolEnvironment, ...moreEnvironment }, isQuiet: true, timeLimitSeconds: 900 };
      return (await runOrThrow(errorMessage, programName, commandArguments, runOptions)).output;
    },
    start: (programName, programArguments, moreEnvironment) => startProgram(programName, programArguments, { cwd: projectDirectory, env: { ...toolEnvironment, ...moreEnvironment } }),
  };
}

/** Names of files and directories in the copy of an example that are kept between runs. */
const KEPT_FOLDER_NAMES = ['node_modules', '.venv', '.installed'];

/**
 * Makes a fresh copy of a platform's example with the package installed. The installation is kept until the pinned versions or the package
 * change.
 *
 * @param {string} platformName
 * @param {Platform} platformDefinition
 */
export async function prepareExample(platformName, platformDefinition) {
  const exampleDirectory = join(REPOSITORY_ROOT, 'examples', platformName);
  const projectDirectory = join(SCRATCH_DIRECTORY, platformName);
  const exampleTools = createTools(projectDirectory, { ...SILENT_ENVIRONMENT, ...(await ensureNode(platformDefinition)) });
  mkdirSync(projectDirectory, { recursive: true });
  for (const entryName of readdirSync(projectDirectory)) {
    if (!KEPT_FOLDER_NAMES.includes(entryName)) rmSync(join(projectDirectory, entryName), { recursive: true });
  }
  cpSync(exampleDirectory, projectDirectory, { recursive: true, filter: (filePath) => !KEPT_FOLDER_NAMES.includes(basename(filePath)) });
  const packagePaths = { npmTarball: await packNpmPackage(), pythonWheel: platformDefinition.usesPython ? await buildPythonWheel() : '' };
  const versionFiles = ['package.json', 'requirements.txt'].map((fileName) => join(exampleDirectory, fileName)).filter((filePath) => existsSync(filePath));
  const packageHash = createHash('sha256');
  for (const filePath of [...versionFiles, ...Object.values(packagePaths).filter((filePath) => filePath !== '')]) packageHash.update(readFileSync(filePath));
  const stampFile = join(projectDirectory, '.installed');
  const currentHash = packageHash.digest('hex');
  if (existsSync(stampFile) && readFileSync(stampFile, 'utf8') === currentHash) return { directory: projectDirectory, tools: exampleTools };
  rmSync(stampFile, { force: true });
  removeCaches(join(projectDirectory, 'node_modules'));
  printStep(`${platformName}: installing`);
  await platformDefinition.installPackages(projectDirectory, { ...exampleTools, ...packagePaths });
  writeFileSync(stampFile, currentHash);
  return { directory: projectDirectory, tools: exampleTools };
}

/**
 * Removes this package and the caches of bundlers from a copy. Neither npm nor a bundler expects that the package changes under the same version.
 *
 * @param {string} modulesDirectory
 */
function removeCaches(modulesDirectory) {
  if (!existsSync(modulesDirectory)) return;
  for (const packageName of readdirSync(modulesDirectory)) {
    if (packageName === 'motion-widgets' || (packageName.startsWith('.') && packageName !== '.bin')) rmSync(join(modulesDirectory, packageName), { recursive: true });
  }
}

/**
 * Returns an environment with the version of Node that a platform needs. That version is installed if the current one is older.
 * @param {Platform} definition @returns {Promise<Record<string, string>>}
 */
async function ensureNode({ nodeMajor = 0 }) {
  if (Number.parseInt(process.versions.node) >= nodeMajor) return {};
  const projectDirectory = join(SCRATCH_DIRECTORY, `node-${nodeMajor}`);
  const nodeBinDirectory = join(projectDirectory, 'node_modules/node/bin');
  if (!existsSync(nodeBinDirectory)) {
    const missingMessage = `Node ${nodeMajor} is needed and this is ${process.versions.node}: install it from nodejs.org.`;
    await runOrThrow(missingMessage, 'npm', ['install', '--prefix', projectDirectory, '--no-audit', '--no-fund', `node@${nodeMajor}`], { isQuiet: true, timeLimitSeconds: 300 });
  }
  return { PATH: [nodeBinDirectory, process.env.PATH].join(delimiter) };
}
