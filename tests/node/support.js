import assert from 'node:assert/strict';

const CORE = new URL('../../dist/core.js', import.meta.url).href;
let copies = 0;

/**
 * The built module, evaluated anew: `load` keeps what it loaded first.
 *
 * @returns {Promise<any>} any: the tests call it as a stranger would, wrongly too
 */
export function freshModule() {
  copies += 1;
  return import(`${CORE}?copy=${copies}`);
}

/**
 * @param {number} value
 * @param {number} expected
 * @param {number} tolerance
 * @param {string} [message]
 */
export function near(value, expected, tolerance, message = '') {
  assert.ok(Math.abs(value - expected) <= tolerance, `${message} ${value} is not ${expected} ± ${tolerance}`);
}
