/** View model of Dead Reckoning. */

import type { DeadReckoning as Simulation, DeadReckoningSettings } from '../../types.d.ts';

export type ViewModel = ReturnType<typeof viewModelOf>;

/** Components of ξ, in the order of every triple. */
export const COMPONENTS = ['along', 'lateral', 'heading'] as const;

export function viewModelOf(simulation: Simulation) {
  const results = simulation.read();
  const { config, stats, ratios, relativeErrors, nominal } = results;
  const { step, compounding } = config;
  const ratiosOfRecursion = ratios[compounding];
  return {
    ...results,
    /** Curve of each component by step, from 1. */
    curves: COMPONENTS.map((_, axis) => axisCurve(ratiosOfRecursion, relativeErrors, axis)),
    /** Commanded pose after the step. */
    pose: nominal.subarray(3 * (step - 1), 3 * step),
    condition: ratioCondition(config, stats, ratiosOfRecursion),
  };
}

/** Returns the curve of a component. `ratios` has three numbers for each step. */
function axisCurve(ratios: Float64Array, relativeErrors: Float64Array, axis: number) {
  const componentOf = (triples: Float64Array) => triples.filter((_, i) => i % 3 === axis);
  const axisRatios = componentOf(ratios);
  return { ratio: axisRatios, error: componentOf(relativeErrors).map((error, i) => error * axisRatios[i]) };
}

/**
 * Returns the reason why the ratios are undefined or uncertain: no robots, no spread, no covariance at the end, or too few robots.
 * Returns 'certain' if there is none.
 */
function ratioCondition({ compounding }: DeadReckoningSettings, { n, predicted, measured, misses }: Simulation['stats'], ratios: Float64Array): 'none' | 'still' | 'lost' | 'few' | 'certain' {
  if (n === 0) return 'none';
  // A single robot has no variance.
  if (n === 1) return 'few';
  if (measured.cov.every((row) => row.every((entry) => Math.abs(entry) < Number.EPSILON ** 2))) return 'still';
  // Single components may have no variance, such as a heading without noise.
  if (predicted[compounding] === null || ratios.slice(-COMPONENTS.length).every(Number.isNaN)) return 'lost';
  return misses[compounding].some(({ decidable, end }) => !decidable && !Number.isNaN(end)) ? 'few' : 'certain';
}
