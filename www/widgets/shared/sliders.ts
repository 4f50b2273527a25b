/** Sliders of the velocity command and of a motion model's noise parameters (α's), and the command in words. */

import { words } from '../../messages/registry.ts';
import { formatFixed } from '../../ui/format.ts';

/** Dash pattern of the commanded path (lengths of dash and gap), CSS pixels. */
export const COMMAND_DASH = [2.5, 3.5];

const SPEED_SLIDER = { colourRole: 'prior' as const, step: 0.01, decimals: 2 };

/** Returns the sliders of a velocity command. `maxDuration` is in seconds. Handles and charts that change the command keep it within the ranges of these sliders. */
export const createCommandSliderSpecs = (maxDuration: number) => ({
  v: { ...SPEED_SLIDER, symbol: '*v*', min: -1.5, max: 1.5 },
  omega: { ...SPEED_SLIDER, symbol: '*ω*', min: -2, max: 2 },
  dt: { ...SPEED_SLIDER, symbol: '*Δt*', min: 0.1, max: maxDuration, step: 0.05 },
});

export function describeCommand({ v, omega, dt }: import('../../types.d.ts').Command) {
  return `${words.commandHeading}: v = ${formatFixed(v, 2)} m/s, ω = ${formatFixed(omega, 2)} rad/s, Δt = ${formatFixed(dt, 2)} s`;
}

/** Returns the subscript for the index of an α: ₁ for index 0. */
export const subscriptOf = (alphaIndex: number) => String.fromCharCode(0x2081 + alphaIndex);

/** Slider of a noise parameter α. The maximum of α gives a standard deviation of nearly half the command. */
export const ALPHA_SLIDER = { colourRole: 'prediction' as const, min: 0, max: 0.2, step: 0.001, decimals: 3 };

/** Returns the sliders of the first `alphaCount` noise parameters of a motion model, by the names of their settings. */
export function createAlphaSliderSpecs(alphaCount: number, model: 'velocity' | 'odometry' = 'velocity'): Record<string, import('../../figure/controls.ts').SliderSpec> {
  return Object.fromEntries(
    Array.from({ length: alphaCount }, (_, i) => [`alpha${i + 1}`, { ...ALPHA_SLIDER, symbol: `*α*${subscriptOf(i)}`, alpha: [model, i] }]),
  );
}
