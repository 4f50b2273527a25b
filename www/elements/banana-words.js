/**
 * What the Banana Machine says: captions of its parameters, sentences about degenerate clouds,
 * and the text that stands for the pictures.
 *
 * @module
 */

import { html } from 'lit';
import { longest } from '../ui/controls.js';
import { fixed, percent, whole, withError } from '../ui/format.js';

/**
 * @typedef {import('../types.d.ts').Settings} Settings
 * @typedef {import('../types.d.ts').Stats} Stats
 * @typedef {import('../types.d.ts').Table} Table
 * @typedef {import('../types.d.ts').Inspection} Inspection
 */

export const PRESET_LABELS = {
  straight: 'Straight',
  gentle: 'Gentle arc',
  hard: 'Hard arc',
  pivot: 'Pivot',
};

/** Largest sample count of the slider: beyond it a drag no longer follows the finger. */
const MOST_SAMPLES = 200_000;

/** Sample counts of the slider, in the 1–2–5 steps of a logarithmic scale. */
export const SAMPLE_COUNTS = [1, 2, 3, 4, 5]
  .flatMap((decade) => [1, 2, 5].map((step) => step * 10 ** decade))
  .filter((count) => count <= MOST_SAMPLES);

/** @type {import('./cloud.js').CloudWords} */
export const CLOUD_WORDS = {
  legend: 'Cloud',
  play: 'Grow the cloud',
  step: (batch) => `Add ${batch} robots`,
  reset: 'Empty the cloud; the same seed sends the same robots',
  reseed: 'Send other robots',
  count: 'N, robots in the whole cloud',
  effect: 'Robots sent: dots with headings while they are few, a density when they are many.',
};

export const OVERLAY_NAMES = {
  command: 'commanded arc',
  ellipse: '2σ Gaussian in (x, y)',
  linearized: 'linearized (EKF) ellipse',
  exponential: '2σ Gaussian in exponential coordinates',
};

/** The sliders of the command, with the range that the handle and the chart keep to as well. */
export const COMMAND_SLIDERS = /** @type {const} */ ([
  {
    key: 'v',
    symbol: 'v',
    name: 'v, commanded speed',
    unit: 'm/s',
    min: -1.5,
    max: 1.5,
    step: 0.01,
    effect: 'How far along the arc; below zero the robot backs up.',
  },
  {
    key: 'omega',
    symbol: 'ω',
    name: 'ω, commanded turn rate',
    unit: 'rad/s',
    min: -2,
    max: 2,
    step: 0.01,
    effect: 'How sharply the arc bends; positive turns left.',
  },
  {
    key: 'dt',
    symbol: 'Δt',
    name: 'Δt, duration',
    unit: 's',
    min: 0.1,
    max: 3,
    step: 0.05,
    effect: 'How long it drives: errors spread on the way.',
  },
]);

/** One line for each α: the noise it feeds, and what that does to the picture. */
const EFFECTS = {
  velocity: [
    ['v² into v̂', 'smears the cloud along the arc'],
    ['ω² into v̂', 'smears it too, but only in turns'],
    ['v² into ω̂', 'fans the cloud open and bends it'],
    ['ω² into ω̂', 'fans it too, but only in turns'],
    ['v² into γ̂', 'turns each robot where it stopped'],
    ['ω² into γ̂', 'turns it too, but only in turns'],
  ],
  odometry: [
    ['rotation into rotation', 'swings the cloud about the start'],
    ['distance into rotation', 'fans the cloud, even on a straight'],
    ['distance into distance', 'smears it along the line of travel'],
    ['rotation into distance', 'smears it too, but only in turns'],
  ],
};

/** What feeds each α, and what turning that up would show. */
const DRIVERS = {
  velocity: [
    ['v²', 'v', 'smear along the arc'],
    ['ω²', 'ω', 'smear along the arc'],
    ['v²', 'v', 'fan'],
    ['ω²', 'ω', 'fan'],
    ['v²', 'v', 'turn in place'],
    ['ω²', 'ω', 'blur its headings'],
  ],
  odometry: [
    ['the squared rotations', 'ω', 'swing'],
    ['the squared distance', 'v', 'fan'],
    ['the squared distance', 'v', 'smear'],
    ['the squared rotations', 'ω', 'smear'],
  ],
};

