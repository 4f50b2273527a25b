/** Readouts of the Banana Machine and their text alternatives: statistics of the cloud, the marked robot, and tables of moments. */

import { html } from 'lit';
import { addEnglishMessages, words } from '../../messages/registry.ts';
import { formatMarkup } from '../../ui/controls.ts';
import { formatInteger, formatRounded, formatFixed, formatPercent, formatWithError, NO_VALUE, formatSignificant } from '../../ui/format.ts';
import { tableHtml, readoutsHtml } from '../../ui/readouts.ts';
import { sampleFieldHtml } from '../shared/cloud.ts';
import { en } from './en.ts';
import { stdOfVariance, type ViewModel } from './settings.ts';
import type { Callout } from '../../scene/labels.ts';
import type { Inspection, Moments } from '../../types.d.ts';

addEnglishMessages({ banana: en });

/** Absolute skew below which an exact skew counts as 0. Rounding errors of the quadrature are about 1e-15. */
const MIN_NONZERO_SKEW = 1e-9;

/** Absolute skew below which the asymmetry of a cloud is not visible. */
const VISIBLE_SKEW = 0.05;

/** Minimum gain in log-likelihood (nats per robot) at which a hundred robots distinguish two Gaussians: the likelihood ratio is then at least e². */
const MIN_DISTINGUISHABLE_GAIN = 0.02;

/** Ratio of the ellipse's area to that of the ξ outline, above which the ellipse is visibly too large. */
const VISIBLE_AREA_RATIO = 1.1;

/** Gains in log-likelihood (nats per robot) above which the cloud is visibly bent: a likelihood ratio of e for 20 positions (`floor`), or for 10 poses (`pose`). */
const VISIBLE_GAINS = { floor: 0.05, pose: 0.1 };

/** Returns the title of the floor picture, which says how well the ellipse fits the cloud. It uses exact statistics, or if they are undefined, those of the samples. */
export function floorTitleOf({ stats, table: { exact } }: Pick<ViewModel, 'stats' | 'table'>) {
  const { floorTitle, ellipseDescriptions } = words.banana;
  if (stats.n < 2 || Number.isNaN(stats.areaRatio)) return floorTitle;
  const { areaRatio, likelihoodGain: { floor: floorGain, pose } } = Number.isNaN(exact.areaRatio) ? stats : exact;
  // If the covariance of poses is singular, their gain in log-likelihood is infinite, and does not show whether the cloud is bent.
  const isMisshapen = floorGain > VISIBLE_GAINS.floor || (pose > VISIBLE_GAINS.pose && pose < Infinity) || Math.abs(exact.crossTrackSkew) > VISIBLE_SKEW;
  const ellipseFit = areaRatio > VISIBLE_AREA_RATIO ? 'tooLarge' : isMisshapen ? 'wrongShape' : 'nearlyFitting';
  return `${floorTitle}: ${ellipseDescriptions[ellipseFit]}`;
}

/** Returns the callouts of the floor picture. They are at points inside the ellipse where no robots are. */
export const calloutsOf = ({ gaps }: ViewModel): Callout[] =>
  words.banana.callouts.slice(0, gaps.length / 2).map((calloutText, i) => ({ text: calloutText, point: [gaps[2 * i], gaps[2 * i + 1]] }));

/** Returns a sentence on the bend of the cloud. The exact skew determines the side of the bend, and the samples' skew whether it is significant. */
function bendSentenceOf({ stats: { crossTrackSkew: skew, crossTrackSkewError: error, areaRatio, exponential: { mean, cov } }, exactSkew, table, exponentialGain: gain }: ViewModel) {
  if (Number.isNaN(skew)) return '';
  const texts = words.banana.skewSentences;
  // A line break must not separate a number from its standard error.
  const joinWithNonBreakingSpaces = (numberText: string) => numberText.replaceAll(' ', '\u00a0');
  const [skewText, exactText] = [joinWithNonBreakingSpaces(formatWithError(skew, error, 3)), formatFixed(exactSkew, 3)];
  // The cloud is shaped like a bow-tie, because some robots end ahead of the start, and others behind it.
  if (stdOfVariance(cov[0][0]) > Math.abs(mean[0])) return texts.bowTie(formatFixed(mean[0], 2), formatFixed(stdOfVariance(cov[0][0]), 2), skewText);
  if (Math.abs(exactSkew) < VISIBLE_SKEW) {
    const skewSentence = Math.abs(exactSkew) < MIN_NONZERO_SKEW ? texts.symmetric(skewText) : texts.nearlySymmetric(skewText, exactText);
    // Exact statistics are undefined if robots turn by more than π. Those of the samples are used then.
    const lesserDefinedOf = (sampledNumber: number, exact: number) => (Number.isNaN(exact) ? sampledNumber : Math.min(sampledNumber, exact));
    if (lesserDefinedOf(areaRatio, table.exact.areaRatio) > VISIBLE_AREA_RATIO) return `${texts.largeEllipse(formatFixed(areaRatio, 2))} ${skewSentence}`;
    const smallerGain = lesserDefinedOf(gain.value, gain.exact);
    return smallerGain > MIN_DISTINGUISHABLE_GAIN ? `${texts.betterFit(formatRounded(Math.exp(gain.value), 3), smallerGain > VISIBLE_GAINS.pose)} ${skewSentence}` : skewSentence;
  }
  if (Math.abs(skew) < 2 * error || skew * exactSkew < 0) return texts.tooFewRobots(skewText, exactText);
  return texts.bent(skewText, exactSkew > 0);
}

