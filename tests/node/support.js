import assert from 'node:assert/strict';

const CORE_ADDRESS = new URL('../../dist/core.js', import.meta.url).href;
let copyCount = 0;

/**
 * Returns a new instance of the built module, because `load` caches its first core.
 *
 * @returns {Promise<any>} any, because tests also call it with wrong types
 */
export function importFreshModule() {
  copyCount += 1;
  return import(`${CORE_ADDRESS}?copy=${copyCount}`);
}

/**
 * Asserts that a value differs from the expected one by the tolerance at most.
 *
 * @param {number} value
 * @param {number} expected
 * @param {number} tolerance
 * @param {string} [message]
 */
export function assertNear(value, expected, tolerance, message = '') {
  assert.ok(Math.abs(value - expected) <= tolerance, `${message} ${value} is not ${expected} ± ${tolerance}`);
}
