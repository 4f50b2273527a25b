/** What the Odometry Decomposer shows of its machine. */

/** @import { OdometryDecomposer, OdometryDecomposerSettings, RuleFigures } from '../../types.d.ts' */

/** @typedef {ReturnType<typeof readingOf>} Reading */

/** Linkages that are drawn beside the one that was read: more would hide it. */
const GHOSTS = 12;

/**
 * Everything that the pictures and the readouts need of the machine, asked once a change.
 *
 * @param {OdometryDecomposer} machine
 */
export function readingOf(machine) {
  const { config, stats, rules, poses, linkage, robot, drifted } = machine;
  return { config, stats, rules, poses, linkage, robot, drifted, ghosts: machine.ghosts(GHOSTS), ...partsOf(rules, config) };
}

/**
 * The present rule's figures, with a name for each deviation.
 *
 * @param {RuleFigures[]} rules
 * @param {OdometryDecomposerSettings} config
 */
function partsOf(rules, config) {
  const present = /** @type {RuleFigures} */ (rules.find(({ rule }) => rule === config.rule));
  const [rot1, trans, rot2, strafe] = present.deviations;
  return { legs: present.legs, deviations: { rot1, trans, rot2, strafe } };
}

/**
 * One of several poses that stand in a row as triples.
 *
 * @param {Float64Array} triples
 * @param {number} index
 */
export function poseIn(triples, index) {
  const [x, y, theta] = triples.subarray(3 * index, 3 * index + 3);
  return { x, y, theta };
}