export function captionOf(viewModel: ViewModel) {
  const { unusualCloudNote, stats } = viewModel;
  return unusualCloudNote || (stats.n === 0 ? words.banana.noRobotsNote : bendSentenceOf(viewModel) || words.banana.fewRobotsNote);
}

/** Returns the caption of the picture in exponential coordinates. It says whether the cloud is Gaussian in these coordinates. */
export function twistCaptionOf({ config: { model, noise, alphas, isolate }, unusualCloudNote }: ViewModel) {
  const { twistTitle, twistDescriptions } = words.banana;
  if (unusualCloudNote) return `${twistTitle}.`;
  const hasFinalTurn = alphas.some((alpha, i) => i >= 4 && alpha > 0 && (isolate === null || isolate === i + 1));
  const captionKind = model === 'odometry' ? model : noise === 'triangular' ? noise : hasFinalTurn ? 'lastTurn' : 'exact';
  return `${twistTitle}: ${twistDescriptions[captionKind]}`;
}

/** Fraction of a two-dimensional Gaussian that is inside its 2σ ellipse: 1 − e⁻². */
const FRACTION_IN_ELLIPSE = 1 - Math.exp(-2);

/**
 * Returns the three main numbers: the ellipse's area ratio, the gain in log-likelihood by exponential coordinates, and the skew. Next to them are the
 * numbers of the pinned cloud, if any.
 */
export function mainReadoutsHtml(viewModel: ViewModel, pinnedViewModel?: ViewModel) {
  const texts = words.banana.readouts;
  const { stats: { coverage, areaRatioError }, exactSkew, exponentialGain: gain } = viewModel;
  const printedStatistics = printedStatisticsOf(viewModel);
  const pinnedStatistics = pinnedViewModel && printedStatisticsOf(pinnedViewModel).map((printedStatistic) => `${words.banana.pinnedLabel}: ${printedStatistic}`);
  const coverages = [coverage.ellipse, coverage.exponential];
  return readoutsHtml([
    [texts.areaRatio, printedStatistics[0], coverages.every(Number.isNaN) ? NO_VALUE : texts.areaRatioDetail(Number.isNaN(areaRatioError) ? '' : formatSignificant(areaRatioError, 1), formatPercent(coverages[0]), formatPercent(coverages[1])), pinnedStatistics?.[0]],
    // A gain of positions and a gain of poses are not comparable. If only one of the two clouds (pinned and current) has a gain of positions, the pinned gain is left out.
    [gain.unbounded ? texts.gainOnFloor : texts.gain, printedStatistics[1], formatGain(gain), pinnedViewModel?.exponentialGain.unbounded === gain.unbounded ? pinnedStatistics?.[1] : undefined],
    [texts.skew, printedStatistics[2], Number.isNaN(exactSkew) ? NO_VALUE : texts.exactValue(formatFixed(exactSkew, 3)), pinnedStatistics?.[2]],
  ], 0);
}

/** Returns the printed area ratio, gain in log-likelihood, and skew. */
function printedStatisticsOf({ stats, exponentialGain: gain }: ViewModel) {
  return [
    Number.isNaN(stats.areaRatio) ? NO_VALUE : `${formatFixed(stats.areaRatio, 2)} ×`,
    formatWithError(gain.value, gain.error, 3),
    formatWithError(stats.crossTrackSkew, stats.crossTrackSkewError, 3),
  ];
}

