// Seeded mutations of valid files, links, states and attributes, given to each parser of www/. Each input has to end in a
// result or in a sentence, within a second and in little memory.

import assert from 'node:assert/strict';
import { Buffer } from 'node:buffer';
import { existsSync, readFileSync } from 'node:fs';
import { test } from 'node:test';
import { setImmediate as turn } from 'node:timers/promises';
import { mutantOf } from '../fuzz/mutate.js';
import { targets } from '../fuzz/targets.js';
import { generator } from '../random.js';

/** Mutations of each target. The nightly job sets more, and another seed. */
const INPUTS = Number(process.env.FUZZ_INPUTS ?? 400);
const SEED = Number(process.env.FUZZ_SEED ?? 1);

/** Limits of one input in seconds of processor time, and of all inputs in bytes. */
const [MAX_SECONDS, MAX_BYTES] = [1, 256 * 2 ** 20];

/** Inputs between two turns of the event loop, which releases inflated data. */
const BATCH = 100;

/** Inputs of a target that fuzzing found: hexadecimal, one a line. @param {string} target */
function kept(target) {
  const file = new URL(`../fuzz/corpus/${target}.txt`, import.meta.url);
  const lines = existsSync(file) ? readFileSync(file, 'latin1').split('\n').slice(0, -1) : [];
  return lines.map((line) => Buffer.from(line, 'hex'));
}

for (const [name, { corpus, run }] of Object.entries(targets)) {
  test(`${name}: every input gives a result or a sentence`, async () => {
    const random = generator(SEED);
    const seeds = [...corpus, ...kept(name)];
    /** @param {Buffer<ArrayBuffer>} bytes */
    const check = async (bytes) => {
      const start = process.cpuUsage();
      try {
        const taken = await run(bytes);
        const { user, system } = process.cpuUsage(start);
        assert.ok(user + system < 1e6 * MAX_SECONDS, `${user + system} µs`);
        return taken;
      } catch (error) {
        throw new Error(`${name} fails on ${bytes.toString('hex')}`, { cause: error });
      }
    };
    for (const bytes of seeds) await check(Buffer.from(bytes));
    const before = process.resourceUsage().maxRSS;
    let taken = 0;
    for (let i = 0; i < INPUTS; i++) {
      // Found inputs are mostly refused: half of the mutations start from valid ones.
      if (await check(mutantOf(random() < 0.5 ? corpus : seeds, random))) taken += 1;
      if (i % BATCH === 0) await turn();
    }
    assert.ok(taken > 0 && taken < INPUTS, `${taken} of ${INPUTS} are taken`);
    const grown = 1024 * (process.resourceUsage().maxRSS - before);
    assert.ok(grown < MAX_BYTES, `${grown} bytes`);
  });
}
