/** A target under inputs that are nearly right: a result or a sentence, soon, and in little memory. */

import assert from 'node:assert/strict';
import { Buffer } from 'node:buffer';
import { generator } from '../random.js';
import { keep, keptOf } from './corpus.js';
import { mutantOf } from './mutate.js';
import { targets } from './targets.js';

/** Seconds of a processor that one of them may take, and bytes that all of them may. */
const [MOST_SECONDS, MOST_BYTES] = [1, 256 * 2 ** 20];

/** Inputs between two looks at what they reached: a look takes as long as ten. */
const BATCH = 100;

/**
 * @param {string} name of the target
 * @param {number} count of the inputs, besides those that are kept
 * @param {number} seed
 * @param {import('./reached.js').Reached} [reached] has what reaches anything new changed in its turn, and kept in build/fuzz
 */
export async function execute(name, count, seed, reached) {
  const { corpus, run } = targets[name];
  const random = generator(seed);
  const inputs = [...corpus, ...keptOf(name)];
  let [slowest, taken, done] = [0, 0, 0];

  /** @param {Buffer<ArrayBuffer>} bytes */
  const one = async (bytes) => {
    const start = process.cpuUsage();
    const about = () => `number ${done} of seed ${seed}: ${bytes.toString('base64')}`;
    try {
      if (await run(bytes)) taken += 1;
    } catch (error) {
      throw new Error(about(), { cause: error });
    }
    const { user, system } = process.cpuUsage(start);
    slowest = Math.max(slowest, (user + system) / 1e6);
    assert.ok(slowest < MOST_SECONDS, `${slowest} s, ${about()}`);
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
    if (!reached) continue;
    const places = await reached.look();
    if (!reached.isNews(places)) continue;
    for (const bytes of batch) {
      await run(bytes);
      const own = await reached.look();
      if (!reached.isNews(own)) continue;
      reached.learn(own);
      inputs.push(bytes);
      keep(name, bytes);
    }
    // Some is reached only after another input.
    reached.learn(places);
  }
  const grown = 1024 * (process.resourceUsage().maxRSS - before);
  assert.ok(grown < MOST_BYTES, `${grown} bytes`);
  return { runs: done, taken, inputs: inputs.length, slowest, megabytes: grown / 2 ** 20 };
}
