/** What Arc Anatomy shows of its machine. */

/** @import { ArcAnatomy } from '../../types.d.ts' */

/** @typedef {ReturnType<typeof readingOf>} Reading */

/**
 * Everything that the picture and the readouts need of the machine, asked once a change.
 *
 * @param {ArcAnatomy} machine
 */
export function readingOf({ config, stats, table, paths }) {
  return { config, stats, table, paths };
}
