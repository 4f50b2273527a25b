/**
 * What the Banana Machine shows of its machine.
 *
 * @module
 */

import { noteOn } from './words.js';

/** @typedef {import('../../types.d.ts').BananaMachine} BananaMachine */

/**
 * Everything that the pictures and figures need of the machine, asked once a change.
 *
 * @param {BananaMachine} machine
 */
export function read(machine) {
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
