// Finds Chromium and a chromedriver of the same version on this machine for the tests, or installs them.

import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { UserError, absolutePathOf, findProgram, runOrThrow, printStep, runProgram } from './process.mjs';
import { CACHE_DIRECTORY, installByApt } from './toolchain.mjs';

/** Names of the programs of the full Chromium. Only the full Chromium has a back-forward cache. */
export const FULL_CHROME_PROGRAM_NAMES = ['chromium', 'google-chrome', 'google-chrome-stable', 'chrome', 'chromium-browser'];
/** Names of all programs of Chromium. The headless program is preferred, because it takes a third less processor time. */
const CHROME_PROGRAM_NAMES = ['chromium-headless-shell', ...FULL_CHROME_PROGRAM_NAMES];
const MACOS_CHROME_DIRECTORY = '/Applications/Google Chrome.app/Contents/MacOS';
const MISSING_BROWSER_MESSAGE =
  'Chromium and a chromedriver of the same version are missing: install both ' +
  '(on Debian `sudo apt-get install chromium chromium-driver`), or set CHROME and CHROMEDRIVER to their paths.';

/** Arguments that run Chromium without a sandbox (for containers), without a graphics card, and without background network requests. */
export const CHROME_ARGUMENTS = [
  '--no-sandbox',
  '--disable-gpu',
  '--disable-quic',
  '--no-first-run',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
  // With this argument, an out-of-bounds access in WebAssembly is a catchable error. Otherwise it crashes headless Chromium.
  '--enable-crash-reporter',
];

/** @typedef {{ chromePath: string, driverPath: string, version: string }} Browser */

/** Returns a browser with its driver, and installs what is missing. @returns {Promise<Browser>} */
export async function ensureBrowser() {
  const browser = await ensureChrome();
  // A font as wide as Arial is installed, because the layout of the pages is made for it. If DejaVu is the only font, all text is a tenth wider.
  if (findProgram('fc-match') !== undefined && findProgram('apt-get') !== undefined) {
    const { stdout: arialFamily } = await runProgram('fc-match', ['--format', '%{family}', 'Arial'], { isQuiet: true, timeLimitSeconds: 30 });
    if (!/Arial|Liberation|Arimo|Helvetica/.test(arialFamily)) await installByApt(['fonts-liberation'], 'A font as wide as Arial is missing: install fonts-liberation.');
  }
  return browser;
}

async function ensureChrome() {
  const { CHROME, CHROMEDRIVER } = process.env;
  const existingBrowser = await pairBrowserWithDriver(CHROME ?? findChrome(), CHROMEDRIVER ?? findProgram('chromedriver'));
  if (existingBrowser !== undefined) return existingBrowser;
  if (CHROME !== undefined || CHROMEDRIVER !== undefined) throw new UserError(MISSING_BROWSER_MESSAGE);
  // On Ubuntu, the Chromium packages of apt only install snaps. This script cannot drive the Chromium in a snap.
  const isDebian = existsSync('/etc/os-release') && /^ID=debian$/m.test(readFileSync('/etc/os-release', 'utf8'));
  if (isDebian) await installByApt(['chromium-headless-shell', 'chromium-driver'], MISSING_BROWSER_MESSAGE);
  const installedBrowser = isDebian ? await pairBrowserWithDriver(findChrome(), findProgram('chromedriver')) : await installChromeForTesting();
  if (installedBrowser === undefined) throw new UserError(MISSING_BROWSER_MESSAGE);
  return installedBrowser;
}

/** Returns the path of the first Chrome that is found. @param {string[]} [programNames] names, the preferred one first */
export function findChrome(programNames = CHROME_PROGRAM_NAMES) {
  return (
    programNames.map((programName) => findProgram(programName)).find((programPath) => programPath !== undefined) ??
    findProgram('Google Chrome', [MACOS_CHROME_DIRECTORY])
  );
}

/**
 * Returns a browser and its driver of the same version.
 *
 * @param {string | undefined} chromePath
 * @param {string | undefined} driverPath
 * @returns {Promise<Browser | undefined>} undefined unless both run and are of one major version
 */
async function pairBrowserWithDriver(chromePath, driverPath) {
  if (chromePath === undefined || driverPath === undefined) return undefined;
  const [chromeVersion, driverVersion] = await Promise.all([readVersion(chromePath), readVersion(driverPath)]);
  if (chromeVersion === undefined || chromeVersion.split('.')[0] !== driverVersion?.split('.')[0]) return undefined;
  return { chromePath, driverPath, version: chromeVersion };
}

/** Returns the version that a program prints, or undefined if the program does not run. @param {string} programPath */
async function readVersion(programPath) {
  const { stdout } = await runProgram(programPath, ['--version'], { isQuiet: true, timeLimitSeconds: 30 });
  return stdout.match(/\d+(\.\d+){3}/)?.[0];
}

/** Returns Google's Chrome for Testing, which has a matching chromedriver. The browser and the driver are downloaded once. */
async function installChromeForTesting() {
  const browsersDirectory = join(CACHE_DIRECTORY, 'browsers');
  const browserPathsFile = join(browsersDirectory, 'paths.json');
  if (existsSync(browserPathsFile)) {
    const { chrome: chromePath, driver: driverPath } = JSON.parse(readFileSync(browserPathsFile, 'utf8'));
    const existingBrowser = await pairBrowserWithDriver(chromePath, driverPath);
    if (existingBrowser !== undefined) return existingBrowser;
  }
  printStep('Downloading Chrome for Testing');
  const chromePath = await downloadProgram(browsersDirectory, 'chrome@stable');
  if (chromePath === undefined) return undefined;
  if ((await readVersion(chromePath)) === undefined) {
    // Installs the system libraries that Chrome needs, because a downloaded Chrome does not include them.
    const installLibraries = [absolutePathOf('node_modules/@playwright/test/cli.js'), 'install-deps', 'chromium'];
    await runOrThrow('Libraries that Chrome needs are missing: run `npx playwright install-deps chromium` and start again.', process.execPath, installLibraries, { timeLimitSeconds: 600 });
  }
  const driverPath = await downloadProgram(browsersDirectory, `chromedriver@${await readVersion(chromePath)}`);
  writeFileSync(browserPathsFile, JSON.stringify({ chrome: chromePath, driver: driverPath }));
  return pairBrowserWithDriver(chromePath, driverPath);
}

/** Downloads a program, and returns its path. @param {string} installDirectory @param {string} programAndVersion @returns {Promise<string | undefined>} */
async function downloadProgram(installDirectory, programAndVersion) {
  const installArguments = ['exec', '--yes', '--', '@puppeteer/browsers@2.13.2', 'install', programAndVersion];
  const { hasSucceeded, stdout } = await runProgram('npm', [...installArguments, '--path', installDirectory, '--format', '{{path}}'], { timeLimitSeconds: 900 });
  return hasSucceeded ? stdout.trim().split('\n').pop() : undefined;
}
