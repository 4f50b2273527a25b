// Servers that tests start.

import { spawn } from 'node:child_process';
import { ROOT, end, endWithUs, hasEnded } from '../../scripts/process.mjs';

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
  if (group !== undefined) endWithUs(group);
  let output = '';
  for (const stream of [child.stdout, child.stderr]) stream.setEncoding('utf8').on('data', (text) => (output += text));
  /** @type {Promise<void>} */
  const ended = new Promise((resolve) => {
    child.on('error', (error) => {
      output += error.message;
      resolve();
    });
    child.on('close', () => {
      if (group !== undefined) hasEnded(group);
      resolve();
    });
  });
  return {
    output: () => output,
    said: (pattern) =>
      new Promise((resolve, reject) => {
        const look = () => {
          const found = output.match(pattern);
          if (found) resolve(found[1]);
        };
        for (const stream of [child.stdout, child.stderr]) stream.on('data', look);
        ended.then(() => reject(new Error(`${command} has ended:\n${output}`)));
        look();
      }),
    ended,
    stop() {
      if (group !== undefined) end(group);
      return ended;
    },
  };
}
