// Bytes that are nearly right, into everything that www/ parses. Ten million of them, guided, are `npm run test:fuzz`.

import { test } from 'node:test';
import { execute } from '../fuzz/executions.js';
import { targets } from '../fuzz/targets.js';

/** Of each target: a second's worth, about. */
const EXECUTIONS = 1000;

for (const name of Object.keys(targets)) {
  test(`${name}: a result or a sentence`, async () => {
    const { taken, slowest, megabytes } = await execute(name, EXECUTIONS, 1);
    console.log(`${name}: ${taken} of ${EXECUTIONS} are taken, the slowest ${(1000 * slowest).toFixed(0)} ms, ${megabytes.toFixed(0)} MB`);
  });
}
