import assert from 'node:assert/strict';
import { settings } from '../../www/settings.js';

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
 * The settings that a widget opens with, as declared: a test says of which it knows better.
 *
 * @param {string} tag
 */
export function declaredOpening(tag) {
  const all = settings[tag];
  const opening = (/** @type {string} */ key, /** @type {string} */ group = '') =>
    all.find((setting) => (group ? setting.in === group && (setting.field ?? setting.key) === key : setting.key === key))?.default;
  const whole = all.filter((setting) => !setting.in && !setting.of);
  return Object.fromEntries(
    whole.map(({ key, fields }) => [key, fields ? Object.fromEntries(fields.map((field) => [field, opening(field, key)])) : opening(key)]),
  );
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
