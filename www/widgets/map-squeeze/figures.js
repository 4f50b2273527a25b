/**
 * What Map Squeeze shows of its machine.
 *
 * @module
 */

import { sort } from './picture.js';
import { noteOn } from './words.js';

/** @typedef {import('../../types.d.ts').MapSqueeze} MapSqueeze */

/** Paths drawn at most: more would be one blot, and cost more than a frame. */
const MOST_PATHS = 150;

/**
 * Everything that the picture and the figures need of the machine, asked once a change.
 *
 * @param {MapSqueeze} machine
 */
export function read(machine) {
  const { config, stats, verdicts, poses, commanded, startFree } = machine;
  const sorted = sort(poses, verdicts);
  return {
    config,
    stats,
    verdicts,
    poses,
    commanded,
    sorted,
    paths: sorted.through.slice(0, MOST_PATHS).map((index) => machine.path(index)),
    note: noteOn(config, stats, startFree),
  };
}
