/** View model of the Odometry Decomposer. */

import type { OdometryDecomposer, RuleNoise } from '../../types.d.ts';

export type ViewModel = ReturnType<typeof viewModelOf>;

export function viewModelOf(simulation: OdometryDecomposer) {
  const results = simulation.read();
  // Legs and standard deviations of the current rule.
  const { legs, deviations: [rot1, trans, rot2, strafe] } = results.rules.find(({ rule }) => rule === results.config.rule) as RuleNoise;
  return { ...results, legs, deviations: { rot1, trans, rot2, strafe } };
}

/** Returns one of several poses in an array of x, y, θ triples. */
export function poseAt(triples: Float64Array, index: number) {
  const [x, y, theta] = triples.subarray(3 * index, 3 * index + 3);
  return { x, y, theta };
}
