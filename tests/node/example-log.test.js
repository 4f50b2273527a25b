// Logs of examples/calibration: true parameters in the README, size, and no row left out.

import assert from 'node:assert/strict';
import { readFileSync, statSync } from 'node:fs';
import { test } from 'node:test';
import { LEGS, TRUTH } from '../../scripts/example-log.mjs';
import { pairLogs, readLog } from '../../www/widgets/alpha-calibrator/log/read.js';

const folder = new URL('../../examples/calibration/', import.meta.url);
const textOf = (/** @type {string} */ name) => readFileSync(new URL(name, folder), 'utf8');

test('README of the example log has its true parameters', () => {
  const readme = textOf('README.md');
  const { alphas, mountYaw, clockOffset, distanceScale } = TRUTH;
  for (const said of [`| ${alphas.join(', ')} |`, `| ${mountYaw} rad |`, `| ${clockOffset} s later |`, `| ${distanceScale} |`, `${LEGS.distance} m`, `${LEGS.angle} rad`]) {
    assert.ok(readme.includes(said), said);
  }
});

test('example log is small and read without a complaint', async () => {
  const logs = await Promise.all(['odometry.csv', 'reference.csv'].map((name) => readLog(new File([textOf(name)], name))));
  assert.ok(logs.reduce((sum, { name }) => sum + statSync(new URL(name, folder)).size, 0) <= 300_000);
  for (const { found, data } of logs) {
    assert.deepEqual([found.gaps.count, found.jumps.count, data.breaks.length], [0, 0, 0]);
    assert.ok(Object.values(found.leftOut).every(({ count }) => count === 0));
  }
  const { odometry, reference } = pairLogs(logs[0], logs[1]);
  const [own, other] = [odometry.data.t, reference.data.t];
  assert.ok(other[0] < own[0] && other[other.length - 1] > own[own.length - 1]);
});
