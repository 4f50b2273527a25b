// True parameters of the logs of examples/calibration, in their README.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { LEGS, TRUTH } from '../../scripts/example-log.mjs';

const folder = new URL('../../examples/calibration/', import.meta.url);
const textOf = (/** @type {string} */ name) => readFileSync(new URL(name, folder), 'utf8');

test('README of the example log has its true parameters', () => {
  const readme = textOf('README.md');
  const { alphas, mountYaw, clockOffset, distanceScale } = TRUTH;
  for (const said of [`| ${alphas.join(', ')} |`, `| ${mountYaw} rad |`, `| ${clockOffset} s later |`, `| ${distanceScale} |`, `${LEGS.distance} m`, `${LEGS.angle} rad`]) {
    assert.ok(readme.includes(said), said);
  }
});
