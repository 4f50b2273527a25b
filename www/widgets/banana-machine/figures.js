/**
 * What the Banana Machine shows of its machine.
 *
 * @module
 */

import { noteOn } from './words.js';

/**
 * Everything that the pictures and readouts need of the machine, asked once a change.
 *
 * @param {import('../../types.d.ts').BananaMachine} machine
 */
export function figuresOf(machine) {
  const { config, shown, stats, contours, table, chartHolds } = machine;
  return {
    config,
    shown,
    stats,
    contours,
    table,
    note: noteOn(config, table, stats, chartHolds),
    exactSkew: table.exact.crossTrackSkew,
    /** The end of the commanded arc, metres. */
    end: /** @type {[number, number]} */ ([...contours.command.slice(-2)]),
  };
}
