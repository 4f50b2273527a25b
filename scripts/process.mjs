// Runs other programs, reports in one sentence what is missing, and lists files. This script imports only Node built-ins, because it runs in a bare clone.

import { AsyncLocalStorage } from 'node:async_hooks';
import { spawn } from 'node:child_process';
import { accessSync, constants, readdirSync, realpathSync, statSync } from 'node:fs';
import { basename, delimiter, join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';

export const ROOT = fileURLToPath(new URL('..', import.meta.url));

/** Error about something that the user has to provide or correct. Its message is printed without a stack trace. */
export class UserError extends Error {}

/** Collected output of each work that runs in parallel with other work. @type {AsyncLocalStorage<string[]>} */
const collectedOutputStore = new AsyncLocalStorage();

/** Prints text, or adds it to the collected output. @param {string} text @param {NodeJS.WriteStream} [stream] */
function print(text, stream = process.stdout) {
  const outputTexts = collectedOutputStore.getStore();
  if (outputTexts === undefined) stream.write(text);
  else outputTexts.push(text);
}

/**
 * Collects the output of work that runs in parallel with other work, and prints it at the end.
 *
 * @template T
 * @param {() => Promise<T>} work
 * @returns {Promise<T>} result of the work
 */
export async function withCollectedOutput(work) {
  /** @type {string[]} */
  const outputTexts = [];
  try {
    return await collectedOutputStore.run(outputTexts, work);
  } finally {
    print(outputTexts.join(''));
  }
}

/** Prints the name of the step that begins. @param {string} text */
export function printStep(text) {
  print(`\n▸ ${text}\n`);
}

/**
 * Returns a function that does some work at its first call, and returns the same result at every call.
 *
 * @template T
 * @param {() => Promise<T>} work
 * @returns {() => Promise<T>}
 */
export function runOnce(work) {
  /** @type {Promise<T> | undefined} */
  let resultPromise;
  return () => (resultPromise ??= work());
}

/** Returns a function that runs tasks one after the other. @returns {<T>(work: () => Promise<T>) => Promise<T>} */
export function taskQueue() {
  /** @type {Promise<unknown>} */
  let lastTask = Promise.resolve();
  return (work) => {
    const taskResult = lastTask.then(work);
    lastTask = taskResult.catch(() => {});
    return taskResult;
  };
}

/**
 * Waits until all promises are settled. Work that continued after a failure would write files that the next run reads.
 *
 * @template {Promise<unknown>[] | []} T
 * @param {T} promises
 * @returns {Promise<{ -readonly [K in keyof T]: Awaited<T[K]> }>} rejected with the first failure
 */
export async function settleAll(promises) {
  await Promise.allSettled(promises);
  return /** @type {Promise<any>} */ (Promise.all(promises));
}

/**
 * Runs a script's main function if node was started with that script. An error prints one sentence, and sets exit code 1.
 *
 * @param {string} url import.meta.url of the script
 * @param {() => Promise<unknown>} main
 */
export async function runAsScript(url, main) {
  if (process.argv[1] === undefined || realpathSync(process.argv[1]) !== fileURLToPath(url)) return;
  try {
    const [major, minor] = process.versions.node.split('.').map(Number);
    if (major < 20 || (major === 20 && minor < 19)) {
      throw new UserError(`Node 20.19 or newer is needed and this is ${process.versions.node}: install it from nodejs.org.`);
    }
    await main();
  } catch (error) {
    console.error(`\n${error instanceof UserError ? error.message : (error instanceof Error && error.stack) || error}`);
    process.exitCode = 1;
  }
}

/** Process groups that are ended when this process is interrupted. @type {Set<number>} */
const processGroups = new Set();

/** Ends a process group. @param {number} group */
export function endGroup(group) {
  try {
    process.kill(-group, 'SIGKILL');
  } catch {
    // The group has ended by itself.
  }
}

/** Ends this process and all process groups. */
function endAfterSignal() {
  processGroups.forEach(endGroup);
  process.exit(130);
}

/** Arranges that a process group is ended when this process is. @param {number} group */
export function endGroupWithProcess(group) {
  processGroups.add(group);
  for (const signal of ['SIGINT', 'SIGTERM']) process.off(signal, endAfterSignal).on(signal, endAfterSignal);
}

/** Removes an ended process group from those that are ended with this process. @param {number} group */
export function forgetGroup(group) {
  processGroups.delete(group);
  // Signals have their usual meaning while no program runs.
  if (processGroups.size === 0) for (const signal of ['SIGINT', 'SIGTERM']) process.off(signal, endAfterSignal);
}

/** Milliseconds without output after which the name of the running program is printed. */
const MAX_SILENCE_MS = 30_000;

/**
 * @typedef {object} RunOptions
 * @property {Record<string, string>} [env] added to the present environment
 * @property {string} [cwd] working directory; default: the root of the repository
 * @property {number} [seconds] time limit, after which the program and its children are killed
 * @property {boolean} [quiet] true if the output is not printed
 */

/**
 * Runs a program, showing its output as it comes, and its name while it is silent.
 *
 * @param {string} command
 * @param {string[]} args
 * @param {RunOptions} [options]
 * @returns {Promise<{ ok: boolean, timedOut: boolean, stdout: string, output: string }>} `output` is stdout and
 *   stderr in order of arrival; a program that cannot be started is not ok
 */
export function run(command, args, { env = {}, cwd = ROOT, seconds, quiet = false } = {}) {
  return new Promise((resolve) => {
    // A program with a time limit leads its own process group, so that its children can be ended with it.
    const childProcess = spawn(command, args, {
      cwd,
      env: { ...process.env, ...env },
      stdio: ['ignore', 'pipe', 'pipe'],
      detached: seconds !== undefined,
    });
    let stdout = '';
    let combinedOutput = '';
    let timedOut = false;
    const startTime = Date.now();
    const silenceTimer = collectedOutputStore.getStore() ? undefined : setInterval(() => {
      print(`  ${basename(command)} ${basename(args[0] ?? '')} has been running for ${Math.round((Date.now() - startTime) / 1000)} s\n`);
    }, MAX_SILENCE_MS);
    const processGroupId = seconds === undefined ? undefined : childProcess.pid;
    /** @type {NodeJS.Timeout | undefined} */
    let limitTimer;
    if (seconds !== undefined && processGroupId !== undefined) {
      endGroupWithProcess(processGroupId);
      limitTimer = setTimeout(() => {
        timedOut = true;
        endGroup(processGroupId);
      }, seconds * 1000);
    }
    childProcess.stdout.setEncoding('utf8').on('data', (text) => {
      stdout += text;
      combinedOutput += text;
      silenceTimer?.refresh();
      if (!quiet) print(text);
    });
    childProcess.stderr.setEncoding('utf8').on('data', (text) => {
      combinedOutput += text;
      silenceTimer?.refresh();
      if (!quiet) print(text, process.stderr);
    });
    const settleRun = (/** @type {boolean} */ ok) => {
      clearTimeout(limitTimer);
      clearInterval(silenceTimer);
      if (processGroupId !== undefined) forgetGroup(processGroupId);
      resolve({ ok, timedOut, stdout, output: combinedOutput });
    };
    childProcess.on('error', () => settleRun(false));
    childProcess.on('close', (code) => settleRun(code === 0));
  });
}

/**
 * Runs a program that has to succeed.
 *
 * @param {string} message message of the `UserError` that is thrown if the program fails
 * @param {string} command
 * @param {string[]} args
 * @param {RunOptions} [options]
 */
export async function mustRun(message, command, args, options) {
  const runResult = await run(command, args, options);
  if (!runResult.ok) {
    if (options?.quiet) print(runResult.output, process.stderr);
    throw new UserError(message);
  }
  return runResult;
}

/**
 * Returns the full path of a program.
 *
 * @param {string} name
 * @param {string[]} [moreDirectories] directories that are searched after those of PATH
 * @returns {string | undefined} undefined if it is not found
 */
export function findProgram(name, moreDirectories = []) {
  return [...(process.env.PATH ?? '').split(delimiter), ...moreDirectories]
    .map((directory) => join(directory, name))
    .find(isProgram);
}

/** Returns true if a file can be executed. @param {string} path */
export function isProgram(path) {
  try {
    accessSync(path, constants.X_OK);
    return statSync(path).isFile();
  } catch {
    return false;
  }
}

/** Returns the files in a directory, sorted, or a file. @param {string} path from the root */
export function filesOf(path) {
  if (statSync(join(ROOT, path)).isFile()) return [path];
  return readdirSync(join(ROOT, path), { withFileTypes: true, recursive: true })
    .filter((entry) => entry.isFile())
    .map((entry) => relative(ROOT, join(entry.parentPath, entry.name)))
    .sort();
}
