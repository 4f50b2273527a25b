/** Verdict on fitted α's in words, which the page and the command line share. Its texts are those of en.ts or de.ts. */

import { fixed, integer } from '../../ui/format.ts';
import { subscriptOf } from '../shared/sliders.ts';
import { componentsOf, correctionAdvice, failedChecksOf, localized } from './lines.ts';
import type { CalibrationCheck, CalibrationStats } from '../../types.d.ts';
import type { Warning } from '../../logs/log.ts';

type Texts = typeof import('./en.ts').en;

/** Systematic errors that can be corrected before the α's are fitted, in the order of tables. */
export const SYSTEMATIC_ERRORS = ['clockOffset', 'mountYaw', 'leverArm', 'distanceScale', 'turnScale'] as const;

/** Maximum number of decimals of a systematic error. */
const MAX_DECIMALS = 6;

/** Clock offset (s) that is mentioned. Clocks that are synchronized differ by less. */
const MENTIONED_CLOCK_OFFSET = 10;

/** Fit of α's to a log. */
export interface Fit {
  stats: CalibrationStats;
  /** Number of legs. */
  count: number;
  /** Default: the odometry model. */
  model?: string;
  /** False for each systematic error that is not to be corrected. */
  corrections: { [name in (typeof SYSTEMATIC_ERRORS)[number]]?: boolean };
  /** Notes on the logs that make the α's doubtful. */
  warnings: Warning[];
}

/**
 * Returns the rating of the α's with its badge, the finding in a sentence, and what to do in sentences. A missing α, or a warning such as a
 * localizer as the reference, makes consistent α's questionable. After a warning nothing says to use the α's. `place` is where corrections
 * are chosen.
 */
export function judgementOf({ stats, count, model, corrections, warnings }: Fit, texts: Texts, place: string) {
  const { systematicErrors, diagnostics: { verdict, checks } } = stats;
  const failedChecks = failedChecksOf(checks);
  const [failedCheck] = count > 0 ? failedChecks : [];
  const uncorrectedErrors = SYSTEMATIC_ERRORS.filter((name) => corrections[name] === false && isSignificant(name, systematicErrors[name]));
  const doubts = [
    ...missingAlphaTexts(stats, model, texts),
    ...(uncorrectedErrors.length ? [texts.systematic.matters(systematicText(uncorrectedErrors, stats, texts), place)] : []),
  ];
  const warningTexts = warnings.map((name) => texts.nav2[name]);
  const defects = count === 0 ? [texts.none]
    : failedCheck ? [texts.failed(texts.checks.names[failedCheck.name], String(failedChecks.length), String(checks.length))]
      : verdict === 'unusable' ? [texts.noAlpha] : [];
  const findings = verdict === 'unusable' ? [...defects, ...warningTexts] : [...warningTexts, ...defects];
  const [finding = texts.passed(String(checks.length)), ...otherFindings] = [...findings, ...doubts];
  const rating = verdict === 'consistent' && warnings.length + doubts.length > 0 ? 'questionable' : verdict;
  const usage = rating === 'unusable' || warnings.length > 0 ? [] : [rating === 'consistent' ? texts.use : texts.useAnyway, ...correctionAdvice(stats, texts.nav2, localized)];
  const clockOffset = systematicErrors.clockOffset.value ?? 0;
  const clockNote = Math.abs(clockOffset) > MENTIONED_CLOCK_OFFSET ? [texts.clock(integer(Math.round(Math.abs(clockOffset))), clockOffset > 0)] : [];
  const advice = [...otherFindings, ...(failedCheck ? [checkMessage(failedCheck, texts)] : []), ...clockNote, ...usage];
  return { rating, badge: texts.badges[rating], finding, advice };
}

/** Returns what a failed check means and what to do. A reference that matches too closely has its own message. */
export const checkMessage = ({ name, value, expected: [low], passed, message }: CalibrationCheck, { checks }: Texts) =>
  (passed ? '' : checks.message(name === 'reference-matches' && value < low ? 'reference-copied' : name, message));

/** Returns a sentence for each reason why α's are not identifiable, with the drive that would identify them. */
function missingAlphaTexts({ notIdentifiable, diagnostics: { checks } }: CalibrationStats, model: string | undefined, { missing, alphas: { lacking } }: Texts) {
  // Driving differently does not help if the reference is of another drive, or has other units.
  if (failedChecksOf(checks).some(({ name }) => name === 'reference-matches')) return [];
  const reasons = [...new Set(notIdentifiable)].filter((reason) => reason !== null);
  return reasons.map((reason) => {
    const names = notIdentifiable.flatMap((reasonOfAlpha, i) => (reasonOfAlpha === reason ? [`α${subscriptOf(i)}`] : []));
    return missing(names.join(', '), adviceOf(lacking, model, reason).drive);
  });
}

/** Returns texts for a reason: what the log lacks, and the drive that would identify the α. */
export function adviceOf(lacking: Texts['alphas']['lacking'], model: string | undefined, reason: keyof typeof lacking) {
  const { lack, drive, byCommands } = lacking[reason];
  return { lack, drive: model === 'velocity' ? byCommands : drive };
}

/** Returns true if the interval of an error excludes 0, or that of a scale excludes 1. */
function isSignificant(name: string, error: Parameters<typeof componentsOf>[0]) {
  const neutralValue = name.endsWith('Scale') ? 1 : 0;
  return componentsOf(error).some(({ interval }) => interval && (interval[0] > neutralValue || interval[1] < neutralValue));
}

/** Lists systematic errors with their values; empty if none is identifiable. */
export function systematicText(names: readonly (typeof SYSTEMATIC_ERRORS)[number][], { systematicErrors }: CalibrationStats, { systematic }: Texts) {
  return names.flatMap((name) => {
    const texts = componentTextsOf(systematicErrors[name]).map(({ text, halfText }) => `${text} ${halfText}`);
    return texts.length ? [`${systematic.names[name]} ${texts.join(', ')}`] : [];
  }).join('; ');
}

/**
 * Returns the texts of each identifiable component of a systematic error: its value, and half the width of its interval. Both have three
 * decimals, or more if the interval is narrower than a thousandth.
 */
export function componentTextsOf(error: Parameters<typeof componentsOf>[0]) {
  return componentsOf(error).flatMap(({ value, interval }) => {
    if (value === null) return [];
    const halfWidth = interval && (interval[1] - interval[0]) / 2;
    const decimals = halfWidth ? Math.min(MAX_DECIMALS, Math.max(3, -Math.floor(Math.log10(2 * halfWidth)))) : 3;
    return [{ text: fixed(value, decimals), halfText: halfWidth === null ? '' : `± ${fixed(halfWidth, decimals)}` }];
  });
}
