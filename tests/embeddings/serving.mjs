/**
 * Starts servers for the sites of the engines: a file server, or the server of an engine.
 *
 * @module
 */

import { spawn } from 'node:child_process';
import { createServer } from 'node:net';
import { join } from 'node:path';
import { ROOT, endGroup, endGroupWithProcess, forgetGroup } from '../../scripts/process.mjs';
import { serve } from '../../scripts/serve.mjs';

/** Seconds until a server has to answer. */
const TIMEOUT_SECONDS = 120;

/**
 * Serves the files that a build has written, with a plain file server.
 *
 * @param {string} output directory of the files, relative to the copy of the example
 * @param {string} [base] configured path of the site, with a slash at both ends
 * @returns {import('./project.mjs').Serving['serve']}
 */
export const files = (output, base) => async (directory) => {
  const { address, close } = await serve(join(directory, output), { port: 0, base });
  return { url: address, stop: close };
};

/**
 * Starts the server of an engine, and waits until it answers.
 *
 * @param {(port: string) => [command: string, args: string[], env?: Record<string, string>]} command that starts it
 * @param {string} [base] the path of the site, with a slash at both ends
 * @returns {import('./project.mjs').Serving['serve']}
 */
export const program = (command, base = '/') => async (_directory, { start }) => {
  const port = await freePort();
  const url = `http://localhost:${port}${base}`;
  const server = start(...command(`${port}`));
  const ended = server.ended.then(() => {
    throw new Error(`The server has ended:\n${server.output()}`);
  });
  try {
    await Promise.race([untilAnswered(url), ended]);
  } catch (error) {
    await server.stop();
    throw error;
  }
  // The server may end from now on.
  ended.catch(() => {});
  return { url, stop: server.stop };
};

/** @returns {Promise<number>} a free port */
function freePort() {
  return new Promise((resolve, reject) => {
    const server = createServer().on('error', reject);
    server.listen(0, 'localhost', () => {
      const address = server.address();
      server.close(() => (address === null || typeof address === 'string' ? reject(new Error('There is no port.')) : resolve(address.port)));
    });
  });
}

/** Waits until a server answers with status 200. @param {string} url */
async function untilAnswered(url) {
  const deadline = Date.now() + TIMEOUT_SECONDS * 1000;
  for (;;) {
    const status = await fetch(url, { signal: AbortSignal.timeout(TIMEOUT_SECONDS * 1000) }).then(({ status }) => status, String);
    if (status === 200) return;
    if (Date.now() > deadline) throw new Error(`${url} has not answered for ${TIMEOUT_SECONDS} s; the last was ${status}.`);
    // No event tells when a server begins to listen.
    await new Promise((resolve) => setTimeout(resolve, 200));
  }
}

/**
 * Starts a server, and ends it with all its children at the latest with this process.
 *
 * @param {string} command
 * @param {string[]} args
 * @param {{ env?: Record<string, string>, cwd?: string }} [options]
 * @returns {{ output: () => string, said: (pattern: RegExp) => Promise<string>, ended: Promise<void>, stop: () => Promise<void> }}
 *   `output` returns the text printed so far; `said` waits for a match of a pattern and returns its first group; both other
 *   promises are resolved when the program has ended
 */
export function start(command, args, { env = {}, cwd = ROOT } = {}) {
  const child = spawn(command, args, { cwd, env: { ...process.env, ...env }, stdio: ['ignore', 'pipe', 'pipe'], detached: true });
  const group = child.pid;
  if (group !== undefined) endGroupWithProcess(group);
  let output = '';
  for (const stream of [child.stdout, child.stderr]) stream.setEncoding('utf8').on('data', (text) => (output += text));
  /** @type {Promise<void>} */
  const ended = new Promise((resolve) => {
    child.on('error', (error) => {
      output += error.message;
      resolve();
    });
    child.on('close', () => {
      if (group !== undefined) forgetGroup(group);
      resolve();
    });
  });
  return {
    output: () => output,
    said: (pattern) =>
      new Promise((resolve, reject) => {
        const checkOutput = () => {
          const match = output.match(pattern);
          if (match) resolve(match[1]);
        };
        for (const stream of [child.stdout, child.stderr]) stream.on('data', checkOutput);
        ended.then(() => reject(new Error(`${command} has ended:\n${output}`)));
        checkOutput();
      }),
    ended,
    stop() {
      if (group !== undefined) endGroup(group);
      return ended;
    },
  };
}
