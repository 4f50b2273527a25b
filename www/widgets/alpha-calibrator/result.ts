/** Results of a fit as text, for the page and the command line: numbers, the verdict, and lines for nav2_params.yaml. */

import { MINUS_SIGN, NO_VALUE, formatFixed, formatPercent, formatPowerOfTen, formatInteger } from '../../ui/format.ts';
import { subscriptOf } from '../shared/sliders.ts';
import { en, yamlWords } from './en.ts';
import type { CalibrationCheck, CalibrationStats } from '../../types.d.ts';
import type { LogWarning } from '../../logs/log.ts';

type Interval = [number, number] | null;

/** Fit of α's to a log, and the options of the fit. */
export interface CalibrationResult {
  stats: CalibrationStats;
  legCount: number;
  model: string;
  rule: string;
  /** Distance, rotation or duration at which a leg ends. */
  legLength: { distance?: number, angle?: number, duration?: number };
  /** False for each systematic error that the user does not want to correct. */
  corrections: { [name in (typeof SYSTEMATIC_ERRORS)[number]]?: boolean };
  /** Names of the odometry and reference logs. */
  logName: string;
  /** Warnings about the logs. They make the α's doubtful. */
  warnings: LogWarning[];
}

type CalibratorTexts = typeof import('./en.ts').en;

/** Number of significant digits of an interval's width, which determines the decimals, and number of significant digits of values without an interval. */
const [INTERVAL_WIDTH_DIGITS, VALUE_DIGITS] = [2, 3];

/** Absolute value below which numbers are printed with an exponent of ten. */
const MIN_PLAIN_NUMBER = 1e-6;

const MAX_DECIMALS = 12;

/** Absolute value from which numbers are printed with an exponent of ten. Times since 1970 are smaller, and printed without it. */
const MAX_PLAIN_NUMBER = 1e15;

/** Largest plausible α. An α of 1 means noise as large as the motion itself, or of one radian per metre. */
const MAX_PLAUSIBLE_ALPHA = 1;

/** Maximum number of failed checks that a sentence names, because the page has little space. */
const MAX_NAMED_CHECKS = 2;

/** Text for a missing number. */
const NO_NUMBER = '–';

/** Names of Nav2's motion model plugins, by motion model. */
const NAV2_PLUGINS: Record<string, string> = { odometry: 'nav2_amcl::DifferentialMotionModel', omnidirectional: 'nav2_amcl::OmniMotionModel' };

/** Noise rules that Nav2's motion models use. A noise rule is a set of formulas for the variances, given the α's. */
export const NAV2_RULES = ['nav2', 'omni'];

/** Returns true if Nav2 can use α's that were fitted with a model and a noise rule. */
export const isNav2Rule = (model: string, rule: string): boolean => model !== 'odometry' || NAV2_RULES.includes(rule);

export const formatNumber = (number: number | null, digitCount = VALUE_DIGITS) => (number !== null && Number.isFinite(number) ? addMantissaPoint(String(Number(number.toPrecision(digitCount)))) : NO_NUMBER);

/** Adds a decimal point to a number with an exponent. YAML 1.1 parses a number without the point as a string. */
const addMantissaPoint = (numberText: string) => numberText.replace(/^(-?\d)e/, '$1.0e');

/** Adds a decimal to a whole number, because Nav2 refuses integers for parameters of type double. */
const addDecimalPoint = (numberText: string) => (numberText.includes('.') ? numberText : `${numberText}.0`);

