/** Texts of the Alpha Calibrator in the current language. */

import { addEnglish, words } from '../../messages/registry.ts';
import { integer, fixed, percent, formatPowerOfTen, formatSignificant } from '../../ui/format.ts';
import { en } from './en.ts';
import { subscriptOf } from '../shared/sliders.ts';
import { correctionAdvice, failedChecksOf, missingAlphas } from './lines.ts';
import { uncorrectedText } from './systematic.ts';
import type { CalibrationCheck, LegView } from '../../types.d.ts';
import type { Warning } from '../../logs/log.ts';
import type { ViewModel } from './view-model.ts';

addEnglish({ calibrator: en });

type Figure = Pick<import('./alpha-calibrator.ts').AlphaCalibratorElement, 'viewModel' | 'warnings' | 'logName'>;

/** Pattern of the names of checks whose value is a fraction. */
const FRACTION_CHECKS = /-(lost|few|rare|covered)$/;

/**
 * Returns the rating of the α's, the finding in a sentence, and the advice. A missing α, or a warning such as a localizer as the reference,
 * makes consistent α's questionable.
 */
export function judgementOf(viewModel: ViewModel, logWarnings: Warning[]) {
  const { stats, legs, fitted } = viewModel;
  const { verdict, checks } = stats.diagnostics;
  const texts = words.calibrator;
  const missingAlphaTexts = missingAlphas(texts.alphas.lacking, fitted.model, stats).map(({ indices, drive }) => texts.missing(indices.map((i) => `α${subscriptOf(i)}`).join(', '), drive));
  const warnings = [...missingAlphaTexts, uncorrectedText(viewModel), ...logWarnings.map((name) => texts.nav2[name])].filter(Boolean);
  const rating = verdict === 'consistent' && warnings.length > 0 ? 'questionable' : verdict;
  const useSentences = rating === 'unusable' ? [] : [rating === 'consistent' ? texts.use : texts.useAnyway, ...correctionAdvice(stats, texts.nav2, localized)];
  const judgementWith = (finding: string, ...toDo: string[]) => ({ rating, badge: texts.badges[rating], finding, toDo: [...toDo, ...useSentences].join(' ') });
  if (legs.count === 0) return judgementWith(texts.none, ...warnings);
  const failedChecks = failedChecksOf(checks);
  if (failedChecks.length > 0) return judgementWith(texts.failed(texts.checks.names[failedChecks[0].name], integer(failedChecks.length), integer(checks.length)), ...warnings, checkMessage(failedChecks[0]));
  if (verdict === 'unusable') return judgementWith(texts.noAlpha, ...warnings);
  return warnings.length > 0 ? judgementWith(warnings[0], ...warnings.slice(1)) : judgementWith(texts.passed(integer(checks.length)));
}

/** Returns what a failed check means and what to do. A reference that matches too closely has its own message. */
export const checkMessage = ({ name, value, expected: [low], passed, message }: CalibrationCheck) => (passed ? '' : words.calibrator.checks.message(name === 'reference-matches' && value < low ? 'reference-copied' : name, message));

/** Prints the value of a check, or a limit of it. */
export function checkText(name: CalibrationCheck['name'], value: number) {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? percent(value) : '∞';
  return name === 'enough-legs' ? integer(value) : FRACTION_CHECKS.test(name) ? percent(value) : formatSignificant(value, 3);
}

export const rangeText = (low: string, high: string) => `${low} – ${high}`;

/** Prints the range of values with which a check passes. */
export function expectedRangeText({ name, expected: [low, high] }: CalibrationCheck) {
  if (high === Infinity) return `≥ ${checkText(name, low)}`;
  return low === 0 ? `≤ ${checkText(name, high)}` : rangeText(checkText(name, low), checkText(name, high));
}

/** Returns the reason for the recommended α's. */
export function recommendationReason({ stats: { recommended, diagnostics: { checks, windows } } }: ViewModel) {
  const texts = words.calibrator.recommended;
  if (!recommended) return texts.none;
  const [{ count, coverage, nees }] = windows;
  if (!checks.some(({ name }) => name === 'window-1m-covered')) return texts.few(integer(count));
  const { inflation } = recommended;
  return inflation === 1 ? texts.covered(percent(coverage), integer(count)) : texts.inflated(fixed(inflation, 2), percent(coverage), integer(count), fixed(nees, 2));
}

export const noiseNames = (model: ViewModel['config']['model']) => words.alphas[model === 'velocity' ? 'velocity' : 'odometry'].map(([name]) => name);

/** Converts a number as printed in files (1.5e-7) to the decimal sign of the language and a power of ten. */
export const localized = (number: string) => number.replace('.', fixed(0.5, 1)[1]).replace(/e(-?\d+)$/, (_, exponent) => `·${formatPowerOfTen(Number(exponent))}`);

/** Returns the number of legs and outliers of the named log in a sentence; empty if there are no legs. */
export function legsText({ legs }: ViewModel, log: string) {
  if (legs.count === 0) return '';
  const outlierCount = legs.outliers.reduce((sum, is) => sum + is, 0);
  return words.calibrator.present(log, integer(legs.count), outlierCount > 0 ? integer(outlierCount) : '');
}

export function captionOf({ viewModel, warnings, logName }: Figure) {
  const { badge, finding, toDo } = judgementOf(viewModel, warnings);
  return [`${badge}.`, finding, legsText(viewModel, logName), toDo].filter(Boolean).join(' ');
}

export function pathText({ legs, classes }: ViewModel, chosen: number) {
  if (chosen < 0) return words.calibrator.none;
  const unlikelyCount = classes.reduce((sum, legClass) => sum + Number(legClass > 1), 0);
  return words.calibrator.way(integer(legs.count), integer(unlikelyCount), integer(chosen + 1));
}

export function legText(leg: LegView | null, chosen: number) {
  if (!leg) return words.calibrator.none;
  const [readX, readY, endX, endY] = [leg.read[0], leg.read[1], leg.ended[0], leg.ended[1]];
  return words.calibrator.legText(integer(chosen + 1), fixed(readX, 3), fixed(readY, 3), fixed(endX, 3), fixed(endY, 3));
}
