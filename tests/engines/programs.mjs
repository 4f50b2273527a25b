// Finds Firefox and WebKit for `npm run test:engines`, or installs them by apt.

import { existsSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { UserError, findProgram, isProgram, mustRun, printStep, run } from '../../scripts/process.mjs';
import { CACHE_DIRECTORY, aptInstall, ensureNativeRust } from '../../scripts/toolchain.mjs';

const FIREFOX_NAMES = ['firefox-esr', 'firefox'];
const FIREFOX_MISSING_MESSAGE =
  'Firefox or its geckodriver is missing: install them (on Debian `sudo apt-get install firefox-esr`), or set FIREFOX to its path.';
const WEBKIT_MISSING_MESSAGE =
  'WebKit is missing, or what shows and drives it: on Debian and Ubuntu `sudo apt-get install webkit2gtk-driver xvfb`.';

/** Directories in which distributions keep MiniBrowser, in a folder by architecture and version. */
const LIBRARY_DIRECTORIES = ['/usr/lib', '/usr/libexec', '/usr/lib64'];

/** Returns the programs of Firefox. Installs them if they are missing. @returns {Promise<{ firefox: string, driver: string }>} */
export async function ensureFirefox() {
  const findFirefox = () => process.env.FIREFOX ?? FIREFOX_NAMES.map((name) => findProgram(name)).find((path) => path !== undefined);
  if (findFirefox() === undefined) await aptInstall(['firefox-esr'], FIREFOX_MISSING_MESSAGE);
  const firefox = findFirefox();
  if (firefox === undefined || !(await run(firefox, ['--version'], { quiet: true, seconds: 60 })).ok) throw new UserError(FIREFOX_MISSING_MESSAGE);
  return { firefox, driver: await ensureGeckodriver() };
}

/** Returns the path of geckodriver. If it is not found, it is compiled once, because distributions have no package of it. */
async function ensureGeckodriver() {
  const { GECKOWEBDRIVER } = process.env;
  const bin = join(CACHE_DIRECTORY, 'geckodriver/bin');
  const findGeckodriver = () => findProgram('geckodriver', [...(GECKOWEBDRIVER ? [GECKOWEBDRIVER] : []), bin]);
  const existingDriver = findGeckodriver();
  if (existingDriver !== undefined) return existingDriver;
  const rustTools = await ensureNativeRust();
  printStep('Compiling geckodriver, once');
  const cargoArguments = ['install', '--quiet', '--locked', '--debug', 'geckodriver', '--root', join(CACHE_DIRECTORY, 'geckodriver')];
  await mustRun(FIREFOX_MISSING_MESSAGE, join(rustTools.bin, 'cargo'), cargoArguments, { env: rustTools.env, seconds: 1200 });
  return join(bin, 'geckodriver');
}

/** @typedef {{ driver: string, browser: string, display: string }} WebKit programs of WebKit; `display` starts a virtual screen */

/** Returns the programs of WebKit. Installs them if they are missing. @returns {Promise<WebKit>} */
export async function ensureWebKit() {
  const existingPrograms = findWebKit();
  if (existingPrograms !== undefined) return existingPrograms;
  await aptInstall(['webkit2gtk-driver', 'xvfb'], WEBKIT_MISSING_MESSAGE);
  const installedPrograms = findWebKit();
  if (installedPrograms === undefined) throw new UserError(WEBKIT_MISSING_MESSAGE);
  return installedPrograms;
}

/** Returns the programs of WebKit if all are found. @returns {WebKit | undefined} */
function findWebKit() {
  const [driver, display, browser] = [findProgram('WebKitWebDriver'), findProgram('Xvfb'), findMiniBrowser()];
  return driver && display && browser ? { driver, display, browser } : undefined;
}

/** Returns the path of WebKit's newest MiniBrowser. @returns {string | undefined} */
function findMiniBrowser() {
  const subdirectoriesOf = (/** @type {string} */ directory) =>
    existsSync(directory) ? readdirSync(directory, { withFileTypes: true }).filter((entry) => entry.isDirectory()).map(({ name }) => join(directory, name)) : [];
  const libraryDirectories = LIBRARY_DIRECTORIES.flatMap((directory) => [directory, ...subdirectoriesOf(directory).filter((path) => /-linux-gnu/.test(path))]);
  const webkitDirectories = libraryDirectories.flatMap(subdirectoriesOf).filter((path) => /\/webkit(2gtk|gtk)-[\d.]+$/.test(path));
  return webkitDirectories.sort().reverse().map((path) => join(path, 'MiniBrowser')).find(isProgram);
}