/** Prints a value with the decimals that its interval justifies. A value that rounds to 0 is printed without a sign. */
export function formatEstimate(number: number | null, interval: Interval | undefined) {
  const intervalWidth = interval ? interval[1] - interval[0] : 0;
  if (number === null || !(Math.abs(number) < MAX_PLAIN_NUMBER) || !(intervalWidth > 0 && intervalWidth < Infinity)) return formatNumber(number);
  const decimalCount = INTERVAL_WIDTH_DIGITS - 1 - Math.floor(Math.log10(intervalWidth));
  if (intervalWidth >= MIN_PLAIN_NUMBER || Math.abs(number) >= MIN_PLAIN_NUMBER) return number.toFixed(Math.max(0, Math.min(MAX_DECIMALS, decimalCount))).replace(/^-(?=[0.]+$)/, '');
  const mantissaDecimals = decimalCount + Math.floor(Math.log10(Math.abs(number)));
  return mantissaDecimals < 0 ? '0' : addMantissaPoint(number.toExponential(Math.min(MAX_DECIMALS, mantissaDecimals)));
}

/** Prints an interval; returns an empty text if one of its bounds is not finite. */
export const formatInterval = (interval: Interval | undefined) => (interval?.every(Number.isFinite) ? interval.map((bound) => formatEstimate(bound, interval)).join(' to ') : '');

/** Returns true if an α would be printed as 0 with the decimals that its interval justifies. A reader could take such a 0 for an exact result. */
const isPrintedAsZero = (alpha: number | null, interval: Interval | undefined) => alpha !== null && Number(formatEstimate(alpha, interval)) === 0;

/** Converts a printed number such as -1.5e-7 to the decimal sign and minus sign of the language, and a power of ten. */
export const localizeNumber = (numberText: string) =>
  numberText.replace(/^-/, MINUS_SIGN).replace('.', formatFixed(0.5, 1)[1]).replace(/e(-?\d+)$/, (_, exponent) => `·${formatPowerOfTen(Number(exponent))}`);

/** Prints an interval in the current language; a dash if one of its bounds is not finite. */
export const localizeInterval = (interval: Interval | undefined) =>
  (interval?.every(Number.isFinite) ? interval.map((bound) => localizeNumber(formatEstimate(bound, interval))).join(' – ') : NO_VALUE);

const formatUpperEnd = (interval: Interval | undefined) => formatNumber(interval?.[1] ?? null, INTERVAL_WIDTH_DIGITS);

const scaleInterval = (interval: Interval, inflation: number): Interval => interval && [inflation * interval[0], inflation * interval[1]];

/** Prints an α times a factor. If the α is not significantly different from 0, prints its upper bound instead. */
export const formatAlphaOrBound = (alpha: number | null, interval: Interval, inflation = 1) => (isPrintedAsZero(alpha, interval) ? `≤ ${formatUpperEnd(scaleInterval(interval, inflation))}` : formatEstimate(alpha && inflation * alpha, scaleInterval(interval, inflation)));

/** Returns the distance and rotation, or the duration, at which a leg ends, as text. */
export const describeLegLength = ({ distance = NaN, angle = NaN, duration }: CalibrationResult['legLength']) =>
  (duration === undefined ? yamlWords.legsByMotion(formatNumber(distance), formatNumber(angle)) : yamlWords.legsByDuration(formatNumber(duration)));

/**
 * Returns the lines for nav2_params.yaml with the recommended α's; comments in them have the fitted α's. The text is empty if Nav2 lacks the motion model,
 * or if no α's are recommended.
 */
