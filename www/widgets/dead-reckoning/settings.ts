/** Settings of Dead Reckoning: their attributes, state fields and sliders. Also line styles, and the data that the figure shows. */

import { defaultConfigOf, createDefinition } from '../../figure/definition.ts';
import { settings } from '../../../build/settings.js';
import { createSamplesSliderSpec } from '../shared/cloud.ts';
import { ALPHA_SLIDER, COMMAND_DASH, createAlphaSliderSpecs, createCommandSliderSpecs } from '../shared/sliders.ts';
import type { DeadReckoning as Simulation, DeadReckoningSettings } from '../../types.d.ts';

const settingDeclarations = settings['dead-reckoning'];

/** Recursions for the covariance, in the order in which the figure offers them. */
export const RECURSIONS = settingDeclarations.find(({ key }) => key === 'compounding')?.words as DeadReckoningSettings['compounding'][];

/** Styles of the curves in the chart of predicted over measured variance. */
export const CURVE_STYLES = {
  lateral: { colourRole: 'prediction', width: 1.9 },
  along: { colourRole: 'ink', width: 1.9, dash: [8, 4] },
  heading: { colourRole: 'muted', width: 1.9, dash: [9, 3, 2, 3] },
  tolerance: { colourRole: 'truth', shape: 'area' },
} satisfies Record<string, import('../../ui/theme.ts').LineStyle>;

/** Styles of the outlines in the pictures, in the order in which they are painted. */
export const OUTLINE_STYLES = {
  command: { colourRole: 'prior', width: 2.25, dash: COMMAND_DASH },
  measured: { colourRole: 'truth', width: 2.25, dash: [3, 3] },
  ellipse: { colourRole: 'prediction', width: 2, dash: [7, 4] },
  exponential: { colourRole: 'posterior', width: 2.25, dash: [] },
} satisfies Record<string, import('../../ui/theme.ts').LineStyle>;

export const COMMAND_SLIDERS: Record<string, import('../../figure/controls.ts').SliderSpec> = createCommandSliderSpecs(1);

export const NOISE_SLIDERS = createAlphaSliderSpecs(6);

export const definition = createDefinition('dead-reckoning', {
  messageKey: 'reckoning',
  overlayStyles: { ...CURVE_STYLES, ...OUTLINE_STYLES },
  sliderSpecs: {
    ...COMMAND_SLIDERS,
    ...NOISE_SLIDERS,
    // With more robots, the cloud would lag behind a slider that the user drags.
    samples: createSamplesSliderSpec(200_000),
    step: { symbol: '*k*', colourRole: 'truth', min: 1, max: 200, step: 1, decimals: 0 },
    steps: { symbol: '*K*', colourRole: 'prior', min: 1, max: 200, step: 1, decimals: 0 },
    // This slider sets α₃, and α₄ to α₆ in fixed ratios to α₃. It shows α₃ even if the user has set α₄ to α₆ to other ratios.
    headingNoise: { ...ALPHA_SLIDER, step: 0.005, combinedValueOf: ({ alphas }) => alphas[2] },
  },
  dependentDefaultsOf: ({ steps }) => ({ step: Math.min(defaultConfigOf(settingDeclarations).step, steps) }),
});

export type ViewModel = ReturnType<typeof viewModelOf>;

/** Names of the components of the exponential coordinates ξ, in the order of arrays with three numbers for each step. */
export const TWIST_COMPONENTS = ['along', 'lateral', 'heading'] as const;

export function viewModelOf(simulation: Simulation) {
  const simulationResults = simulation.read();
  const { config, stats, ratios, relativeErrors, nominal } = simulationResults;
  const { step, compounding } = config;
  const ratiosOfRecursion = ratios[compounding];
  return {
    ...simulationResults,
    /** Predicted over measured variance of each component, with standard errors, after each step. */
    curves: TWIST_COMPONENTS.map((_, componentIndex) => curveOfComponent(ratiosOfRecursion, relativeErrors, componentIndex)),
    /** Commanded pose after the selected step. */
    commandedPose: nominal.subarray(3 * (step - 1), 3 * step),
    ratioCondition: ratioConditionOf(config, stats, ratiosOfRecursion),
  };
}

/** Returns the variance ratios of one component of ξ, and their standard errors. The arrays have the numbers of all three components for each step. */
function curveOfComponent(ratios: Float64Array, relativeErrors: Float64Array, componentIndex: number) {
  const componentOf = (componentTriples: Float64Array) => componentTriples.filter((_, i) => i % 3 === componentIndex);
  const componentRatios = componentOf(ratios);
  return { ratio: componentRatios, error: componentOf(relativeErrors).map((error, i) => error * componentRatios[i]) };
}

/** Returns 'certain', or the reason why the ratios are undefined or uncertain: no robots, no spread, no covariance at the last step, or too few robots. */
function ratioConditionOf({ compounding }: DeadReckoningSettings, { n, predicted, measured, misses }: Simulation['stats'], ratios: Float64Array): 'noRobots' | 'noNoise' | 'noCovariance' | 'fewRobots' | 'certain' {
  if (n === 0) return 'noRobots';
  // A single robot has no variance with which a prediction could be compared.
  if (n === 1) return 'fewRobots';
  if (measured.cov.every((covRow) => covRow.every((covariance) => Math.abs(covariance) < Number.EPSILON ** 2))) return 'noNoise';
  // If only some components have undefined ratios, these components have no noise. The other ratios are valid.
  if (predicted[compounding] === null || ratios.slice(-TWIST_COMPONENTS.length).every(Number.isNaN)) return 'noCovariance';
  return misses[compounding].some(({ decidable, end }) => !decidable && !Number.isNaN(end)) ? 'fewRobots' : 'certain';
}
