// The baselines of `npm run bench` compute what the core computes, and its buildings are what they are called.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { checkClouds, checkDraws } from '../../benches/checks.js';
import { report } from '../../benches/report.js';
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
    memory: { bytesPerPose: 40, events: 10, coreGrowth: 0, heapGrowth: 0 },
  });
  const row = { walls: 10, time: flat(1), drawsPerAccepted: 1, wallTestsPerAccepted: 1 };
  const withWalls = (/** @type {number} */ ms) => ({ ...measured(ms), walls: { samples: 10, growing: [row, row], divided: [row, row] } });
  const text = report({
    date: '2026-01-02T03:04:05Z', commit: 'abc', processor: 'P', cores: 2, nodeVersion: '20', chromiumVersion: '1', rustVersion: 'rustc 1',
    quick: false, seconds: 1, node: withWalls(1), chromium: withWalls(3), start: { loads: 1, total: flat(101), stages: [] },
    drags: [17, 2].map((ms) => ({ widget: 'a', what: ms > 10 ? 'slow' : 'fast', time: flat(ms), words: flat(ms), steady: flat(ms) })),
  });
  const verdictOf = (/** @type {string} */ what) => text.split('\n').find((line) => line.startsWith(`| ${what}`))?.split('|').at(-2)?.trim();
  assert.equal(verdictOf('Refresh of 1 000 000 poses'), 'yes');
  assert.equal(verdictOf('Refresh of 100 000 poses'), 'in Node alone');
  assert.equal(verdictOf('From script start to first cloud'), 'no');
  assert.equal(verdictOf('A step of the slowest drag (slow)'), 'no');
});
