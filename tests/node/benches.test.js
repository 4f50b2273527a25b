// The baseline of `npm run bench` computes what the core computes, and the report compares medians with targets.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { differences } from '../../benches/check.js';
import { report } from '../../benches/report.js';
import { ratio, spread } from '../../benches/timing.js';
import { freshModule } from './support.js';

test('baseline has the statistics and the picture of the core', async () => {
  const motion = await (await freshModule()).load();
  assert.deepEqual(differences(motion, 2000), []);
});

test('comparison finds a core with another skew', async () => {
  const motion = await (await freshModule()).load();
  class Off extends motion.BananaMachine {
    get stats() {
      const stats = super.stats;
      return { ...stats, crossTrackSkew: stats.crossTrackSkew * 1.1 };
    }
  }
  const wrong = differences(/** @type {any} */ ({ BananaMachine: Off }), 2000);
  assert.deepEqual([...new Set(wrong.map((text) => text.split(':')[0]))], ['crossTrackSkew']);
});

test('spread has median and quartiles, and a ratio is taken turn by turn', () => {
  assert.deepEqual(spread([5, 1, 4, 2, 3]), { median: 3, lower: 2, upper: 4, turns: 5 });
  assert.equal(spread([1, 2]).median, 1.5);
  // The ratio of the medians would be 2.
  assert.equal(ratio([2, 30, 4], [1, 10, 1]).median, 3);
});

test('report says which targets are missed', () => {
  const flat = (/** @type {number} */ value) => ({ median: value, lower: value, upper: value, turns: 7 });
  const measured = (/** @type {number} */ ms) => ({
    refresh: [1e5, 1e6].map((samples) => ({ samples, core: flat(ms), baseline: flat(5 * ms), times: flat(5) })),
    calibration: flat(ms),
  });
  const text = report({
    date: '2026-01-02T03:04:05Z', commit: 'abc', processor: 'P', cores: 2, nodeVersion: '20', chromiumVersion: '1', rustVersion: 'rustc 1',
    quick: false, node: measured(1), chromium: measured(3), start: { loads: 1, total: flat(101), stages: [] },
    drags: [17, 2].map((ms) => ({ widget: 'a', what: ms > 10 ? 'slow' : 'fast', time: flat(ms), words: flat(ms), steady: flat(ms) })),
  });
  const verdictOf = (/** @type {string} */ what) => text.split('\n').find((line) => line.startsWith(`| ${what}`))?.split('|').at(-2)?.trim();
  assert.equal(verdictOf('Refresh of 1 000 000 poses'), 'yes');
  assert.equal(verdictOf('Refresh of 100 000 poses'), 'in Node alone');
  assert.equal(verdictOf('From script start to first cloud'), 'no');
  assert.equal(verdictOf('Step of the slowest drag (slow)'), 'no');
});
