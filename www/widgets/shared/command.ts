/** Velocity command, common to all widgets that send one. */

import { words } from '../../messages/registry.ts';
import { fixed } from '../../ui/format.ts';

/** Dash of the commanded path, CSS pixels. */
export const COMMAND_DASH = [2.5, 3.5];

const SPEED = { role: 'prior' as const, step: 0.01, decimals: 2 };

/** Returns the sliders of a command, with the longest duration in s. Handles and charts that set the command stay within these ranges. */
export const commandSliders = (longest: number) => ({
  v: { ...SPEED, symbol: '*v*', min: -1.5, max: 1.5 },
  omega: { ...SPEED, symbol: '*ω*', min: -2, max: 2 },
  dt: { ...SPEED, symbol: '*Δt*', min: 0.1, max: longest, step: 0.05 },
});

export function commandText({ v, omega, dt }: import('../../types.d.ts').Command) {
  return words.commandText(fixed(v, 2), fixed(omega, 2), fixed(dt, 2));
}