export function formatNav2Yaml({ stats, legCount, model, rule, legLength, logName, warnings }: CalibrationResult, date: string): string {
  const { alphas, intervals, recommended, systematicErrors, diagnostics: { checks } } = stats;
  if (!Object.hasOwn(NAV2_PLUGINS, model) || recommended === null) return '';
  const { inflation } = recommended;
  const { distance, angle, duration } = legLength;
  const failedCheckNames = failedChecksOf(checks).map(({ name }) => name).join(', ');
  const commentTexts = [
    yamlWords.logSource(String(legCount), describeLegLength(legLength), logName, date),
    `Inflation ${inflation.toFixed(2)}. ${recommended.reason}`,
    ...(isNav2Rule(model, rule) ? [] : [yamlWords.otherRuleNote]),
    ...listCorrectedErrors(systematicErrors).map((errorList) => yamlWords.correctedErrorsNote(errorList)),
    ...adviseCorrection(stats, en.nav2),
    ...(failedCheckNames ? [yamlWords.failedChecksNote(failedCheckNames)] : []),
    ...warnings.map((name) => en.nav2[name]),
  ];
  const alphaLines = alphas.map((alpha, i) => {
    const interval = intervals[i];
    if (alpha === null) return `# alpha${i + 1}: ${yamlWords.notIdentifiable}`;
    const [scaledInterval, isBound] = [scaleInterval(interval, inflation), isPrintedAsZero(alpha, interval)];
    const formattedAlpha = isBound ? formatUpperEnd(scaledInterval) : formatEstimate(inflation * alpha, scaledInterval);
    // If an α is not significantly above 0, its upper bound is written. Without this line, Nav2 would use its default, which is far larger.
    if (isBound && (scaledInterval?.[1] ?? Infinity) <= MAX_PLAUSIBLE_ALPHA) return `alpha${i + 1}: ${addDecimalPoint(formattedAlpha)}  # ${yamlWords.notSignificantNote(formatUpperEnd(interval))}`;
    if (isBound || inflation * alpha > MAX_PLAUSIBLE_ALPHA) return `# alpha${i + 1}: ${formattedAlpha}, ${yamlWords.tooLargeNote}`;
    return `alpha${i + 1}: ${addDecimalPoint(formattedAlpha)}  # ${yamlWords.fittedNote(formatEstimate(alpha, interval), formatInterval(interval))}`;
  });
  // Line breaks in the name of a file are replaced by spaces, because they would end the comment in YAML.
  const commentLines = commentTexts.map((commentText) => `# ${commentText.replaceAll(/\s+/g, ' ')}`);
  const fifthAlphaLines = alphas.length < 5 ? [`# ${yamlWords.fifthAlphaNote}`] : [];
  // If the rows of a log are sparse, its legs are longer than requested. AMCL should then update at these longer distances, because the α's hold for them.
  const sparseCheck = failedChecksOf(checks).find(({ name }) => name === 'sampling-dense');
  const legRatio = sparseCheck?.value ?? 1;
  const updateTriggerLines = duration === undefined
    ? [
      ...(sparseCheck ? [`# ${yamlWords.longerLegsNote(formatNumber(legRatio))}`] : []),
      ...Object.entries({ update_min_d: distance, update_min_a: angle }).map(([name, motionThreshold]) => `${name}: ${addDecimalPoint(formatNumber(motionThreshold === undefined ? null : legRatio * motionThreshold))}`),
    ]
    : [];
  const parameterLines = [...commentLines, `robot_model_type: "${NAV2_PLUGINS[model]}"`, ...alphaLines, ...fifthAlphaLines, ...updateTriggerLines];
  return ['amcl:', '  ros__parameters:', ...parameterLines.map((parameterLine) => `    ${parameterLine}`), ''].join('\n');
}

const failedChecksOf = (checks: CalibrationCheck[]) => checks.filter(({ passed }) => !passed);

/**
 * Returns a list with one sentence on how to correct the robot's odometry, which AMCL receives uncorrected. The sentence names each corrected scale whose
 * interval excludes 1. The list is empty if no α's are recommended, or if there is no such scale.
 *
 * @param formatLocally formats numbers
 */
export function adviseCorrection({ recommended, systematicErrors }: CalibrationStats, texts: CalibratorTexts['nav2'], formatLocally = (number: string) => number): string[] {
  if (!recommended) return [];
  const [distanceFactor, turnFactor] = (['distanceScale', 'turnScale'] as const).map((scaleName) => {
    const { value, interval, corrected } = systematicErrors[scaleName];
    return corrected && interval && (interval[0] > 1 || interval[1] < 1) ? formatLocally(formatEstimate(value, interval)) : '';
  });
  return distanceFactor || turnFactor ? [texts.correctionAdvice(distanceFactor, turnFactor)] : [];
}