/** Below this, metres or radians, a spread is none: rounding of the quadrature, not noise. */
const NO_SPREAD = 1e-9;

/**
 * @param {Settings['model']} model
 * @param {number} index from 0
 */
export function effectOf(model, index) {
  const [path, picture] = EFFECTS[model][index];
  return html`<span class="path">${path}:</span> ${picture}.`;
}

/** @param {number} index from 0 */
export function alphaSymbol(index) {
  return html`<i>α</i><sub>${index + 1}</sub>`;
}

/** @param {number} index from 0 */
export function alphaName(index) {
  return `α${String.fromCharCode(0x2081 + index)}`;
}

/**
 * What kind of spread the cloud has, by the exact covariance.
 *
 * @param {Table} table
 * @returns {'point' | 'headings' | 'cloud'} one pose; one place but many headings; or a spread
 */
export function spreadOf(table) {
  const { cov } = table.exact;
  if (Math.sqrt(Math.max(0, cov[0][0], cov[1][1])) > NO_SPREAD) return 'cloud';
  return Math.sqrt(Math.max(0, cov[2][2])) > NO_SPREAD ? 'headings' : 'point';
}

/** Sentences on clouds that are not what a reader expects. */
const NOTES = {
  still: 'The command is to stand still, and a robot at rest has no motion noise.',
  silent: 'Every α is 0: no noise at all, so every robot stops exactly where it was told to.',
  unfed: 'No α that is above 0 has anything to multiply in this command: no noise at all.',
  headings: 'Only γ̂ is noisy: every robot stops at the same point, and only the headings fan out.',
  circle: 'Some robots turn nearly a full circle. Exponential coordinates end there, and their figures with them.',
  backwards: 'Odometry reads backing up as two half turns, and the table charges noise for both.',
  line: 'Only one number is noisy: the robots lie on a line, and an outline without area holds no share of them.',
};

/**
 * A sentence on a cloud that is not what a reader expects, from the settings that made it so.
 *
 * @param {Settings} config
 * @param {Table} table
 * @param {Stats} stats
 * @param {boolean} chartHolds whether exponential coordinates reach as far as the robots turn
 * @returns {string} empty for an ordinary cloud
 */
export function noteOn(config, table, stats, chartHolds) {
  const spread = spreadOf(table);
  const { v, omega } = config.command;
  if (spread === 'point') {
    if (v === 0 && omega === 0) return NOTES.still;
    if (config.isolate !== null) return noteOnSilentAlpha(config.model, config.isolate - 1, config.alphas);
    return config.alphas.every((alpha) => alpha === 0) ? NOTES.silent : NOTES.unfed;
  }
  if (spread === 'headings') return NOTES.headings;
  if (!chartHolds) return NOTES.circle;
  if (config.model === 'odometry' && v < 0) return NOTES.backwards;
  return stats.n > 2 && Object.values(stats.coverage).some(Number.isNaN) ? NOTES.line : '';
}

/**
 * @param {Settings['model']} model
 * @param {number} index of the isolated α, from 0
 * @param {number[]} [alphas]
 */
function noteOnSilentAlpha(model, index, alphas) {
  const name = alphaName(index);
  if (alphas?.[index] === 0) return `${name} is alone and 0: no noise at all. Turn it up.`;
  const [driver, cause, picture] = DRIVERS[model][index];
  const verb = driver.startsWith('the') ? 'are' : 'is';
  const zero = driver.startsWith('the') ? `${driver} ${verb} 0` : `${cause} is 0`;
  return `${name} multiplies ${driver}, and ${zero}: no noise at all. Turn ${cause} up a little and watch it ${picture}.`;
}

/** The longest of the sentences that may come, to keep room for. */
export function longestNote() {
  const silent = Object.entries(DRIVERS).flatMap(([model, drivers]) =>
    drivers.map((_, index) => noteOnSilentAlpha(/** @type {Settings['model']} */ (model), index)),
  );
  return longest([...Object.values(NOTES), ...silent]);
}

/**
 * The command in words.
 *
 * @param {Settings['command']} command
 */
export function commandText({ v, omega, dt }) {
  return `v = ${fixed(v, 2)} m/s, ω = ${fixed(omega, 2)} rad/s, Δt = ${fixed(dt, 2)} s`;
}

/**
 * What is announced after a change has come to rest.
 *
 * @param {Settings} config
 * @param {Stats} stats
 * @param {string} note
 */
