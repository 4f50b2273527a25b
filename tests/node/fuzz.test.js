// Bytes that are nearly right, into everything that www/ parses. Ten million of them, guided, are `npm run test:fuzz`.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { keptOf } from '../fuzz/corpus.js';
import { execute } from '../fuzz/executions.js';
import { targets } from '../fuzz/targets.js';

/** Of each target: a second's worth, about. */
const EXECUTIONS = 1000;

for (const name of Object.keys(targets)) {
  test(`${name}: a result or a sentence`, async () => {
    const { taken, slowest, megabytes } = await execute(name, EXECUTIONS, 1);
    // Neither does everything get in, nor is everything turned away before it is read.
    assert.ok(taken > 0 && taken < EXECUTIONS, `${taken} of ${EXECUTIONS} are taken`);
    console.log(`${name}: ${taken} of ${EXECUTIONS} are taken, the slowest ${(1000 * slowest).toFixed(0)} ms, ${megabytes.toFixed(0)} MB`);
  });
}

test('what fuzzing found worth keeping is there', () => {
  const without = Object.keys(targets).filter((name) => keptOf(name).length === 0);
  assert.deepEqual(without, []);
});
