/**
 * What the Banana Machine shows of its machine.
 *
 * @module
 */

import { looks } from './settings.js';
import { noteOn } from './words.js';

/**
 * @typedef {import('../../types.d.ts').BananaMachine} Machine
 * @typedef {ReturnType<typeof readingOf>} Reading
 */

/**
 * Points of the chart's curve. Fewer would draw the fall of the skew across ω = 0 as a kinked line;
 * more than a pixel each would be wasted.
 */
const CURVE_POINTS = 241;

/** The skew against ω, which costs milliseconds and which only some of the settings alter. */
export class CurveMemo {
  /** @type {Float64Array} */
  #curve = new Float64Array();
  #holdsFor = '';

  /** @param {Machine} machine */
  of(machine) {
    const { model, noise, command, alphas, isolate } = machine.config;
    const wanted = JSON.stringify([model, noise, command.v, command.dt, alphas, isolate]);
    if (wanted !== this.#holdsFor) {
      this.#holdsFor = wanted;
      this.#curve = machine.skewCurve(looks.omega.min, looks.omega.max, CURVE_POINTS);
    }
    return this.#curve;
  }
}

/**
 * Everything that the pictures and readouts need of the machine, asked once a change.
 *
 * @param {Machine} machine
 * @param {CurveMemo} memo
 */
export function readingOf(machine, memo) {
  const { config, shown, stats, contours, table, chartHolds } = machine;
  return {
    config,
    shown,
    stats,
    contours,
    table,
    note: noteOn(config, table, stats, chartHolds),
    exactSkew: table.exact.crossTrackSkew,
    curve: memo.of(machine),
    /** The end of the commanded arc, metres. */
    end: /** @type {[number, number]} */ ([...contours.command.slice(-2)]),
  };
}
