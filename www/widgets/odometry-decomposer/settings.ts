/** Settings of the Odometry Decomposer: their attributes, state fields and sliders. Also line styles, and the data that the figure shows. */

import { createDefinition } from '../../figure/definition.ts';
import { createSamplesSliderSpec } from '../shared/cloud.ts';
import { createAlphaSliderSpecs } from '../shared/sliders.ts';
import type { OdometryDecomposer, RuleNoise } from '../../types.d.ts';

export const LINE_STYLES = {
  legs: { colourRole: 'prior', width: 3, dash: [] },
  deviation: { colourRole: 'prediction', width: 1.25, dash: [5, 3] },
  outcomes: { colourRole: 'cloud', shape: 'dot' },
  prediction: { colourRole: 'prediction', width: 2.5, dash: [] },
  odometry: { colourRole: 'prior', width: 1.75, dash: [6, 4] },
  difference: { colourRole: 'accent', width: 1.5, dash: [2, 4] },
} satisfies Record<string, import('../../ui/theme.ts').LineStyle>;

/** Sliders of the noise parameters, and of the correlation between the noise of the two rotations. */
export const NOISE_SLIDERS = {
  ...createAlphaSliderSpecs(5, 'odometry'),
  correlation: { symbol: '*ρ*', colourRole: 'prediction' as const, min: -1, max: 1, step: 0.05, decimals: 2 },
};

export const sliderSpecs: Record<string, import('../../figure/controls.ts').SliderSpec> = {
  ...NOISE_SLIDERS,
  phase: { colourRole: 'prior', min: 0, max: 3, step: 0.01, decimals: 2 },
  samples: createSamplesSliderSpec(5000),
  drift: { colourRole: 'truth', min: 0, max: 120, step: 1, decimals: 0 },
};

export const definition = createDefinition('odometry-decomposer', { messageKey: 'decomposer', overlayStyles: LINE_STYLES, sliderSpecs });

export type ViewModel = ReturnType<typeof viewModelOf>;

export function viewModelOf(simulation: OdometryDecomposer) {
  const simulationResults = simulation.read();
  // The legs (rotation, drive, rotation) and their standard deviations by the selected noise rule.
  const { legs, deviations: [rot1, trans, rot2, strafe] } = simulationResults.rules.find(({ rule }) => rule === simulationResults.config.rule) as RuleNoise;
  return { ...simulationResults, legs, deviations: { rot1, trans, rot2, strafe } };
}

/** Returns the pose with the given index from an array of x, y, θ triples. */
export function poseAt(poseTriples: Float64Array, poseIndex: number) {
  const [x, y, theta] = poseTriples.subarray(3 * poseIndex, 3 * poseIndex + 3);
  return { x, y, theta };
}
