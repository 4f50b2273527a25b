// The baselines of `npm run bench` compute what the core computes, and its buildings are what they are called.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { checkClouds, checkDraws } from '../../benches/checks.js';
import { bytesPerPose, watchMemory } from '../../benches/memory.js';
import { countingCore, operationsOf, operationsOfTurn } from '../../benches/operations.js';
import { report } from '../../benches/report.js';
import { KERNELS, KINDS } from '../../benches/roofline.js';
import { dividedPlan, growingPlan } from '../../benches/squeeze.js';
import { ratio, spread } from '../../benches/timing.js';
import { freshModule } from './support.js';

test('the baselines have the core’s figures, contours and pictures', async () => {
  const motion = await (await freshModule()).load();
  assert.deepEqual(checkDraws(motion, 2000), []);
  assert.deepEqual(checkClouds(motion, 20_000), []);
});

test('a core with other figures would be noticed', async () => {
  const motion = await (await freshModule()).load();
  class Off extends motion.BananaMachine {
    get stats() {
      const stats = super.stats;
      return { ...stats, crossTrackSkew: stats.crossTrackSkew * 1.1 };
    }
  }
  const wrong = checkDraws(/** @type {any} */ ({ BananaMachine: Off }), 2000);
  assert.deepEqual([...new Set(wrong.map((text) => text.split(':')[0]))], ['crossTrackSkew']);
});

test('buildings have the walls asked for, and the robot’s surroundings stay', async () => {
  const motion = await (await freshModule()).load();
  const apartment = new motion.MapSqueeze({ samples: 1 });
  const { bounds, walls } = apartment.plan;
  const plan = {
    bounds: [...bounds],
    walls: Array.from({ length: walls.length / 4 }, (_, i) => [...walls.slice(4 * i, 4 * i + 4)]),
  };
  const settings = { samples: 500, sampler: 'endpoint', conditioned: true };
  const verdictsIn = (/** @type {unknown} */ other) => {
    const machine = new motion.MapSqueeze(settings);
    machine.setPlan(other);
    return [...machine.verdicts];
  };
  assert.deepEqual(verdictsIn(dividedPlan(plan, 1000)), verdictsIn(plan));
  assert.deepEqual(verdictsIn(growingPlan(plan, 1000)), verdictsIn(growingPlan(plan, 10_000)));
  for (const count of [10, 100, 1000, 10_000]) {
    assert.equal(growingPlan(plan, count).walls.length, count);
    assert.equal(dividedPlan(plan, count).walls.length, count);
  }
});

test('operations are counted where they are executed, of each sample as many', async () => {
  const core = await countingCore();
  for (const kind of KINDS) {
    // Robots are driven in blocks of up to 256.
    const [some, others] = [8192, 16_384].map((samples) => operationsOf(core, kind, samples));
    // The same ones for each: what a sample meets on its way differs, in a hundred or more by some hundredths.
    assert.ok(some.arithmetic > 20 && Math.abs(some.arithmetic / others.arithmetic - 1) < 0.2, `${kind.what}: ${some.arithmetic}, ${others.arithmetic}`);
  }
  const before = core.counted();
  core.classes.se2.compose({ x: 1, y: 2, theta: 0.3 }, { x: 1, y: 2, theta: 0.3 });
  const { arithmetic, divisions } = core.counted();
  // Four products and four sums for x and y, one for the heading; and what sine and cosine take.
  assert.ok(arithmetic - before.arithmetic >= 9 && arithmetic - before.arithmetic < 200, `${arithmetic - before.arithmetic}`);
  assert.ok(divisions - before.divisions < 5);
});

test('a turn of a kernel has as many operations as its time is divided by', async () => {
  for (const kind of /** @type {const} */ (['arithmetic', 'divisions', 'choices', 'memory', 'whole'])) {
    const counted = await operationsOfTurn(kind);
    // Besides, each turn counts down.
    assert.equal(counted[kind] - (kind === 'whole' ? 1 : 0), KERNELS[kind].each, kind);
    assert.equal(counted.branches, 1);
  }
  assert.equal((await operationsOfTurn('reading')).memory * 16, KERNELS.reading.each);
});

test('the module’s memory is found, and grows by what a pose takes', async () => {
  const { load } = await freshModule();
  const { result: motion, memory } = await watchMemory(load);
  assert.ok(bytesPerPose(motion, memory) > 24);
});

test('medians, quartiles and ratios', () => {
  assert.deepEqual(spread([5, 1, 4, 2, 3]), { median: 3, lower: 2, upper: 4, turns: 5 });
  assert.equal(spread([1, 2]).median, 1.5);
  // Turn by turn: not the ratio of the medians, which is 2.
  assert.equal(ratio([2, 30, 4], [1, 10, 1]).median, 3);
});

test('a target that is missed is called missed', () => {
  const flat = (/** @type {number} */ value) => ({ median: value, lower: value, upper: value, turns: 7 });
  const measured = (/** @type {number} */ ms) => ({
    refresh: [1e5, 1e6].map((samples) => ({
      samples, core: flat(ms), figures: flat(ms), typed: flat(5 * ms), obvious: flat(50 * ms), overTyped: flat(5), overObvious: flat(50),
    })),
    seed: { samples: 1e5, seed: flat(ms) },
    squeeze: { samples: 1e5, squeeze: flat(ms) },
    walls: { samples: 10, growing: [], divided: [] },
    reckoning: { rollouts: 10, few: flat(ms), many: flat(ms) },
    memory: { bytesPerPose: 40, events: 10, coreGrowth: 0, heapGrowth: 0 },
    roofline: {
      limits: { arithmetic: 0.5, divisions: 2, choices: 0.5, memory: 0.25, whole: 0.25, reading: 0.1 },
      roofs: [{
        what: 'sample',
        operations: { arithmetic: 10, divisions: 1, choices: 2, memory: 2, whole: 2, branches: 1 },
        arithmetic: 7, memory: 2.4, rest: { choices: 1, memory: 0.5, whole: 0.5 }, measured: flat(10 * ms),
      }],
    },
  });
  const row = { walls: 10, time: flat(1), drawsPerAccepted: 1, wallTestsPerAccepted: 1 };
  const withWalls = (/** @type {number} */ ms) => ({ ...measured(ms), walls: { samples: 10, growing: [row, row], divided: [row, row] } });
  const text = report({
    date: '2026-01-02T03:04:05Z', commit: 'abc', processor: 'P', cores: 2, nodeVersion: '20', chromiumVersion: '1', rustVersion: 'rustc 1',
    quick: false, seconds: 1, node: withWalls(1), chromium: withWalls(3), start: { loads: 1, total: flat(101), stages: [] },
    drags: [17, 2].map((ms) => ({ widget: 'a', what: ms > 10 ? 'slow' : 'fast', time: flat(ms), words: flat(ms), steady: flat(ms) })),
  });
  const verdictOf = (/** @type {string} */ what) => text.split('\n').find((line) => line.startsWith(`| ${what}`))?.split('|').at(-2)?.trim();
  const shares = text.split('\n').filter((line) => line.startsWith('| sample ')).map((line) => line.split('|').at(-2)?.trim());
  assert.deepEqual(shares, ['70 %', '90 %', '23.3 %', '30 %']);
  assert.equal(verdictOf('Refresh of 1 000 000 poses'), 'yes');
  assert.equal(verdictOf('Refresh of 100 000 poses'), 'in Node alone');
  assert.equal(verdictOf('From script start to first cloud'), 'no');
  assert.equal(verdictOf('A step of the slowest drag (slow)'), 'no');
});
