/** The velocity command, as every widget that sends one shows it. */

import { words } from '../../messages/registry.js';
import { fixed } from '../../ui/format.js';

/** The dash of the commanded way, CSS pixels. */
export const COMMAND_DASH = [2.5, 3.5];

const SPEED = { role: /** @type {const} */ ('prior'), step: 0.01, decimals: 2 };

/**
 * How the settings of a command look. Handles and charts that set it keep to the ranges of its sliders.
 *
 * @param {number} longest duration of the slider, s
 */
export const commandLooks = (longest) => ({
  v: { ...SPEED, symbol: '*v*', min: -1.5, max: 1.5 },
  omega: { ...SPEED, symbol: '*ω*', min: -2, max: 2 },
  dt: { ...SPEED, symbol: '*Δt*', min: 0.1, max: longest, step: 0.05 },
});

/** The command in words. @param {import('../../types.d.ts').Command} command */
export function commandText({ v, omega, dt }) {
  return words.commandText(fixed(v, 2), fixed(omega, 2), fixed(dt, 2));
}
