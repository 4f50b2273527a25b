// Bytes that are nearly right, into everything that www/ parses: a result or a sentence, soon, and in little memory.
// The long run is `FUZZ_EXECUTIONS=10000000 node --test tests/node/fuzz.test.js`; FUZZ_SEED begins elsewhere, and FUZZ_TARGET
// names one of them.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { mutantOf } from '../fuzz/mutate.js';
import { targets } from '../fuzz/targets.js';
import { generator } from '../random.js';

const EXECUTIONS = Number(process.env.FUZZ_EXECUTIONS ?? 1000);
const SEED = Number(process.env.FUZZ_SEED ?? 1);

/** Seconds of a processor that one of them may take, and bytes that all of them may. */
const [MOST_SECONDS, MOST_BYTES] = [1, 256 * 2 ** 20];

const { FUZZ_TARGET } = process.env;
for (const [name, { corpus, run }] of Object.entries(targets).filter(([name]) => !FUZZ_TARGET || name === FUZZ_TARGET)) {
  test(`${name}: a result or a sentence`, async () => {
    const random = generator(SEED);
    for (const bytes of corpus) await run(Buffer.from(bytes));
    const before = process.resourceUsage().maxRSS;
    let slowest = 0;
    let taken = 0;
    for (let i = 0; i < EXECUTIONS; i++) {
      const bytes = mutantOf(corpus, random);
      const start = process.cpuUsage();
      try {
        if (await run(bytes)) taken += 1;
      } catch (error) {
        throw new Error(`number ${i} of seed ${SEED}: ${bytes.toString('base64')}`, { cause: error });
      }
      const { user, system } = process.cpuUsage(start);
      slowest = Math.max(slowest, (user + system) / 1e6);
      assert.ok(slowest < MOST_SECONDS, `number ${i} of seed ${SEED} took ${slowest} s: ${bytes.toString('base64')}`);
    }
    const grown = 1024 * (process.resourceUsage().maxRSS - before);
    assert.ok(grown < MOST_BYTES, `${grown} bytes`);
    // Neither does everything get in, nor is everything turned away before it is read.
    assert.ok(taken > 0 && taken < EXECUTIONS, `${taken} of ${EXECUTIONS} are taken`);
    console.log(`${name}: ${EXECUTIONS} executions, ${taken} taken, the slowest ${(1000 * slowest).toFixed(0)} ms, ${(grown / 2 ** 20).toFixed(0)} MB`);
  });
}