/** Returns a text on the exact gain in log-likelihood, or the reason why the gain is unbounded. */
function formatGain({ unbounded, value, exact, wrapsHeadings }: ViewModel['exponentialGain']) {
  const { unlimitedGain, unlimitedGainOnLine, exactValue, exactUnwrappedValue, likelihoodNote } = words.banana.readouts;
  if (Number.isNaN(value)) return NO_VALUE;
  if (value === Infinity) return unlimitedGainOnLine;
  if (unbounded) return unlimitedGain;
  const likelihoodText = likelihoodNote(formatRounded(Math.exp(value), 3));
  if (Number.isNaN(exact)) return likelihoodText;
  return wrapsHeadings ? exactUnwrappedValue(formatFixed(exact, 3)) : `${exactValue(formatFixed(exact, 3))}; ${likelihoodText}`;
}

export function otherReadoutsHtml({ config, stats }: ViewModel) {
  const texts = words.banana.readouts;
  const { countOfTotal } = words.banana;
  return readoutsHtml([
    [texts.shownRobots, countOfTotal(formatInteger(stats.n), formatInteger(config.samples))],
    [texts.gaussianSkew, formatFixed(stats.gaussianSkew, 3)],
    [texts.headingCorrelation, formatFixed(stats.rhoCrossHeading, 3)],
    [texts.nominalCoverage, formatPercent(FRACTION_IN_ELLIPSE)],
  ]);
}

/** Returns the input field for the number of the marked robot, followed by the motion of that robot. */
export function markedRobotFieldHtml(figure: import('./banana-machine.ts').BananaMachineElement, inspection: Inspection | undefined): import('lit').TemplateResult {
  const { shown, odometryReading } = figure.viewModel;
  const quantityHtml = (symbol: string, quantity: number, unit: string) => html`<span>${formatMarkup(symbol)} = ${formatFixed(quantity, 3)} ${unit}</span>`;
  if (!inspection) return sampleFieldHtml(figure, 'robot', shown, undefined);
  const { legs, vHat, omegaHat, gammaHat } = inspection;
  // The noise of a leg is the odometry reading minus the executed motion, as in Table 5.6.
  return sampleFieldHtml(figure, 'robot', shown, legs && odometryReading
    ? ([['rot1', 'rad'], ['trans', 'm'], ['rot2', 'rad']] as const).map(([leg, unit]) => quantityHtml(`*ε*_{${leg}}`, odometryReading[leg] - legs[leg], unit))
    : [quantityHtml('*v̂*', vHat, 'm/s'), quantityHtml('*ω̂*', omegaHat, 'rad/s'), quantityHtml('*γ̂*', gammaHat, 'rad/s')]);
}

/** Significant digits of computed moments (as many as in the book), and of moments measured from samples. */
const COMPUTED_DIGITS = 5;
const MEASURED_DIGITS = 3;

type MomentsRow = [name: unknown, (column: Moments & { crossTrackSkew: number }) => number];

/** Returns the table of the worked example: moments by linearization, exact moments, and moments of the samples. */
export function workedExampleTableHtml({ table: { linearized, exact, measured } }: ViewModel) {
  const texts = words.banana.table;
  const symbolHtml = (symbolLetter: string, indices: string) => html`<i>${symbolLetter}</i><sub><i>${indices}</i></sub>`;
  const momentRows: MomentsRow[] = [
    ...['x', 'y', 'θ'].map((axis, i): MomentsRow => [formatMarkup(texts.mean(`*${axis}*`)), ({ mean }) => mean[i]]),
    ...['xx', 'yy', 'xy', 'xθ', 'yθ', 'θθ'].map((axisPair): MomentsRow => [symbolHtml('Σ', axisPair), ({ cov }) => cov['xyθ'.indexOf(axisPair[0])]['xyθ'.indexOf(axisPair[1])]]),
    [symbolHtml('ρ', 'yθ'), ({ cov }) => cov[1][2] / Math.sqrt(cov[1][1] * cov[2][2])],
    [words.banana.readouts.skew, ({ crossTrackSkew }) => crossTrackSkew],
  ];
  return tableHtml({
    caption: texts.caption,
    columnHeadings: [texts.quantity, texts.linearized, texts.exact, texts.measured],
    rows: momentRows.map(([name, momentOf]) => [name, ...[linearized, exact].map((moments) => formatSignificant(momentOf(moments), COMPUTED_DIGITS)), formatSignificant(momentOf(measured), MEASURED_DIGITS)]),
  });
}
