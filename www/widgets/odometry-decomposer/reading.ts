/** View model of the Odometry Decomposer. */

import type { OdometryDecomposer, OdometryDecomposerSettings, RuleFigures } from '../../types.d.ts';

export type Reading = ReturnType<typeof readingOf>;

/** Linkages that are drawn beside the one that was read: more would hide it. */
const GHOSTS = 12;

/** Everything that the pictures and the readouts need of the machine, asked once a change. */
export function readingOf(machine: OdometryDecomposer) {
  const { config, stats, rules, poses, linkage, robot, drifted } = machine;
  return { config, stats, rules, poses, linkage, robot, drifted, ghosts: machine.ghosts(GHOSTS), ...partsOf(rules, config) };
}

/** The present rule's figures, with a name for each deviation. */
function partsOf(rules: RuleFigures[], config: OdometryDecomposerSettings) {
  const present = rules.find(({ rule }) => rule === config.rule) as RuleFigures;
  const [rot1, trans, rot2, strafe] = present.deviations;
  return { legs: present.legs, deviations: { rot1, trans, rot2, strafe } };
}

/** One of several poses that stand in a row as triples. */
export function poseIn(triples: Float64Array, index: number) {
  const [x, y, theta] = triples.subarray(3 * index, 3 * index + 3);
  return { x, y, theta };
}
