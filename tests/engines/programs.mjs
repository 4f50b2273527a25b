// Finds Firefox and WebKit for `npm run test:engines`, or installs them by apt.

import { existsSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { UserError, findProgram, isProgram, mustRun, printStep, run } from '../../scripts/process.mjs';
import { CACHE_DIRECTORY, aptInstall, nativeRust } from '../../scripts/toolchain.mjs';

const FIREFOX_NAMES = ['firefox-esr', 'firefox'];
const FIREFOX_SENTENCE =
  'Firefox or its geckodriver is missing: install them (on Debian `sudo apt-get install firefox-esr`), or set FIREFOX to its path.';
const WEBKIT_SENTENCE =
  'WebKit is missing, or what shows and drives it: on Debian and Ubuntu `sudo apt-get install webkit2gtk-driver xvfb`.';

/** Directories in which distributions keep MiniBrowser, in a folder by architecture and version. */
const LIBRARY_DIRECTORIES = ['/usr/lib', '/usr/libexec', '/usr/lib64'];

/** @returns {Promise<{ firefox: string, driver: string }>} its programs */
export async function ensureFirefox() {
  const find = () => process.env.FIREFOX ?? FIREFOX_NAMES.map((name) => findProgram(name)).find((path) => path !== undefined);
  if (find() === undefined) await aptInstall(['firefox-esr'], FIREFOX_SENTENCE);
  const firefox = find();
  if (firefox === undefined || !(await run(firefox, ['--version'], { quiet: true, seconds: 60 })).ok) throw new UserError(FIREFOX_SENTENCE);
  return { firefox, driver: await ensureGeckodriver() };
}

/** Returns the path of geckodriver. If it is not found, it is compiled once, because distributions have no package of it. */
async function ensureGeckodriver() {
  const { GECKOWEBDRIVER } = process.env;
  const bin = join(CACHE_DIRECTORY, 'geckodriver/bin');
  const find = () => findProgram('geckodriver', [...(GECKOWEBDRIVER ? [GECKOWEBDRIVER] : []), bin]);
  const present = find();
  if (present !== undefined) return present;
  const rust = await nativeRust();
  printStep('Compiling geckodriver, once');
  const options = ['install', '--quiet', '--locked', '--debug', 'geckodriver', '--root', join(CACHE_DIRECTORY, 'geckodriver')];
  await mustRun(FIREFOX_SENTENCE, join(rust.bin, 'cargo'), options, { env: rust.env, seconds: 1200 });
  return join(bin, 'geckodriver');
}

/** @typedef {{ driver: string, browser: string, display: string }} WebKit its programs; `display` is a virtual screen */

/** @returns {Promise<WebKit>} */
export async function ensureWebKit() {
  const present = findWebKit();
  if (present !== undefined) return present;
  await aptInstall(['webkit2gtk-driver', 'xvfb'], WEBKIT_SENTENCE);
  const installed = findWebKit();
  if (installed === undefined) throw new UserError(WEBKIT_SENTENCE);
  return installed;
}

/** @returns {WebKit | undefined} */
function findWebKit() {
  const [driver, display, browser] = [findProgram('WebKitWebDriver'), findProgram('Xvfb'), findMiniBrowser()];
  return driver && display && browser ? { driver, display, browser } : undefined;
}

/** @returns {string | undefined} path of WebKit's MiniBrowser, in its newest version */
function findMiniBrowser() {
  const subdirectories = (/** @type {string} */ directory) =>
    existsSync(directory) ? readdirSync(directory, { withFileTypes: true }).filter((entry) => entry.isDirectory()).map(({ name }) => join(directory, name)) : [];
  const libraries = LIBRARY_DIRECTORIES.flatMap((directory) => [directory, ...subdirectories(directory).filter((path) => /-linux-gnu/.test(path))]);
  const candidates = libraries.flatMap(subdirectories).filter((path) => /\/webkit(2gtk|gtk)-[\d.]+$/.test(path));
  return candidates.sort().reverse().map((path) => join(path, 'MiniBrowser')).find(isProgram);
}
