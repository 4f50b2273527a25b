// Runs other programs, reports in one sentence what is missing, and lists files. This script imports only Node built-ins, because it runs in a bare clone.

import { AsyncLocalStorage } from 'node:async_hooks';
import { spawn } from 'node:child_process';
import { accessSync, constants, readdirSync, realpathSync, statSync } from 'node:fs';
import { basename, delimiter, join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';

export const REPOSITORY_ROOT = fileURLToPath(new URL('..', import.meta.url));

/** Returns the absolute path of a file of the repository. @param {string} repositoryPath */
export const absolutePathOf = (repositoryPath) => join(REPOSITORY_ROOT, repositoryPath);

/** Error about something that the user has to provide or correct. Its message is printed without a stack trace. */
export class UserError extends Error {}

/** Collected output of work that runs in parallel with other work. @type {AsyncLocalStorage<string[]>} */
const collectedOutputStore = new AsyncLocalStorage();

/** Prints text, or adds the text to the collected output. @param {string} printedText @param {NodeJS.WriteStream} [outputStream] */
function printText(printedText, outputStream = process.stdout) {
  const outputTexts = collectedOutputStore.getStore();
  if (outputTexts === undefined) outputStream.write(printedText);
  else outputTexts.push(printedText);
}

/**
 * Collects the output of work that runs in parallel with other work, and prints it at the end.
 *
 * @template T
 * @param {() => Promise<T>} doWork
 * @returns {Promise<T>} result of the work
 */
export async function collectOutputOf(doWork) {
  /** @type {string[]} */
  const outputTexts = [];
  try {
    return await collectedOutputStore.run(outputTexts, doWork);
  } finally {
    printText(outputTexts.join(''));
  }
}

/** Prints the name of the step that begins. @param {string} stepText */
export function printStep(stepText) {
  printText(`\n▸ ${stepText}\n`);
}

/**
 * Returns a function that does its work at the first call only, and returns the same result at every call.
 *
 * @template T
 * @param {() => Promise<T>} doWork
 * @returns {() => Promise<T>}
 */
export function memoizeWork(doWork) {
  /** @type {Promise<T> | undefined} */
  let resultPromise;
  return () => (resultPromise ??= doWork());
}

/** Returns a function that runs tasks one after the other. @returns {<T>(work: () => Promise<T>) => Promise<T>} */
export function createTaskQueue() {
  /** @type {Promise<unknown>} */
  let lastTask = Promise.resolve();
  return (doWork) => {
    const taskResult = lastTask.then(doWork);
    lastTask = taskResult.catch(() => {});
    return taskResult;
  };
}

/**
 * Waits until all promises are settled. If work continued after a failure, it would write files that the next run reads.
 *
 * @template {Promise<unknown>[] | []} T
 * @param {T} pendingPromises
 * @returns {Promise<{ -readonly [K in keyof T]: Awaited<T[K]> }>} rejected with the first failure
 */
export async function settleAll(pendingPromises) {
  await Promise.allSettled(pendingPromises);
  return /** @type {Promise<any>} */ (Promise.all(pendingPromises));
}

/**
 * Runs a script's main function if node was started with that script. An error prints one sentence, and sets exit code 1.
 *
 * @param {string} scriptUrl import.meta.url of the script
 * @param {() => Promise<unknown>} mainFunction
 */
export async function runAsScript(scriptUrl, mainFunction) {
  if (process.argv[1] === undefined || realpathSync(process.argv[1]) !== fileURLToPath(scriptUrl)) return;
  try {
    const [nodeMajor, nodeMinor] = process.versions.node.split('.').map(Number);
    if (nodeMajor < 20 || (nodeMajor === 20 && nodeMinor < 19)) {
      throw new UserError(`Node 20.19 or newer is needed and this is ${process.versions.node}: install it from nodejs.org.`);
    }
    await mainFunction();
  } catch (error) {
    console.error(`\n${error instanceof UserError ? error.message : (error instanceof Error && error.stack) || error}`);
    process.exitCode = 1;
  }
}

/** Process groups that end when this process is interrupted. @type {Set<number>} */
const processGroups = new Set();

/** Ends a process group. @param {number} processGroupId */
export function killProcessGroup(processGroupId) {
  try {
    process.kill(-processGroupId, 'SIGKILL');
  } catch {
    // The process group has already ended.
  }
}

/** Ends this process, and all process groups that it has started. */
function endAfterSignal() {
  processGroups.forEach(killProcessGroup);
  process.exit(130);
}

/** Arranges that a process group ends when this process ends. @param {number} processGroupId */
export function endGroupWithProcess(processGroupId) {
  processGroups.add(processGroupId);
  for (const processSignal of ['SIGINT', 'SIGTERM']) process.off(processSignal, endAfterSignal).on(processSignal, endAfterSignal);
}

/** Removes an ended process group from `processGroups`. @param {number} processGroupId */
export const forgetProcessGroup = (processGroupId) => processGroups.delete(processGroupId);

/** Milliseconds without output after which the name of the running program is printed. */
const MAX_SILENCE_MS = 30_000;

/**
 * @typedef {object} RunOptions
 * @property {Record<string, string>} [env] variables that are added to the present environment
 * @property {string} [cwd] working directory; default: the root of the repository
 * @property {number} [timeLimitSeconds] time limit, after which the program and its children are killed
 * @property {boolean} [isQuiet] true if the output is not printed
 */

/**
 * Runs a program. Shows the program's output as it arrives, and the program's name if there is no output for a while.
 *
 * @param {string} programName
 * @param {string[]} commandArguments
 * @param {RunOptions} [options]
 * @returns {Promise<{ hasSucceeded: boolean, hasTimedOut: boolean, stdout: string, output: string }>} `output` is stdout and
 *   stderr in order of arrival; a program that cannot be started has not succeeded
 */
export function runProgram(programName, commandArguments, { env = {}, cwd = REPOSITORY_ROOT, timeLimitSeconds, isQuiet = false } = {}) {
  return new Promise((resolveResult) => {
    // A program with a time limit leads its own process group, so that its children end with it.
    const childProcess = spawn(programName, commandArguments, {
      cwd,
      env: { ...process.env, ...env },
      stdio: ['ignore', 'pipe', 'pipe'],
      detached: timeLimitSeconds !== undefined,
    });
    let stdoutText = '';
    let combinedOutput = '';
    let hasTimedOut = false;
    const startTime = Date.now();
    const silenceTimer = collectedOutputStore.getStore() ? undefined : setInterval(() => {
      printText(`  ${basename(programName)} ${basename(commandArguments[0] ?? '')} has been running for ${Math.round((Date.now() - startTime) / 1000)} s\n`);
    }, MAX_SILENCE_MS);
    const processGroupId = timeLimitSeconds === undefined ? undefined : childProcess.pid;
    /** @type {NodeJS.Timeout | undefined} */
    let limitTimer;
    if (timeLimitSeconds !== undefined && processGroupId !== undefined) {
      endGroupWithProcess(processGroupId);
      limitTimer = setTimeout(() => {
        hasTimedOut = true;
        killProcessGroup(processGroupId);
      }, timeLimitSeconds * 1000);
    }
    childProcess.stdout.setEncoding('utf8').on('data', (outputText) => {
      stdoutText += outputText;
      combinedOutput += outputText;
      silenceTimer?.refresh();
      if (!isQuiet) printText(outputText);
    });
    childProcess.stderr.setEncoding('utf8').on('data', (text) => {
      combinedOutput += text;
      silenceTimer?.refresh();
      if (!isQuiet) printText(text, process.stderr);
    });
    const finishRun = (/** @type {boolean} */ hasSucceeded) => {
      clearTimeout(limitTimer);
      clearInterval(silenceTimer);
      if (processGroupId !== undefined) forgetProcessGroup(processGroupId);
      resolveResult({ hasSucceeded, hasTimedOut, stdout: stdoutText, output: combinedOutput });
    };
    childProcess.on('error', () => finishRun(false));
    childProcess.on('close', (exitCode) => finishRun(exitCode === 0));
  });
}

/**
 * Runs a program that must succeed.
 *
 * @param {string} failureMessage message of the `UserError` that is thrown if the program fails
 * @param {string} programName
 * @param {string[]} commandArguments
 * @param {RunOptions} [runOptions]
 */
export async function runOrThrow(failureMessage, programName, commandArguments, runOptions) {
  const runResult = await runProgram(programName, commandArguments, runOptions);
  if (!runResult.hasSucceeded) {
    if (runOptions?.isQuiet) printText(runResult.output, process.stderr);
    throw new UserError(failureMessage);
  }
  return runResult;
}

/**
 * Returns the full path of a program.
 *
 * @param {string} programName
 * @param {string[]} [moreDirectories] directories that are searched after those of PATH
 * @returns {string | undefined} undefined if it is not found
 */
export function findProgram(programName, moreDirectories = []) {
  return [...(process.env.PATH ?? '').split(delimiter), ...moreDirectories]
    .map((searchDirectory) => join(searchDirectory, programName))
    .find(isProgram);
}

/** Returns true if a file can be executed. @param {string} filePath */
export function isProgram(filePath) {
  try {
    accessSync(filePath, constants.X_OK);
    return statSync(filePath).isFile();
  } catch {
    return false;
  }
}

/** Returns the sorted files in a directory. For a file, returns the file itself. @param {string} fileOrDirectory relative to the root of the repository */
export function filesOf(fileOrDirectory) {
  if (statSync(absolutePathOf(fileOrDirectory)).isFile()) return [fileOrDirectory];
  return readdirSync(absolutePathOf(fileOrDirectory), { withFileTypes: true, recursive: true })
    .filter((directoryEntry) => directoryEntry.isFile())
    .map((directoryEntry) => relative(REPOSITORY_ROOT, join(directoryEntry.parentPath, directoryEntry.name)))
    .sort();
}
