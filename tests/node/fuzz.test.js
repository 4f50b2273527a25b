// Seeded mutations of valid files, links, states and attributes, given to each parser of www/. Each input must end in a result or in an
// error message, within a second and in little memory.

import assert from 'node:assert/strict';
import { Buffer } from 'node:buffer';
import { existsSync, readFileSync } from 'node:fs';
import { test } from 'node:test';
import { setImmediate as yieldToEventLoop } from 'node:timers/promises';
import { createMutant } from '../fuzz/mutate.js';
import { fuzzTargets } from '../fuzz/targets.js';
import { createRandomGenerator } from '../random.js';

/** Number of mutations for each target. The nightly job sets a larger number and another seed. */
const INPUT_COUNT = Number(process.env.FUZZ_INPUTS ?? 400);
const FUZZ_SEED = Number(process.env.FUZZ_SEED ?? 1);

/** Maximum processor time of one input, s, and maximum memory growth of all inputs, bytes. */
const [MAX_SECONDS, MAX_BYTES] = [1, 256 * 2 ** 20];

/** Number of inputs after which the test yields to the event loop, so that decompressed data can be released. */
const INPUTS_PER_TURN = 100;

/** Returns the inputs of a target that fuzzing found. The corpus file has one input a line, in hexadecimal. @param {string} targetName */
function readFoundInputs(targetName) {
  const corpusFile = new URL(`../fuzz/corpus/${targetName}.txt`, import.meta.url);
  const inputLines = existsSync(corpusFile) ? readFileSync(corpusFile, 'latin1').split('\n').slice(0, -1) : [];
  return inputLines.map((hexLine) => Buffer.from(hexLine, 'hex'));
}

for (const [targetName, { corpus, run }] of Object.entries(fuzzTargets)) {
  test(`${targetName}: every input gives a result or an error message`, async () => {
    const drawRandom = createRandomGenerator(FUZZ_SEED);
    const allInputs = [...corpus, ...readFoundInputs(targetName)];
    /** Runs a target on an input, and returns true if the input is accepted. @param {Buffer<ArrayBuffer>} inputBytes */
    const checkInput = async (inputBytes) => {
      const cpuBefore = process.cpuUsage();
      try {
        const isAccepted = await run(inputBytes);
        const { user, system } = process.cpuUsage(cpuBefore);
        assert.ok(user + system < 1e6 * MAX_SECONDS, `${user + system} µs`);
        return isAccepted;
      } catch (error) {
        throw new Error(`${targetName} fails on ${inputBytes.toString('hex')}`, { cause: error });
      }
    };
    for (const inputBytes of allInputs) await checkInput(Buffer.from(inputBytes));
    const memoryBefore = process.resourceUsage().maxRSS;
    let acceptedCount = 0;
    for (let i = 0; i < INPUT_COUNT; i++) {
      // Inputs that fuzzing found are mostly refused. For that reason half of the mutations start from valid inputs.
      if (await checkInput(createMutant(drawRandom() < 0.5 ? corpus : allInputs, drawRandom))) acceptedCount += 1;
      if (i % INPUTS_PER_TURN === 0) await yieldToEventLoop();
    }
    assert.ok(acceptedCount > 0 && acceptedCount < INPUT_COUNT, `${acceptedCount} of ${INPUT_COUNT} are accepted`);
    const memoryGrowth = 1024 * (process.resourceUsage().maxRSS - memoryBefore);
    assert.ok(memoryGrowth < MAX_BYTES, `${memoryGrowth} bytes`);
  });
}
