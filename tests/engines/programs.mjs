// Programs of Firefox and WebKit for `npm run test:engines`. Missing programs are installed by apt.

import { join } from 'node:path';
import { UserError, findProgram, runOrThrow, printStep, runProgram } from '../../scripts/process.mjs';
import { CACHE_DIRECTORY, installByApt, ensureNativeRust } from '../../scripts/toolchain.mjs';

const FIREFOX_NAMES = ['firefox-esr', 'firefox'];
const FIREFOX_MISSING_MESSAGE =
  'Firefox or its geckodriver is missing: install them (on Debian `sudo apt-get install firefox-esr`), or set FIREFOX to its path.';
const WEBKIT_MISSING_MESSAGE =
  'WebKit is missing, or what shows and drives it: on Debian and Ubuntu `sudo apt-get install webkit2gtk-driver xvfb`.';

/** Returns the programs of Firefox. Installs them if they are missing. @returns {Promise<{ firefoxPath: string, driverPath: string }>} */
export async function ensureFirefox() {
  const findFirefox = () => process.env.FIREFOX ?? FIREFOX_NAMES.map((programName) => findProgram(programName)).find((programPath) => programPath !== undefined);
  if (findFirefox() === undefined) await installByApt(['firefox-esr'], FIREFOX_MISSING_MESSAGE);
  const firefoxPath = findFirefox();
  if (firefoxPath === undefined || !(await runProgram(firefoxPath, ['--version'], { isQuiet: true, timeLimitSeconds: 60 })).hasSucceeded) throw new UserError(FIREFOX_MISSING_MESSAGE);
  return { firefoxPath, driverPath: await ensureGeckodriver() };
}

/** Returns the path of geckodriver. A missing geckodriver is compiled once, because distributions have no package of it. */
async function ensureGeckodriver() {
  const { GECKOWEBDRIVER } = process.env;
  const geckodriverDirectory = join(CACHE_DIRECTORY, 'geckodriver/bin');
  const findGeckodriver = () => findProgram('geckodriver', [...(GECKOWEBDRIVER ? [GECKOWEBDRIVER] : []), geckodriverDirectory]);
  const existingDriver = findGeckodriver();
  if (existingDriver !== undefined) return existingDriver;
  const rustTools = await ensureNativeRust();
  printStep('Compiling geckodriver, once');
  const cargoArguments = ['install', '--quiet', '--locked', '--debug', 'geckodriver', '--root', join(CACHE_DIRECTORY, 'geckodriver')];
  await runOrThrow(FIREFOX_MISSING_MESSAGE, join(rustTools.cargoDirectory, 'cargo'), cargoArguments, { env: rustTools.env, timeLimitSeconds: 1200 });
  return join(geckodriverDirectory, 'geckodriver');
}

/** Returns the driver of WebKit, and the program of a virtual screen. Installs them if they are missing. */
export async function ensureWebKit() {
  const findWebKit = () => ['WebKitWebDriver', 'Xvfb'].map((programName) => findProgram(programName));
  if (findWebKit().includes(undefined)) await installByApt(['webkit2gtk-driver', 'xvfb'], WEBKIT_MISSING_MESSAGE);
  const [driverProgram, displayProgram] = findWebKit();
  if (driverProgram === undefined || displayProgram === undefined) throw new UserError(WEBKIT_MISSING_MESSAGE);
  return { driverPath: driverProgram, xvfbPath: displayProgram };
}
