// Noise parameters, commands and view of the refresh benchmark, which are the same for the core and the baseline.

/** @typedef {import('../www/types.d.ts').BananaMachine} BananaMachine */
/** @typedef {import('../www/types.d.ts').Command} Command */

/** α's of the preset Gentle arc, in which all six are above 0. */
export const ALPHAS = [0.05, 0.05, 0.05, 0.09, 0.01, 0.01];

/** View with 400 pixels per metre around the whole cloud. */
export const PICTURE_VIEW = { xMin: -0.2, yMin: -0.6, xMax: 2.2, yMax: 1.2, columnCount: 960, rowCount: 720 };

/** @typedef {typeof PICTURE_VIEW} Picture */

/** Ramp of 256 colours (red, green, blue, opacity) from sparse to dense, as in the widget. */
export const COLOUR_RAMP = Uint8Array.from({ length: 1024 }, (_, i) => {
  const shadeShare = (i >> 2) / 255;
  const opacityExcess = 0.6 * Math.max(0, shadeShare - 0.5);
  const [sparseColour, denseColour] = [[213, 94, 0], [27, 31, 36]];
  return Math.round(i % 4 === 3 ? 255 * (0.15 + 0.85 * shadeShare) : sparseColour[i % 4] + opacityExcess * (denseColour[i % 4] - sparseColour[i % 4]));
});

/** Returns the command at an event of the slider. The slider moves up and down and never rests. @param {number} eventNumber @returns {Command} */
export function commandOfEvent(eventNumber) {
  return { v: 1, omega: 0.5 + 0.001 * Math.abs(50 - (eventNumber % 100)), dt: 1 };
}

/**
 * Returns the pixels of the density from the core.
 *
 * @param {BananaMachine} simulation
 * @param {Picture} [picture]
 * @returns {Uint8ClampedArray}
 */
export function readDensityPixels(simulation, { xMin, yMin, xMax, yMax, columnCount, rowCount } = PICTURE_VIEW) {
  return simulation.picture(0, [xMin, yMin, xMax, yMax], columnCount, rowCount, COLOUR_RAMP);
}

/** Returns everything that a page needs after an event, except for the pixels of the picture. @param {BananaMachine} simulation @param {number} eventNumber */
export function readStatsAndContours(simulation, eventNumber) {
  simulation.configure({ command: commandOfEvent(eventNumber) });
  return { stats: simulation.stats, contours: simulation.contours };
}