export function announcementOf(config, stats, note) {
  const skew = Number.isNaN(stats.crossTrackSkew)
    ? 'Cross-track skew undefined.'
    : `Cross-track skew ${withError(stats.crossTrackSkew, stats.crossTrackSkewError, 2)}.`;
  return `${whole(stats.n)} robots, ${commandText(config.command)}. ${note || skew}`;
}

/**
 * The text equivalent of the view of the floor.
 *
 * @param {Settings} config
 * @param {Stats} stats
 * @param {string} note
 * @param {string[]} overlays names of the outlines that are shown
 */
export function planeText(config, stats, note, overlays) {
  const start = `View of the floor from above, x to the right and y up. Commanded: ${commandText(config.command)}.`;
  const drawn = overlays.length ? ` Drawn over it: ${overlays.join(', ')}.` : '';
  if (stats.n === 0) return `${start} No robots yet.${drawn}`;
  const [x, y] = stats.cartesian.mean;
  const mean = `${whole(stats.n)} robots end around x ${fixed(x, 2)} m, y ${fixed(y, 2)} m.`;
  if (note) return `${start} ${mean} ${note}${drawn}`;
  const { cov } = stats.cartesian;
  const spread = `Standard deviations ${fixed(Math.sqrt(cov[0][0]), 2)} m in x and ${fixed(Math.sqrt(cov[1][1]), 2)} m in y.`;
  return `${start} ${mean} ${spread} ${bendText(stats)}${drawn}`;
}

/** @param {Stats} stats */
function bendText({ crossTrackSkew: skew, crossTrackSkewError: error }) {
  if (Number.isNaN(skew)) return '';
  const figure = `skew ${withError(skew, error, 2)}`;
  if (Math.abs(skew) < 2 * error) return `Too few robots to tell to which side the cloud leans: ${figure}.`;
  if (Math.abs(skew) < 0.05) return `The cloud hardly leans to either side: ${figure}.`;
  return `The cloud is bent, with its tail to the ${skew < 0 ? 'right' : 'left'} of the mean heading: ${figure}.`;
}

/**
 * What stands under the view of the floor while there is nothing to note.
 *
 * @param {Stats} stats
 */
export function captionOf(stats) {
  if (stats.n === 0) return 'No robots yet.';
  return bendText(stats) || 'Too few robots for a skew.';
}

/** @param {number} skew exact */
export function skewText(skew) {
  return Number.isNaN(skew) ? 'exact skew undefined' : `exact skew ${fixed(skew, 3)}`;
}

/**
 * What stands under the view in exponential coordinates: how Gaussian they make this cloud, unless
 * there is something else to note about it.
 *
 * @param {Settings} config
 * @param {string} note
 */
export function twistCaption({ model, noise, alphas, isolate }, note) {
  const start = 'The same robots in exponential coordinates';
  if (note) return `${start}.`;
  if (model === 'odometry') {
    return `${start}: only roughly a Gaussian. Odometry noise enters at three hinges, not along one arc, and the predicted skew misses.`;
  }
  const turned = alphas.some((alpha, i) => i >= 4 && alpha > 0 && (isolate === null || isolate === i + 1));
  if (noise === 'triangular') return `${start}: no longer bent, though triangular noise is not Gaussian.`;
  return turned
    ? `${start}: nearly a Gaussian. What keeps it from being one is γ̂, which turns a robot after its arc.`
    : `${start}: exactly a Gaussian, whose outline is an ellipse.`;
}

/**
 * The text equivalent of the view in exponential coordinates.
 *
 * @param {Stats} stats
 */
export function twistText(stats) {
  const start = 'The same robots in exponential coordinates, ξ along to the right and ξ heading up.';
  if (stats.n < 2) return `${start} ${stats.n === 0 ? 'No robots yet.' : 'One robot.'}`;
  const { mean, cov } = stats.exponential;
  return (
    `${start} Mean ${fixed(mean[0], 2)} m and ${fixed(mean[2], 2)} rad, standard deviations ` +
    `${fixed(Math.sqrt(cov[0][0]), 2)} m and ${fixed(Math.sqrt(cov[2][2]), 2)} rad. ` +
    `${percent(stats.coverage.exponential)} lie inside the 2σ ellipse.`
  );
}
