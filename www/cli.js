#!/usr/bin/env node
/** `npx motion-widgets calibrate`: α's from a log, for those who never open a browser. */

import { load } from './core.ts';
import { run } from './cli/run.js';

// A reader such as `head` may close the pipe.
process.stdout.on('error', (error) => {
  if (/** @type {NodeJS.ErrnoException} */ (error).code !== 'EPIPE') throw error;
});

process.exitCode = await run(process.argv.slice(2), {
  load,
  print: (text) => process.stdout.write(text),
  complain: (text) => process.stderr.write(text),
});
