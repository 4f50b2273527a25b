// Running other programs, and saying in one sentence what is missing. Node built-ins only: this runs in a bare clone.

import { spawn } from 'node:child_process';
import { accessSync, constants, realpathSync, statSync } from 'node:fs';
import { delimiter, join } from 'node:path';
import { fileURLToPath } from 'node:url';

export const ROOT = fileURLToPath(new URL('..', import.meta.url));

/** Something the reader has to provide. The message is the whole sentence they are shown. */
export class Missing extends Error {}

/** @param {string} text */
export function progress(text) {
  console.log(`\n▸ ${text}`);
}

/**
 * Runs a script's main function when its file is the one that node was asked to run. Whatever goes wrong ends with
 * one sentence and exit code 1.
 *
 * @param {string} url the caller's import.meta.url
 * @param {() => Promise<unknown>} main
 */
export async function runAsScript(url, main) {
  if (process.argv[1] === undefined || realpathSync(process.argv[1]) !== fileURLToPath(url)) return;
  try {
    await main();
  } catch (error) {
    console.error(`\n${error instanceof Missing ? error.message : (error instanceof Error && error.stack) || error}`);
    process.exitCode = 1;
  }
}

/**
 * @typedef {object} RunOptions
 * @property {Record<string, string>} [env] added to the present environment
 * @property {number} [seconds] the time after which the program and all its children are killed
 * @property {boolean} [quiet] shows nothing
 */

/**
 * Runs a program from the repository's root, showing its output as it comes.
 *
 * @param {string} command
 * @param {string[]} args
 * @param {RunOptions} [options]
 * @returns {Promise<{ ok: boolean, timedOut: boolean, stdout: string, output: string }>} `output` is stdout and
 *   stderr in order of arrival; a program that cannot be started is not ok
 */
export function run(command, args, { env = {}, seconds, quiet = false } = {}) {
  return new Promise((resolve) => {
    // A program with a time limit leads its own process group, so that its children can be ended with it.
    const child = spawn(command, args, {
      cwd: ROOT,
      env: { ...process.env, ...env },
      stdio: ['ignore', 'pipe', 'pipe'],
      detached: seconds !== undefined,
    });
    let stdout = '';
    let output = '';
    let timedOut = false;
    const endGroup = () => {
      try {
        if (child.pid !== undefined) process.kill(-child.pid, 'SIGKILL');
      } catch {
        // It has ended by itself.
      }
    };
    const interrupted = () => {
      endGroup();
      process.exit(130);
    };
    /** @type {NodeJS.Timeout | undefined} */
    let timer;
    if (seconds !== undefined) {
      timer = setTimeout(() => {
        timedOut = true;
        endGroup();
      }, seconds * 1000);
      process.once('SIGINT', interrupted);
      process.once('SIGTERM', interrupted);
    }
    child.stdout.setEncoding('utf8').on('data', (text) => {
      stdout += text;
      output += text;
      if (!quiet) process.stdout.write(text);
    });
    child.stderr.setEncoding('utf8').on('data', (text) => {
      output += text;
      if (!quiet) process.stderr.write(text);
    });
    const finish = (/** @type {boolean} */ ok) => {
      clearTimeout(timer);
      process.off('SIGINT', interrupted);
      process.off('SIGTERM', interrupted);
      resolve({ ok, timedOut, stdout, output });
    };
    child.on('error', () => finish(false));
    child.on('close', (code) => finish(code === 0));
  });
}

/**
 * Runs a program that has to succeed.
 *
 * @param {string} sentence thrown as `Missing` when it does not
 * @param {string} command
 * @param {string[]} args
 * @param {RunOptions} [options]
 */
export async function mustRun(sentence, command, args, options) {
  const result = await run(command, args, options);
  if (!result.ok) {
    if (options?.quiet) process.stderr.write(result.output);
    throw new Missing(sentence);
  }
  return result;
}

/**
 * @param {string} name
 * @param {string[]} [moreDirectories] looked in after those of PATH
 * @returns {string | undefined} the full path of a program
 */
export function findProgram(name, moreDirectories = []) {
  return [...(process.env.PATH ?? '').split(delimiter), ...moreDirectories]
    .map((directory) => join(directory, name))
    .find(isProgram);
}

/** @param {string} path */
export function isProgram(path) {
  try {
    accessSync(path, constants.X_OK);
    return statSync(path).isFile();
  } catch {
    return false;
  }
}