/** Returns a list with one text that names all corrected systematic errors, or an empty list if no error was corrected. */
function listCorrectedErrors(systematicErrors: CalibrationStats['systematicErrors']): string[] {
  const correctedErrors = Object.entries(systematicErrors).filter(([, systematicError]) => systematicError.corrected);
  const errorTexts = correctedErrors.map(([name, systematicError]) => `${name} ${errorComponentsOf(systematicError).map(({ value, interval }) => formatEstimate(value, interval)).join(', ')}`);
  return errorTexts.length ? [errorTexts.join('; ')] : [];
}

/** Returns the components of a systematic error (two for a lever arm), each with its interval. Value and interval are null if the component is not identifiable. */
export function errorComponentsOf({ value, interval }: CalibrationStats['systematicErrors'][keyof CalibrationStats['systematicErrors']]) {
  const intervals = (Array.isArray(value) ? interval : [interval]) as Interval[];
  return [value].flat().map((component, i) => ({ value: component, interval: intervals[i] }));
}

/** Returns an object as JSON, with typed arrays as plain arrays. */
export const formatJson = (object: object) => JSON.stringify(object, (_, value) => (ArrayBuffer.isView(value) ? [...(value as Float64Array)] : value), 1);

/** Systematic errors that can be corrected before the α's are fitted, in the order of the results. */
export const SYSTEMATIC_ERRORS = ['clockOffset', 'mountYaw', 'leverArm', 'distanceScale', 'turnScale'] as const;

/** Minimum clock offset (s) that the advice mentions. Synchronized clocks differ by less. */
const MIN_MENTIONED_CLOCK_OFFSET = 10;

/**
 * Returns the rating of the α's with its badge, the main finding as a sentence, and advice as sentences. A missing α or a warning, for example that the
 * reference is a localizer, changes the rating "consistent" to "questionable". After a warning, no advice says to use the α's; nor if the robot moves
 * sideways, because the α's are then too small. `correctionPlace` names the place where the user chooses corrections.
 */
export function judgementOf({ stats, legCount, model, corrections, warnings }: CalibrationResult, texts: CalibratorTexts, correctionPlace: string) {
  const { systematicErrors, diagnostics: { verdict, checks } } = stats;
  const failedChecks = failedChecksOf(checks);
  const [failedCheck] = legCount > 0 ? failedChecks : [];
  const failedCheckNames = failedChecks.map(({ name }, i) => (i < MAX_NAMED_CHECKS ? texts.checks.checkNames[name] : '…')).slice(0, MAX_NAMED_CHECKS + 1);
  const uncorrectedErrors = SYSTEMATIC_ERRORS.filter((name) => corrections[name] === false && isSignificant(name, systematicErrors[name]));
  const doubtSentences = [
    ...explainMissingAlphas(stats, model, texts),
    ...(uncorrectedErrors.length ? [texts.systematic.uncorrectedSentence(describeSystematicErrors(uncorrectedErrors, stats, texts), correctionPlace)] : []),
  ];
  const warningTexts = warnings.map((name) => texts.nav2[name]);
  const defectSentences = legCount === 0 ? [texts.tooFewLegsSentence]
    : failedCheck ? [texts.failedChecksSentence(failedCheckNames.join('; '), String(failedChecks.length), String(checks.length))]
      : verdict === 'unusable' ? [texts.noAlphaSentence] : [];
  const findingSentences = verdict === 'unusable' ? [...defectSentences, ...warningTexts] : [...warningTexts, ...defectSentences];
  const [finding = texts.checksPassedSentence(String(checks.length)), ...otherFindings] = [...findingSentences, ...doubtSentences];
  const rating = verdict === 'consistent' && warnings.length + doubtSentences.length > 0 ? 'questionable' : verdict;
  const isUsable = rating !== 'unusable' && warnings.length === 0 && failedChecks.every(({ name }) => name !== 'sideways-rare');
  const usageSentences = !isUsable ? [] : [rating === 'consistent' ? texts.useRecommendedSentence : texts.useAnywaySentence, ...adviseCorrection(stats, texts.nav2, localizeNumber)];
  const clockOffset = systematicErrors.clockOffset.value ?? 0;
  const clockNote = Math.abs(clockOffset) > MIN_MENTIONED_CLOCK_OFFSET ? [texts.clockOffsetNote(formatInteger(Math.round(Math.abs(clockOffset))), clockOffset > 0)] : [];
  const advice = [...otherFindings, ...(failedCheck ? [checkMessageOf(failedCheck, texts)] : []), ...clockNote, ...usageSentences];
  return { rating, badge: texts.ratingBadges[rating], finding, advice };
}

