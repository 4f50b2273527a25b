// The JavaScript baseline of `npm run bench` computes the same results as the core.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { findDifferencesFromCore } from '../../benches/check.js';
import { importFreshModule } from './support.js';

test('the baseline computes the same statistics and picture as the core', async () => {
  const motionCore = await (await importFreshModule()).load();
  assert.deepEqual(findDifferencesFromCore(motionCore, 2000), []);
});

test('the comparison of baseline and core reports a different skew', async () => {
  const motionCore = await (await importFreshModule()).load();
  class SimulationWithOtherSkew extends motionCore.BananaMachine {
    get stats() {
      const stats = super.stats;
      return { ...stats, crossTrackSkew: stats.crossTrackSkew * 1.1 };
    }
  }
  const differenceTexts = findDifferencesFromCore(/** @type {any} */ ({ BananaMachine: SimulationWithOtherSkew }), 2000);
  assert.deepEqual([...new Set(differenceTexts.map((differenceText) => differenceText.split(':')[0]))], ['crossTrackSkew']);
});
