/** View model of the Odometry Decomposer. */

import type { OdometryDecomposer, OdometryDecomposerSettings, RuleNoise } from '../../types.d.ts';

export type ViewModel = ReturnType<typeof viewModelOf>;

export function viewModelOf(simulation: OdometryDecomposer) {
  const results = simulation.read();
  return { ...results, ...currentRuleNoise(results.rules, results.config) };
}

/** Returns the legs and standard deviations of the current rule. */
function currentRuleNoise(rules: RuleNoise[], config: OdometryDecomposerSettings) {
  const currentRule = rules.find(({ rule }) => rule === config.rule) as RuleNoise;
  const [rot1, trans, rot2, strafe] = currentRule.deviations;
  return { legs: currentRule.legs, deviations: { rot1, trans, rot2, strafe } };
}

/** Returns one of several poses in an array of x, y, θ triples. */
export function poseAt(triples: Float64Array, index: number) {
  const [x, y, theta] = triples.subarray(3 * index, 3 * index + 3);
  return { x, y, theta };
}
