/** Tables of a result, which the page and the command line share. */

import { NO_VALUE, formatFixed, formatInteger, formatPercent, formatRounded, formatSignificant } from '../../ui/format.ts';
import { subscriptOf } from '../shared/sliders.ts';
import { SYSTEMATIC_ERRORS, adviceOf, errorComponentsOf, formatAlphaOrBound, formatEstimate, formatNumber, localizeInterval, localizeNumber } from './result.ts';
import type { CalibrationCheck, CalibrationStats, CalibrationTruth, Estimate } from '../../types.d.ts';
import type { MessageCatalogue } from '../../messages/registry.ts';

/** Table of texts. If a cell contains several values, each is on its own line. If a row has only one cell after its name, the cell spans all columns. */
export interface ResultTable { columnHeadings: string[]; rows: string[][] }

type TableWords = Pick<MessageCatalogue, 'alphas' | 'calibrator'>;

const formatLocally = ({ value, interval }: { value: number | null; interval: [number, number] | null }) => localizeNumber(formatEstimate(value, interval));

/** Returns the table of the α's, with the true values if there are any. */
export function alphaTableOf({ alphas, intervals, notIdentifiable, recommended }: CalibrationStats, model: string, { alphas: alphaTexts, calibrator }: TableWords, trueAlphas?: number[]): ResultTable {
  const texts = calibrator.alphas;
  const noiseTexts = alphaTexts[model === 'velocity' ? 'velocity' : 'odometry'];
  const rows = alphas.map((alpha, i) => {
    const name = `*α*${subscriptOf(i)} ${noiseTexts[i][0]}`;
    const missingAlphaReason = notIdentifiable[i];
    if (alpha === null) {
      const { lack, drive } = missingAlphaReason ? adviceOf(texts.missingMotions, model, missingAlphaReason) : {};
      return [name, lack && drive ? texts.notDeterminedText(lack, drive) : NO_VALUE];
    }
    return [
      name,
      [localizeNumber(formatAlphaOrBound(alpha, intervals[i])), localizeInterval(intervals[i])].join('\n'),
      recommended ? localizeNumber(formatAlphaOrBound(alpha, intervals[i], recommended.inflation)) : NO_VALUE,
      ...(trueAlphas ? [localizeNumber(formatNumber(trueAlphas[i]))] : []),
    ];
  });
  return { columnHeadings: [texts.noiseColumn, texts.fittedColumn, texts.recommendedColumn, ...(trueAlphas ? [calibrator.systematic.simulatedColumn] : [])], rows };
}

/** Returns the table of the systematic errors, with the true values if there are any. */
export function systematicTableOf({ systematicErrors }: CalibrationStats, { calibrator: { systematic: texts, alphas: { intervalColumn } } }: TableWords, truth?: CalibrationTruth | null): ResultTable {
  const rows = SYSTEMATIC_ERRORS.map((errorName) => {
    const { corrected, constant } = systematicErrors[errorName];
    const components = errorComponentsOf(systematicErrors[errorName]);
    if (components.some(({ value }) => value === null)) return [texts.errorNames[errorName], texts.notDeterminedText];
    return [
      texts.errorNames[errorName],
      components.map(formatLocally).join('\n'),
      components.map(({ interval }) => localizeInterval(interval)).join('\n'),
      corrected ? texts.correctedLabel : constant ? texts.notCorrectedLabel : texts.notConstantLabel,
      ...(truth ? [[truth[errorName]].flat().map((trueComponent) => localizeNumber(formatNumber(trueComponent))).join('\n')] : []),
    ];
  });
  return { columnHeadings: [texts.errorColumn, texts.valueColumn, intervalColumn, texts.treatmentColumn, ...(truth ? [texts.simulatedColumn] : [])], rows };
}

/** Returns the table of the reference's noise, and of the persistence (correlation) of the odometry's errors. */
export function noiseTableOf({ referenceNoise: { positionStd, yawStd }, persistence: { correlation, length } }: CalibrationStats, { calibrator }: TableWords): ResultTable {
  const { noiseTable: texts, systematic, settings, alphas: { intervalColumn } } = calibrator;
  // A standard deviation that the user has entered is not an estimate, and has no interval.
  const formatIntervalOf = ({ interval }: Estimate) => (interval[0] < interval[1] ? localizeInterval(interval) : NO_VALUE);
  const rowOf = (name: string, estimate: Estimate) => [name, formatLocally(estimate), formatIntervalOf(estimate)];
  return {
    columnHeadings: [texts.quantityColumn, systematic.valueColumn, intervalColumn],
    rows: [
      rowOf(`${settings.positionStd.name} (m)`, positionStd),
      rowOf(`${settings.yawStd.name} (rad)`, yawStd),
      rowOf(texts.correlationName, correlation),
      [texts.lengthLabel, length > 0 ? `${formatRounded(length, 2)} m` : NO_VALUE, NO_VALUE],
    ],
  };
}

/** Pattern of the names of checks whose measured value is a fraction. */
const FRACTION_CHECKS = /-(lost|few|rare|covered)$/;

/** Prints the measured value of a check, or a bound of its allowed range. */
function formatCheckValue(checkName: CalibrationCheck['name'], checkValue: number, digits: number) {
  if (!Number.isFinite(checkValue)) return formatFixed(checkValue, 0);
  return checkName === 'enough-legs' ? formatInteger(checkValue) : FRACTION_CHECKS.test(checkName) ? formatPercent(checkValue, digits - 2) : formatSignificant(checkValue, digits);
}

/** Returns the table of the checks, in the order of the fit. */
export function checkTableOf({ diagnostics: { checks } }: CalibrationStats, { calibrator: { checks: texts } }: TableWords): ResultTable {
  const rows = checks.map(({ name, value, expected: [lowLimit, highLimit], passed }) => {
    // More digits are printed if a failed value would otherwise look equal to the bound of the allowed range that it violates.
    const digits = [3, 4, 6].find((digitCount) => passed || [lowLimit, highLimit].every((limit) => formatCheckValue(name, value, digitCount) !== formatCheckValue(name, limit, digitCount))) ?? 9;
    const [lowText, highText] = [lowLimit, highLimit].map((limit) => formatCheckValue(name, limit, digits));
    return [
      texts.checkNames[name],
      formatCheckValue(name, value, digits),
      highLimit === Infinity ? `≥ ${lowText}` : lowLimit === 0 ? `≤ ${highText}` : `${lowText} – ${highText}`,
      passed ? `✓ ${texts.passedLabel}` : `✕ ${texts.failedLabel}`,
    ];
  });
  return { columnHeadings: [texts.checkColumn, texts.observedColumn, texts.expectedColumn, texts.resultColumn], rows };
}

/** Returns the table of prediction errors in held-out windows of the log. */
export function windowTableOf({ diagnostics: { windows } }: CalibrationStats, { calibrator: { windowTable: texts } }: TableWords): ResultTable {
  return {
    columnHeadings: [texts.lengthLabel, texts.countColumn, texts.coverageColumn, texts.neesColumn],
    rows: windows.map(({ length, count, coverage, nees }) => [`${formatFixed(length, 1)} m`, formatInteger(count), formatPercent(coverage), formatFixed(nees, 2)]),
  };
}
