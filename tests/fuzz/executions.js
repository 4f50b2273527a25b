/** A target under inputs that are nearly right: a result or a sentence, soon, and in little memory. */

import assert from 'node:assert/strict';
import { Buffer } from 'node:buffer';
import { setImmediate as turn } from 'node:timers/promises';
import { generator } from '../random.js';
import { keep, keptOf } from './corpus.js';
import { mutantOf } from './mutate.js';
import { targets } from './targets.js';

/** @import { Reached } from './reached.js' */

/** Seconds of a processor that one of them may take, and bytes that all of them may. */
const [MOST_SECONDS, MOST_BYTES] = [1, 256 * 2 ** 20];

/** Seconds by the clock from which on it is asked what a processor had of them: that takes as long as some inputs do. */
const LONG = MOST_SECONDS / 10;

/** Inputs between two looks at what they reached: a look takes as long as dozens. */
const BATCH = 1000;

/**
 * @param {string} name of the target
 * @param {number} count of the inputs, besides those that are kept
 * @param {number} seed
 * @param {Reached} [reached] has what reaches anything new changed in its turn, and kept in build/fuzz
 */
export async function execute(name, count, seed, reached) {
  const { corpus, run } = targets[name];
  const random = generator(seed);
  const inputs = [...corpus, ...keptOf(name)];
  let [slowest, taken, done] = [0, 0, 0];

  /** @param {Buffer<ArrayBuffer>} bytes */
  const one = async (bytes) => {
    const start = performance.now();
    const about = () => `number ${done} of seed ${seed}: ${bytes.toString('base64')}`;
    try {
      if (await run(bytes)) taken += 1;
    } catch (error) {
      throw new Error(about(), { cause: error });
    }
    const seconds = (performance.now() - start) / 1000;
    slowest = Math.max(slowest, seconds < LONG ? seconds : await secondsOfProcessor(() => run(bytes)));
    assert.ok(slowest < MOST_SECONDS, `${slowest} s, ${about()}`);
  };

  /**
   * Learns which of some inputs reach anything new: those of a half in which none does need no look of their own.
   *
   * @param {Buffer<ArrayBuffer>[]} some
   * @param {Reached} reached
   */
  const learnFrom = async (some, reached) => {
    for (const bytes of some) await run(bytes);
    const places = await reached.look();
    if (!reached.isNews(places)) return;
    if (some.length > 1) {
      const half = some.length >> 1;
      await learnFrom(some.slice(0, half), reached);
      await learnFrom(some.slice(half), reached);
    } else {
      inputs.push(some[0]);
      keep(name, some[0]);
    }
    // Some is reached only after another input.
    reached.learn(places);
  };

  for (const bytes of inputs) await one(Buffer.from(bytes));
  reached?.learn(await reached.look());
  const before = process.resourceUsage().maxRSS;
  taken = 0;
  while (done < count) {
    // What is found is hardly ever taken: half of them begin as something that is.
    const batch = Array.from({ length: Math.min(BATCH, count - done) }, () => mutantOf(random() < 0.5 ? corpus : inputs, random));
    for (const bytes of batch) {
      await one(bytes);
      done += 1;
    }
    // What was inflated is let go between two turns only.
    await turn();
    if (!reached) continue;
    const places = await reached.look();
    if (!reached.isNews(places)) continue;
    await learnFrom(batch, reached);
    reached.learn(places);
  }
  const grown = 1024 * (process.resourceUsage().maxRSS - before);
  assert.ok(grown < MOST_BYTES, `${grown} bytes`);
  return { runs: done, taken, inputs: inputs.length, slowest, megabytes: grown / 2 ** 20 };
}

/** @param {() => Promise<unknown>} work */
async function secondsOfProcessor(work) {
  const start = process.cpuUsage();
  await work();
  const { user, system } = process.cpuUsage(start);
  return (user + system) / 1e6;
}
