#!/usr/bin/env node
/** Program `npx motion-widgets`: calibrates α's from logs in a terminal. */

import { readFileSync } from 'node:fs';
import { load } from './core.ts';
import { runCommand } from './cli/run.ts';

// A program that reads this output through a pipe, such as `head`, may close the pipe before the end. That is no error.
process.stdout.on('error', (error) => {
  if ((error as NodeJS.ErrnoException).code !== 'EPIPE') throw error;
});

const { stdout, stderr } = process;
/** Percentage of progress that the terminal shows; −1 if it shows none. */
let shownPercent = -1;

process.exitCode = await runCommand(process.argv.slice(2), {
  load,
  print: (outputText) => stdout.write(outputText),
  printError: (outputText) => stderr.write(outputText),
  version: JSON.parse(readFileSync(new URL('../package.json', import.meta.url), 'utf8')).version,
  isColored: stdout.isTTY && !process.env.NO_COLOR,
  onProgress(progressFraction) {
    const newPercent = progressFraction === undefined ? -1 : Math.floor(100 * progressFraction);
    if (!stderr.isTTY || newPercent === shownPercent) return;
    shownPercent = newPercent;
    stderr.write(progressFraction === undefined ? '\r\x1b[K' : `\rreading ${newPercent} %`);
  },
});
