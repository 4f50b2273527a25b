/** Texts of the Banana Machine in the present language: sentences about degenerate clouds, and text equivalents of the pictures. */

import { addEnglish, words } from '../../messages/registry.ts';
import { integer, fixed, percent, formatWithError } from '../../ui/format.ts';
import { commandText } from '../shared/sliders.ts';
import { en } from './en.ts';
import { deviationOf, spreadKind, type ViewModel } from './view-model.ts';
import type { Callout } from '../../scene/callout.ts';

addEnglish({ banana: en });

/** Returns the text equivalent of the view of the floor, with the names of the outlines that are shown. */
export function planeText(viewModel: ViewModel, overlays: string[], morph: number) {
  const { config, stats, table, note } = viewModel;
  const { plane, between, noRobots, mean, onePlace, spread, drawnOver } = words.banana;
  const commandPhrase = commandText(config.command);
  const planeSentences = [morph === 0 ? plane(commandPhrase) : between(percent(morph), commandPhrase)];
  if (stats.n === 0) planeSentences.push(noRobots);
  else {
    const { mean: centre, cov } = stats.cartesian;
    planeSentences.push((spreadKind(table) === 'cloud' ? mean : onePlace)(integer(stats.n), fixed(centre[0], 2), fixed(centre[1], 2)));
    if (note) planeSentences.push(note);
    else planeSentences.push(spread(deviationText(cov[0][0]), deviationText(cov[1][1])), bendText(viewModel));
  }
  if (overlays.length) planeSentences.push(drawnOver(overlays.join(', ')));
  return planeSentences.filter(Boolean).join(' ');
}

function deviationText(variance: number) {
  return fixed(deviationOf(variance), 2);
}

/** Absolute value of an exact skew below which it counts as 0. The rounding of the quadrature is about 1e-15. */
const MIN_NONZERO_SKEW = 1e-9;

/** Absolute skew below which the asymmetry of a cloud is not visible. */
const VISIBLE_SKEW = 0.05;

/** Minimum gain, nats per robot, at which a hundred robots distinguish the two Gaussians: their likelihood ratio is e² or more. */
const MIN_GAIN = 0.02;

/** Area ratio above which the ellipse is visibly too large. */
const VISIBLE_AREA_RATIO = 1.1;

/** Gains (nats per robot) above which the cloud is visibly bent: a likelihood ratio of e for 20 positions, or for 10 poses. */
const VISIBLE_GAINS = { floor: 0.05, pose: 0.1 };

/** Returns the title of the view of the floor: how the ellipse fits, by exact values, or by the samples where there are no exact values. */
export function floorTitle({ stats, table: { exact } }: Pick<ViewModel, 'stats' | 'table'>) {
  const { floor, ellipseIs } = words.banana;
  if (stats.n < 2 || Number.isNaN(stats.areaRatio)) return floor;
  const { areaRatio, likelihoodGain: { floor: onFloor, pose } } = Number.isNaN(exact.areaRatio) ? stats : exact;
  // The gain of poses is infinite if their covariance is singular, and then says nothing about the bend.
  const isMisshapen = onFloor > VISIBLE_GAINS.floor || (pose > VISIBLE_GAINS.pose && pose < Infinity) || Math.abs(exact.crossTrackSkew) > VISIBLE_SKEW;
  const ellipseFit = areaRatio > VISIBLE_AREA_RATIO ? 'large' : isMisshapen ? 'misshapen' : 'near';
  return `${floor}: ${ellipseIs[ellipseFit]}`;
}

/** Returns the callouts of the floor, at points that only the ellipse covers. */
export const calloutsOf = ({ gaps }: ViewModel): Callout[] =>
  words.banana.callouts.slice(0, gaps.length / 2).map((text, i) => ({ text, at: [gaps[2 * i], gaps[2 * i + 1]] }));

/** Returns a sentence on the bend of the cloud. The exact skew determines its side, and the skew of the samples its significance. */
function bendText({ stats: { crossTrackSkew: skew, crossTrackSkewError: error, areaRatio, exponential: { mean, cov } }, exactSkew, table, gain }: ViewModel) {
  if (Number.isNaN(skew)) return '';
  const texts = words.banana.bend;
  // A line break must not separate a number from its error.
  const joinWithNonBreakingSpaces = (number: string) => number.replaceAll(' ', '\u00a0');
  const [measuredSkew, exactText] = [joinWithNonBreakingSpaces(formatWithError(skew, error, 3)), fixed(exactSkew, 3)];
  // Robots end on both sides of the start.
  if (deviationOf(cov[0][0]) > Math.abs(mean[0])) return texts.bowTie(fixed(mean[0], 2), deviationText(cov[0][0]), measuredSkew);
  if (Math.abs(exactSkew) < VISIBLE_SKEW) {
    const skewSentence = Math.abs(exactSkew) < MIN_NONZERO_SKEW ? texts.neither(measuredSkew) : texts.hardly(measuredSkew, exactText);
    // There are no exact values if robots turn by more than π.
    const lesserOf = (sampled: number, exact: number) => (Number.isNaN(exact) ? sampled : Math.min(sampled, exact));
    if (lesserOf(areaRatio, table.exact.areaRatio) > VISIBLE_AREA_RATIO) return `${texts.wide(fixed(areaRatio, 2))} ${skewSentence}`;
    const smallerGain = lesserOf(gain.value, gain.exact);
    return smallerGain > MIN_GAIN ? `${texts.gains(joinWithNonBreakingSpaces(formatWithError(gain.value, gain.error, 3)), smallerGain > VISIBLE_GAINS.pose)} ${skewSentence}` : skewSentence;
  }
  if (Math.abs(skew) < 2 * error || skew * exactSkew < 0) return texts.unsure(measuredSkew, exactText);
  return texts.bent(measuredSkew, exactSkew > 0);
}

export function captionOf(viewModel: ViewModel) {
  const { note, stats } = viewModel;
  return note || (stats.n === 0 ? words.banana.noRobots : bendText(viewModel) || words.banana.fewRobots);
}

/** Returns the caption of the view in exponential coordinates: how Gaussian they make the cloud, or another note about it. */
export function twistCaption({ config: { model, noise, alphas, isolate }, note }: ViewModel) {
  const { twist, twistIs } = words.banana;
  if (note) return `${twist}.`;
  const hasFinalTurn = alphas.some((alpha, i) => i >= 4 && alpha > 0 && (isolate === null || isolate === i + 1));
  const captionKind = model === 'odometry' ? model : noise === 'triangular' ? noise : hasFinalTurn ? 'turned' : 'exact';
  return `${twist}: ${twistIs[captionKind]}`;
}

export function twistText({ stats: { n, exponential, coverage } }: ViewModel) {
  const { mean, cov } = exponential;
  const { twist, twistAxes, robotsHere, twistMoments } = words.banana;
  const textStart = `${twist}, ${twistAxes}.`;
  if (n < 2) return `${textStart} ${robotsHere(integer(n))}.`;
  const [along, heading] = [fixed(mean[0], 2), fixed(mean[2], 2)];
  const [alongDeviation, headingDeviation] = [deviationText(cov[0][0]), deviationText(cov[2][2])];
  const coverageText = Number.isNaN(coverage.exponential) ? '' : percent(coverage.exponential);
  return `${textStart} ${twistMoments(along, heading, alongDeviation, headingDeviation, coverageText)}`;
}