/** Returns a sentence on why these α's are recommended. */
export function explainRecommendation({ recommended, diagnostics: { windows } }: CalibrationStats, texts: CalibratorTexts) {
  if (!recommended) return texts.noRecommendationSentence;
  const [{ count, coverage, nees }] = windows;
  return texts.recommendationReason(formatFixed(recommended.inflation, 2), formatPercent(coverage), formatInteger(count), formatFixed(nees, 2));
}

/** Causes for which legs of a log are not fitted. */
export const LOST_LEG_CAUSES = ['withoutReference', 'acrossBreaks', 'acrossPauses', 'standing'] as const;

/** Returns what a failed check means and what to do. If a check has several possible causes, each cause has its own message. */
export const checkMessageOf = ({ name, cause, passed, message }: CalibrationCheck, { checks }: CalibratorTexts) => (passed ? '' : checks.translateMessage(cause ? `${name}-${cause}` : name, message));

/** Returns a sentence for each reason why α's are not identifiable. The sentence names a drive that would make them identifiable. */
function explainMissingAlphas({ notIdentifiable, diagnostics: { checks } }: CalibrationStats, model: string, { missingAlphasSentence, alphas: { missingMotions } }: CalibratorTexts) {
  // If the reference does not match the odometry, it is from another drive or has other units. Advice on how to drive would not help.
  if (failedChecksOf(checks).some(({ name }) => name === 'reference-matches')) return [];
  const reasons = [...new Set(notIdentifiable)].filter((reason) => reason !== null);
  return reasons.map((reason) => {
    const alphaNames = notIdentifiable.flatMap((reasonOfAlpha, i) => (reasonOfAlpha === reason ? [`α${subscriptOf(i)}`] : []));
    return missingAlphasSentence(alphaNames.join(', '), adviceOf(missingMotions, model, reason).drive);
  });
}

/** Returns two texts about an α that is not identifiable: the motion that the log lacks, and a drive that contains this motion. */
export function adviceOf(missingMotions: CalibratorTexts['alphas']['missingMotions'], model: string, reason: keyof typeof missingMotions) {
  const { lack, drive, byCommands } = missingMotions[reason];
  return { lack, drive: model === 'velocity' ? byCommands : drive };
}

/** Returns true if a systematic error is significant: its interval excludes 0, or for a scale 1. */
function isSignificant(name: string, systematicError: Parameters<typeof errorComponentsOf>[0]) {
  const errorFreeValue = name.endsWith('Scale') ? 1 : 0;
  return errorComponentsOf(systematicError).some(({ interval }) => interval && (interval[0] > errorFreeValue || interval[1] < errorFreeValue));
}

/** Lists systematic errors with their values; empty if none is identifiable. */
function describeSystematicErrors(errorNames: readonly (typeof SYSTEMATIC_ERRORS)[number][], { systematicErrors }: CalibrationStats, { systematic }: CalibratorTexts) {
  return errorNames.flatMap((name) => {
    const texts = errorComponentsOf(systematicErrors[name]).flatMap(({ value, interval }) => (value === null ? [] : [`${localizeNumber(formatEstimate(value, interval))} (${localizeInterval(interval)})`]));
    return texts.length ? [`${systematic.errorNames[name]} ${texts.join(', ')}`] : [];
  }).join('; ');
}

