// Firefox and WebKit, which `npm run test:engines` drives beside Chromium: those of this machine, or installed by apt.

import { existsSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { Missing, findProgram, isProgram, run } from './process.mjs';
import { aptInstall } from './toolchain.mjs';

const FIREFOX_NAMES = ['firefox-esr', 'firefox'];
const FIREFOX_SENTENCE =
  'Firefox is missing: install it (on Debian `sudo apt-get install firefox-esr`), or set FIREFOX to its path.';
const WEBKIT_SENTENCE =
  'WebKit is missing, or what shows and drives it: on Debian and Ubuntu `sudo apt-get install webkit2gtk-driver xvfb`.';

/** Where distributions keep MiniBrowser: by architecture, and by the version of its interface. */
const LIBRARIES = ['/usr/lib', '/usr/libexec', '/usr/lib64'];

/** @returns {Promise<string>} the program */
export async function ensureFirefox() {
  const { FIREFOX } = process.env;
  const find = () => FIREFOX ?? FIREFOX_NAMES.map((name) => findProgram(name)).find((path) => path !== undefined);
  const present = find();
  if (present !== undefined && (await runs(present))) return present;
  if (FIREFOX !== undefined) throw new Missing(FIREFOX_SENTENCE);
  await aptInstall(['firefox-esr'], FIREFOX_SENTENCE);
  const installed = find();
  if (installed === undefined || !(await runs(installed))) throw new Missing(FIREFOX_SENTENCE);
  return installed;
}

/** @typedef {{ driver: string, browser: string, display: string }} WebKit its programs; the last shows windows to nobody */

/** @returns {Promise<WebKit>} */
export async function ensureWebKit() {
  const present = findWebKit();
  if (present !== undefined) return present;
  await aptInstall(['webkit2gtk-driver', 'xvfb'], WEBKIT_SENTENCE);
  const installed = findWebKit();
  if (installed === undefined) throw new Missing(WEBKIT_SENTENCE);
  return installed;
}

/** @returns {WebKit | undefined} */
function findWebKit() {
  const [driver, display, browser] = [findProgram('WebKitWebDriver'), findProgram('Xvfb'), findMiniBrowser()];
  return driver && display && browser ? { driver, display, browser } : undefined;
}

/** @returns {string | undefined} that of the newest interface */
function findMiniBrowser() {
  const subdirectories = (/** @type {string} */ directory) =>
    existsSync(directory) ? readdirSync(directory, { withFileTypes: true }).filter((entry) => entry.isDirectory()).map(({ name }) => join(directory, name)) : [];
  const libraries = LIBRARIES.flatMap((directory) => [directory, ...subdirectories(directory).filter((path) => /-linux-gnu/.test(path))]);
  const candidates = libraries.flatMap(subdirectories).filter((path) => /\/webkit(2gtk|gtk)-[\d.]+$/.test(path));
  return candidates.sort().reverse().map((path) => join(path, 'MiniBrowser')).find(isProgram);
}

/** @param {string} program */
async function runs(program) {
  return (await run(program, ['--version'], { quiet: true, seconds: 60 })).ok;
}
