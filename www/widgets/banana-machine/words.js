/**
 * What the Banana Machine says when, in the words of the present language: sentences about degenerate
 * clouds, and the text that stands for the pictures.
 */

import { addEnglish, words } from '../../messages/registry.js';
import { longest } from '../../ui/controls.js';
import { counted, fixed, percent, withError } from '../../ui/format.js';
import { commandText } from '../shared/command.js';
import { en } from './en.js';
import { deviation, silenceOf } from './reading.js';

/**
 * @import { Stats } from '../../types.d.ts'
 * @import { Reading } from './reading.js'
 */

addEnglish({ banana: en });

/** The longest of the sentences that may come, to keep room for. */
export function longestNote() {
  const { notes, settings } = words.banana;
  const { velocity, odometry } = settings.alphas.effects;
  const silences = [...velocity.map((_, i) => silenceOf('velocity', i)), ...odometry.map((_, i) => silenceOf('odometry', i))];
  return longest([...Object.values(notes), ...silences]);
}

/** What is announced after a change has come to rest. @param {Reading} reading */
export function announcementOf({ config, stats, note }) {
  const { announcement, skew, noSkew } = words.banana;
  const outcome = Number.isNaN(stats.crossTrackSkew)
    ? noSkew
    : skew(withError(stats.crossTrackSkew, stats.crossTrackSkewError, 2));
  return announcement(counted(stats.n), commandText(config.command), note || outcome);
}

/**
 * The text equivalent of the view of the floor.
 *
 * @param {Reading} reading
 * @param {string[]} overlays names of the outlines that are shown
 */
export function planeText({ config, stats, note }, overlays) {
  const { plane, noRobots, mean, spread, drawnOver } = words.banana;
  const sentences = [plane(commandText(config.command))];
  if (stats.n === 0) sentences.push(noRobots);
  else {
    const { mean: centre, cov } = stats.cartesian;
    sentences.push(mean(counted(stats.n), fixed(centre[0], 2), fixed(centre[1], 2)));
    if (note) sentences.push(note);
    else sentences.push(spread(deviationText(cov[0][0]), deviationText(cov[1][1])), bendText(stats));
  }
  if (overlays.length) sentences.push(drawnOver(overlays.join(', ')));
  return sentences.filter(Boolean).join(' ');
}

/** @param {number} variance */
function deviationText(variance) {
  return fixed(deviation(variance), 2);
}

/** @param {Stats} stats */
function bendText({ crossTrackSkew: skew, crossTrackSkewError: error }) {
  if (Number.isNaN(skew)) return '';
  const { unsure, hardly, right, left } = words.banana.bend;
  const sentence = Math.abs(skew) < 2 * error ? unsure : Math.abs(skew) < 0.05 ? hardly : skew < 0 ? right : left;
  return sentence(withError(skew, error, 2));
}

/** What stands under the view of the floor. @param {Reading} reading */
export function captionOf({ note, stats }) {
  return note || (stats.n === 0 ? words.banana.noRobots : bendText(stats) || words.banana.fewRobots);
}

/** @param {number} skew exact */
export function skewText(skew) {
  return Number.isNaN(skew) ? words.banana.noExactSkew : words.banana.exactSkew(fixed(skew, 3));
}

/**
 * What stands under the view in exponential coordinates: how Gaussian they make this cloud, unless
 * there is something else to note about it.
 *
 * @param {Reading} reading
 */
export function twistCaption({ config: { model, noise, alphas, isolate }, note }) {
  const { twist, twistIs } = words.banana;
  if (note) return `${twist}.`;
  const turned = alphas.some((alpha, i) => i >= 4 && alpha > 0 && (isolate === null || isolate === i + 1));
  const kind = model === 'odometry' ? model : noise === 'triangular' ? noise : turned ? 'turned' : 'exact';
  return `${twist}: ${twistIs[kind]}`;
}

/** The text equivalent of the view in exponential coordinates. @param {Reading} reading */
export function twistText({ stats: { n, exponential, coverage } }) {
  const { mean, cov } = exponential;
  const { twist, twistAxes, noRobots, oneRobot, twistMoments } = words.banana;
  const start = `${twist}, ${twistAxes}.`;
  if (n < 2) return `${start} ${n === 0 ? noRobots : oneRobot}`;
  const [along, heading] = [fixed(mean[0], 2), fixed(mean[2], 2)];
  const [ofAlong, ofHeading] = [deviationText(cov[0][0]), deviationText(cov[2][2])];
  return `${start} ${twistMoments(along, heading, ofAlong, ofHeading, percent(coverage.exponential))}`;
}
