// Servers for the test sites that site generators and frameworks build. A site has a file server, or the server of its framework.

import { spawn } from 'node:child_process';
import { join } from 'node:path';
import { REPOSITORY_ROOT, killProcessGroup, endGroupWithProcess, forgetProcessGroup } from '../../scripts/process.mjs';
import { startServer } from '../../scripts/serve.mjs';

/** Time limit in seconds within which a server has to answer. */
const TIMEOUT_SECONDS = 120;

/**
 * Serves the files of a build by a plain file server.
 *
 * @param {string} outputDirectory directory of the files, relative to the copy of the example
 * @param {string} [basePath] configured path of the site, with a slash at both ends
 * @returns {import('./project.mjs').ServerMode['serve']}
 */
export const serveFiles = (outputDirectory, basePath) => async (projectDirectory) => {
  const { address: pageAddress, close: stopServer } = await startServer(join(projectDirectory, outputDirectory), { port: 0, base: basePath });
  return { url: pageAddress, stop: stopServer };
};

/**
 * Starts the server of a site generator or framework, and waits until the server answers.
 *
 * @param {(port: string, directory: string) => [command: string, args: string[], env?: Record<string, string>]} commandOf returns the command that starts the server
 * @param {string} [basePath] path of the site, with a slash at both ends
 * @returns {import('./project.mjs').ServerMode['serve']}
 */
export const serveByProgram = (commandOf, basePath = '/') => async (projectDirectory, { start }) => {
  const port = await findFreePort();
  const url = `http://localhost:${port}${basePath}`;
  const platformServer = start(...commandOf(port, projectDirectory));
  const earlyEndPromise = platformServer.whenEnded.then(() => {
    throw new Error(`The server has ended:\n${platformServer.getOutput()}`);
  });
  try {
    await Promise.race([waitUntilAnswered(url), earlyEndPromise]);
  } catch (error) {
    await platformServer.stop();
    throw error;
  }
  // After the server has answered, the end of its process is not an error.
  earlyEndPromise.catch(() => {});
  return { url, stop: platformServer.stop };
};

/** Returns a free port, which a temporary server has just released. */
async function findFreePort() {
  const { address: pageAddress, close: stopServer } = await startServer(REPOSITORY_ROOT, { port: 0 });
  stopServer();
  return new URL(pageAddress).port;
}

/** Waits until a server answers with status 200. @param {string} url */
async function waitUntilAnswered(url) {
  const answerDeadline = Date.now() + TIMEOUT_SECONDS * 1000;
  for (;;) {
    const lastStatus = await fetch(url, { signal: AbortSignal.timeout(TIMEOUT_SECONDS * 1000) }).then(({ status: httpStatus }) => httpStatus, String);
    if (lastStatus === 200) return;
    if (Date.now() > answerDeadline) throw new Error(`${url} has not answered for ${TIMEOUT_SECONDS} s; the last was ${lastStatus}.`);
    // A server sends no event when it begins to listen, so that it must be polled.
    await new Promise((resolve) => setTimeout(resolve, 200));
  }
}

/**
 * Starts a program. The program and its children end with this process at the latest.
 *
 * @param {string} programName
 * @param {string[]} commandArguments
 * @param {{ env?: Record<string, string>, cwd?: string }} [options]
 * @returns {{ getOutput: () => string, waitForOutput: (pattern: RegExp) => Promise<string>, whenEnded: Promise<void>, stop: () => Promise<void> }}
 *   `getOutput` returns the text printed so far; `waitForOutput` waits for a match of a pattern and returns its first group;
 *   `whenEnded`, and the promise of `stop`, are resolved when the program has ended
 */
export function startProgram(programName, commandArguments, { env = {}, cwd = REPOSITORY_ROOT } = {}) {
  const childProcess = spawn(programName, commandArguments, { cwd, env: { ...process.env, ...env }, stdio: ['ignore', 'pipe', 'pipe'], detached: true });
  const groupId = childProcess.pid;
  if (groupId !== undefined) endGroupWithProcess(groupId);
  let outputText = '';
  for (const outputStream of [childProcess.stdout, childProcess.stderr]) outputStream.setEncoding('utf8').on('data', (outputChunk) => (outputText += outputChunk));
  /** @type {Promise<void>} */
  const endPromise = new Promise((resolve) => {
    childProcess.on('error', (error) => {
      outputText += error.message;
      resolve();
    });
    childProcess.on('close', () => {
      if (groupId !== undefined) forgetProcessGroup(groupId);
      resolve();
    });
  });
  return {
    getOutput: () => outputText,
    waitForOutput: (outputPattern) =>
      new Promise((resolve, reject) => {
        const checkOutput = () => {
          const outputMatch = outputText.match(outputPattern);
          if (outputMatch) resolve(outputMatch[1]);
        };
        for (const stream of [childProcess.stdout, childProcess.stderr]) stream.on('data', checkOutput);
        endPromise.then(() => reject(new Error(`${programName} has ended:\n${outputText}`)));
        checkOutput();
      }),
    whenEnded: endPromise,
    stop() {
      if (groupId !== undefined) killProcessGroup(groupId);
      return endPromise;
    },
  };
}
