/** Texts of the Alpha Calibrator in the current language. */

import { addEnglish, words } from '../../messages/registry.ts';
import { integer, fixed, percent, formatSignificant } from '../../ui/format.ts';
import { en } from './en.ts';
import { SYSTEMATIC_ERRORS, judgementOf, systematicText } from './verdict.ts';
import type { CalibrationCheck, LegView } from '../../types.d.ts';
import type { Warning } from '../../logs/log.ts';
import type { ViewModel } from './view-model.ts';

addEnglish({ calibrator: en });

type Figure = Pick<import('./alpha-calibrator.ts').AlphaCalibratorElement, 'viewModel' | 'warnings' | 'logName'>;

/** Pattern of the names of checks whose value is a fraction. */
const FRACTION_CHECKS = /-(lost|few|rare|covered)$/;

export const judge = ({ stats, legs: { count }, fitted }: Pick<ViewModel, 'stats' | 'legs' | 'fitted'>, warnings: Warning[]) =>
  judgementOf({ stats, count, model: fitted.model, corrections: fitted, warnings }, words.calibrator, words.moreControls);

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

/** Returns two sentences: one on the systematic errors that were corrected, and one on those that the α's include as noise. */
function systematicTexts({ stats }: ViewModel) {
  const { removed, left } = words.calibrator.systematic;
  return ([[true, removed], [false, left]] as const).flatMap(([corrected, sentenceOf]) => {
    const errorsText = systematicText(SYSTEMATIC_ERRORS.filter((name) => stats.systematicErrors[name].corrected === corrected), stats, words.calibrator);
    return errorsText ? [sentenceOf(errorsText)] : [];
  });
}

export const noiseNames = (model: ViewModel['config']['model']) => words.alphas[model === 'velocity' ? 'velocity' : 'odometry'].map(([name]) => name);

/** Returns the number of legs and outliers of the named log in a sentence; empty if there are no legs. */
export function legsText({ legs }: ViewModel, log: string) {
  if (legs.count === 0) return '';
  const outlierCount = legs.outliers.reduce((sum, is) => sum + is, 0);
  return words.calibrator.present(log, integer(legs.count), outlierCount > 0 ? integer(outlierCount) : '');
}

export function captionOf({ viewModel, warnings, logName }: Figure) {
  const { badge, finding, advice } = judge(viewModel, warnings);
  return [`${badge}.`, finding, legsText(viewModel, logName), ...advice].filter(Boolean).join(' ');
}

/** Returns the caption, the reason for the recommended α's, and the systematic errors, for exports. */
export const summaryTexts = (figure: Figure) => [captionOf(figure), recommendationReason(figure.viewModel), ...systematicTexts(figure.viewModel)];

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
