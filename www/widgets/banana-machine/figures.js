/** What the Banana Machine shows of its machine. */

import { words } from '../../messages/registry.js';
import { alphaName } from '../shared/command.js';

/** @import { BananaMachine, Settings, Stats, Table } from '../../types.d.ts' */

/** Below this, metres or radians, a spread is none: rounding of the quadrature, not noise. */
const NO_SPREAD = 1e-9;

/**
 * Everything that the pictures and readouts need of the machine, asked once a change.
 *
 * @param {BananaMachine} machine
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

/** @param {number} variance whose quadrature may round to less than 0 */
export function deviation(variance) {
  return Math.sqrt(Math.max(0, variance));
}

/**
 * What kind of spread the cloud has, by the exact covariance.
 *
 * @param {Table} table
 * @returns {'point' | 'headings' | 'cloud'} one pose; one place but many headings; or a spread
 */
function spreadOf({ exact: { cov } }) {
  if (deviation(Math.max(cov[0][0], cov[1][1])) > NO_SPREAD) return 'cloud';
  return deviation(cov[2][2]) > NO_SPREAD ? 'headings' : 'point';
}

/**
 * A sentence on a cloud that is not what a reader expects, from the settings that made it so.
 *
 * @param {Settings} config
 * @param {Table} table
 * @param {Stats} stats
 * @param {boolean} chartHolds whether exponential coordinates reach as far as the robots turn
 * @returns {string} empty for an ordinary cloud
 */
function noteOn({ model, command, alphas, isolate }, table, stats, chartHolds) {
  const { notes, alphaIsZero, alphaIsSilent } = words.banana;
  const spread = spreadOf(table);
  const { v, omega } = command;
  if (spread === 'point') {
    if (v === 0 && omega === 0) return notes.still;
    if (isolate === null) return alphas.every((alpha) => alpha === 0) ? notes.silent : notes.unfed;
    return alphas[isolate - 1] === 0 ? alphaIsZero(alphaName(isolate - 1)) : alphaIsSilent[model][isolate - 1];
  }
  if (spread === 'headings') return notes.headings;
  if (!chartHolds) return notes.circle;
  if (model === 'odometry' && v < 0) return notes.backwards;
  return stats.n > 2 && Object.values(stats.coverage).some(Number.isNaN) ? notes.line : '';
}
