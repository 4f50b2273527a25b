/** What Map Squeeze shows of its machine. */

import { words } from '../../messages/registry.js';
import { verdict as bits } from '../../settings.js';
import { counted } from '../../ui/format.js';

/** @import { MapSqueeze, SqueezeSettings, SqueezeStats } from '../../types.d.ts' */

/** @typedef {ReturnType<typeof readingOf>} Reading */

/** Most paths that are drawn: more would be one blot, and cost more than a frame. */
const MAX_PATHS = 150;

/**
 * Everything that the picture and the readouts need of the machine, asked once a change.
 *
 * @param {MapSqueeze} machine
 */
export function readingOf(machine) {
  const { config, stats, verdicts, poses, commanded, startFree } = machine;
  const sorted = sort(poses, verdicts);
  return {
    config,
    stats,
    verdicts,
    poses,
    commanded,
    sorted,
    paths: sorted.through.slice(0, MAX_PATHS).map((index) => machine.path(index)),
    note: noteOn(config, stats, startFree),
  };
}

/**
 * Sorts draws by what became of them.
 *
 * @param {Float64Array} poses
 * @param {Uint8Array} verdicts
 */
function sort(poses, verdicts) {
  const indices = [...verdicts.keys()];
  const isAccepted = (/** @type {number} */ i) => (verdicts[i] & bits.accepted) !== 0;
  const accepted = indices.filter(isAccepted);
  const posesOf = (/** @type {number[]} */ some) => Float64Array.from(some.flatMap((i) => [poses[3 * i], poses[3 * i + 1], poses[3 * i + 2]]));
  return {
    rejected: posesOf(indices.filter((i) => !isAccepted(i))),
    accepted: posesOf(accepted),
    /** Indices of those whose path is not free. */
    through: accepted.filter((i) => (verdicts[i] & bits.pathFree) === 0),
  };
}

/**
 * A sentence on a robot that gets nowhere.
 *
 * @param {SqueezeSettings} config
 * @param {SqueezeStats} stats
 * @param {boolean} startFree
 * @returns {string} empty for an ordinary cloud
 */
function noteOn(config, stats, startFree) {
  const { wedged, nothing, noRoom } = words.squeeze;
  const drawn = counted(stats.drawn);
  if (stats.gaveUp) return wedged(stats.accepted, counted(stats.accepted), counted(config.samples), drawn);
  if (stats.drawn > 0 && stats.accepted === 0) return nothing(stats.drawn, drawn, config.sampler === 'whole-arc');
  return startFree ? '' : noRoom;
}
