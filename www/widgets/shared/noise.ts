/** Sliders of the noise parameters (α's) of a motion model. */

/** Returns the subscript of an α, counted from 0. */
export const subscript = (index: number) => String.fromCharCode(0x2081 + index);

/** Slider of a noise parameter, up to a standard deviation of nearly half the command. */
export const ALPHA = { role: 'prediction' as const, min: 0, max: 0.2, step: 0.001, decimals: 3 };

/** Returns the sliders of a model's first noise parameters, by the names of their settings. */
export function alphaSliders(count: number, model: 'velocity' | 'odometry' = 'velocity'): Record<string, import('../../figure/controls.ts').SliderSpec> {
  return Object.fromEntries(
    Array.from({ length: count }, (_, i) => [`alpha${i + 1}`, { ...ALPHA, symbol: `*α*${subscript(i)}`, alpha: [model, i] }]),
  );
}
