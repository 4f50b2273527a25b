/** Readouts of the Alpha Calibrator in words and tables: verdict, α's, systematic errors, diagnostics of the fit, and lines for Nav2. */

import { html } from 'lit';
import { copyButtonHtml, downloadFile } from '../../figure/export.ts';
import { addEnglishMessages, words } from '../../messages/registry.ts';
import { buttonHtml, fieldsetHtml, formatMarkup, checkboxHtml } from '../../ui/controls.ts';
import { NO_VALUE, formatInteger, formatFixed, formatPercent, formatPowerOfTen, formatRounded, formatSignificant } from '../../ui/format.ts';
import { plotHtml, type Curve, type PlotOptions } from '../../ui/plot.ts';
import { tableHtml, readoutsHtml } from '../../ui/readouts.ts';
import { subscriptOf } from '../shared/sliders.ts';
import { en } from './en.ts';
import { LOST_LEG_CAUSES, NAV2_RULES, SYSTEMATIC_ERRORS, adviceOf, checkMessage, errorComponentsOf, formatAlphaOrBound, formatEstimate, formatNumber, judgementOf, localizeInterval, localizeNumber, formatNav2Lines, } from './result.ts';
import { NOISE_COMPONENTS, isTruthComparable, modelRuleOf, settingsOfModelRule, type ViewModel } from './settings.ts';
import type { CalibrationCheck, CalibrationPanel, Estimate } from '../../types.d.ts';
import type { Warning } from '../../logs/log.ts';
import type { AlphaCalibratorElement as Figure } from './alpha-calibrator.ts';

addEnglishMessages({ calibrator: en });

/** Pattern of the names of checks whose value is a fraction. */
const FRACTION_CHECKS = /-(lost|few|rare|covered)$/;

export const judgeFit = ({ stats, legs: { count }, fittedConfig }: Pick<ViewModel, 'stats' | 'legs' | 'fittedConfig'>, warnings: Warning[]) =>
  judgementOf({ stats, legCount: count, model: fittedConfig.model, corrections: fittedConfig, warnings }, words.calibrator, words.moreControls);

/** Prints the value of a check, or a limit of it. */
function formatCheckValue(checkName: CalibrationCheck['name'], checkValue: number) {
  if (!Number.isFinite(checkValue)) return Number.isNaN(checkValue) ? formatPercent(checkValue) : '∞';
  return checkName === 'enough-legs' ? formatInteger(checkValue) : FRACTION_CHECKS.test(checkName) ? formatPercent(checkValue) : formatSignificant(checkValue, 3);
}

const formatPassRange = (lowText: string, highText: string) => `${lowText} – ${highText}`;

/** Prints the range of values with which a check passes. */
function formatExpectedRange({ name, expected: [low, high] }: CalibrationCheck) {
  if (high === Infinity) return `≥ ${formatCheckValue(name, low)}`;
  return low === 0 ? `≤ ${formatCheckValue(name, high)}` : formatPassRange(formatCheckValue(name, low), formatCheckValue(name, high));
}

/** Returns the reason for the recommended α's. */
export function explainRecommendation({ stats: { recommended, diagnostics: { checks, windows } } }: ViewModel) {
  const texts = words.calibrator.recommendationReasons;
  if (!recommended) return texts.unusableLog;
  const [{ count, coverage, nees }] = windows;
  if (!checks.some(({ name }) => name === 'window-1m-covered')) return texts.tooFewWindows(formatInteger(count));
  const { inflation } = recommended;
  return inflation === 1 ? texts.goodCoverage(formatPercent(coverage), formatInteger(count)) : texts.inflated(formatFixed(inflation, 2), formatPercent(coverage), formatInteger(count), formatFixed(nees, 2));
}

const noiseNamesOf = (model: ViewModel['config']['model']) => words.alphas[model === 'velocity' ? 'velocity' : 'odometry'].map(([name]) => name);

/** Returns the number of legs and outliers of the named log in a sentence; empty if there are no legs. */
function describeLegs({ legs }: ViewModel, logName: string) {
  if (legs.count === 0) return '';
  const outlierCount = legs.outliers.reduce((sum, outlierFlag) => sum + outlierFlag, 0);
  return words.calibrator.legCountSentence(logName, formatInteger(legs.count), outlierCount > 0 ? formatInteger(outlierCount) : '');
}

export function captionOf({ viewModel, warnings, logName }: Pick<Figure, 'viewModel' | 'warnings' | 'logName'>) {
  const { badge, finding, advice } = judgeFit(viewModel, warnings);
  return [`${badge}.`, finding, describeLegs(viewModel, logName), ...advice].filter(Boolean).join(' ');
}

/** Icons and colours of the ratings. */
const RATING_ICONS = { consistent: ['✓', 'posterior'], questionable: ['!', 'prediction'], unusable: ['✕', 'accent'] };

/** Returns the badge that rates the α's, the finding, and the number of legs. On a wide page it has at most two lines. */
export function verdictHtml({ viewModel, logName, warnings }: Figure) {
  const { rating, badge, finding } = judgeFit(viewModel, warnings);
  const [icon, role] = RATING_ICONS[rating];
  return html`<span class="badge" data-role=${role}><span aria-hidden="true">${icon}</span> ${badge}</span>
    <strong>${finding}</strong> <span class="muted">${describeLegs(viewModel, logName)}</span>`;
}

/** Returns the table of the α's, with the true values where they are comparable. */
export function alphaTableHtml(viewModel: ViewModel) {
  const { stats: { alphas, intervals }, truth, fittedConfig: { model } } = viewModel;
  const texts = words.calibrator.alphas;
  const shownTruth = isTruthComparable(viewModel) ? truth?.alphas : undefined;
  const nameHtml = (name: string, i: number) => html`${formatMarkup(`*α*${subscriptOf(i)}`)} <span class="muted">${name}</span>`;
  return html`<div class="alphas">${tableHtml({
    columnHeadings: [texts.noiseColumn, texts.fittedColumn, texts.recommendedColumn, ...(shownTruth ? [words.calibrator.systematic.simulatedColumn] : [])],
    rows: noiseNamesOf(model).slice(0, alphas.length).map((name, i) => (alphas[i] === null
      ? [nameHtml(name, i), explainMissingAlpha(viewModel, i)]
      : [
        nameHtml(name, i),
        stackedTextsHtml([formatAlpha(viewModel, i), localizeInterval(intervals[i])]),
        html`<strong>${formatRecommendedAlpha(viewModel, i)}</strong>`,
        ...(shownTruth ? [localizeNumber(formatNumber(shownTruth[i]))] : []),
      ])),
  })}</div>`;
}

/** Prints an α, multiplied by the inflation if given. */
const formatAlpha = ({ stats: { alphas, intervals } }: ViewModel, alphaIndex: number, inflation?: number) => localizeNumber(formatAlphaOrBound(alphas[alphaIndex], intervals[alphaIndex], inflation));

const formatRecommendedAlpha = (viewModel: ViewModel, alphaIndex: number) =>
  (viewModel.stats.recommended ? formatAlpha(viewModel, alphaIndex, viewModel.stats.recommended.inflation) : NO_VALUE);

/** Returns the reason why an α is not identifiable, and the drive that would identify it. */
function explainMissingAlpha({ stats: { notIdentifiable }, fittedConfig: { model } }: ViewModel, alphaIndex: number) {
  const texts = words.calibrator.alphas;
  const reason = notIdentifiable[alphaIndex];
  if (!reason) return NO_VALUE;
  const { lack, drive } = adviceOf(texts.missingMotions, model, reason);
  return texts.notDetermined(lack, drive);
}

export function systematicTableHtml(figure: Figure) {
  const { stats: { systematicErrors: errors }, truth } = figure.viewModel;
  const texts = words.calibrator.systematic;
  const { requested } = figure.settings;
  const rows = SYSTEMATIC_ERRORS.map((errorName) => {
    const errorComponents = errorComponentsOf(errors[errorName]);
    const correctCheckbox = checkboxHtml({ label: texts.errorNames[errorName], checked: requested[errorName], onChange: (isChecked) => figure.gesture.requestAndCommit({ [errorName]: isChecked }) });
    if (errorComponents.some(({ value }) => value === null)) return [correctCheckbox, texts.notDetermined];
    return [
      correctCheckbox,
      stackedTextsHtml(errorComponents.map(({ value, interval }) => localizeNumber(formatEstimate(value, interval)))),
      stackedTextsHtml(errorComponents.map(({ interval }) => localizeInterval(interval))),
      errors[errorName].corrected ? texts.correctedLabel : errors[errorName].constant ? texts.notCorrectedLabel : texts.notConstantLabel,
      ...(truth ? [stackedTextsHtml([truth[errorName]].flat().map((trueComponent) => localizeNumber(formatNumber(trueComponent))))] : []),
    ];
  });
  const columns = [texts.errorColumn, texts.valueColumn, words.calibrator.alphas.intervalColumn, texts.treatmentColumn, ...(truth ? [texts.simulatedColumn] : [])];
  return html`<div class="systematic">${tableHtml({ columnHeadings: columns, rows })}</div>`;
}

const stackedTextsHtml = (texts: string[]) => texts.map((stackedText) => html`<div>${stackedText}</div>`);

export function diagnosticsHtml(figure: Figure) {
  const { checks, windowTable, noiseTable, lostLegs } = words.calibrator;
  return html`${fieldsetHtml(checks.title, checksTableHtml(figure))}
    ${fieldsetHtml(windowTable.title, windowsTableHtml(figure))}
    ${fieldsetHtml(noiseTable.title, noiseTableHtml(figure))}
    ${fieldsetHtml(lostLegs.title, lostLegsReadoutsHtml(figure))}`;
}

function checksTableHtml({ viewModel: { stats } }: Figure) {
  const texts = words.calibrator.checks;
  return tableHtml({
    columnHeadings: [texts.checkColumn, texts.observedColumn, texts.expectedColumn, texts.resultColumn],
    rows: stats.diagnostics.checks.map((check) => [
      html`${texts.checkNames[check.name]}<div class="muted">${checkMessage(check, stats, words.calibrator)}</div>`,
      formatCheckValue(check.name, check.value),
      formatExpectedRange(check),
      check.passed ? `✓ ${texts.passedLabel}` : html`<strong>✕ ${texts.failedLabel}</strong>`,
    ]),
  });
}

function windowsTableHtml({ viewModel: { stats: { diagnostics: { windows } } } }: Figure) {
  const texts = words.calibrator.windowTable;
  return tableHtml({
    caption: texts.caption,
    columnHeadings: [texts.length, texts.countColumn, texts.coverageColumn, texts.neesColumn],
    rows: windows.map(({ length, count, coverage, nees }) => [`${formatFixed(length, 1)} m`, formatInteger(count), formatPercent(coverage), formatFixed(nees, 2)]),
  });
}

function noiseTableHtml({ viewModel: { stats: { referenceNoise: { positionStd, yawStd }, persistence: { correlation, length } } } }: Figure) {
  const { noiseTable: texts, systematic, settings, alphas: { intervalColumn } } = words.calibrator;
  const formatNoiseRow = (name: string, { value, interval }: Estimate) => [name, localizeNumber(formatEstimate(value, interval)), localizeInterval(interval)];
  return tableHtml({
    columnHeadings: [texts.quantityColumn, systematic.valueColumn, intervalColumn],
    rows: [
      formatNoiseRow(`${settings.positionStd.name} (m)`, positionStd),
      formatNoiseRow(`${settings.yawStd.name} (rad)`, yawStd),
      formatNoiseRow(texts.correlationName, correlation),
      [texts.length, length > 0 ? `${formatRounded(length, 2)} m` : NO_VALUE, NO_VALUE],
    ],
  });
}

function lostLegsReadoutsHtml({ viewModel: { stats: { lost } } }: Figure) {
  return readoutsHtml(LOST_LEG_CAUSES.map((cause) => [words.calibrator.lostLegs[cause], formatInteger(lost[cause])]));
}

/** Minimum squared distance or rotation at the end of an axis: (1 mm)², or (1 mrad)². */
const MIN_AXIS_END = 1e-6;

/** Returns plots of each noise component: its squared residuals against squared rotation, and against squared translation. */
export function regressionPanelsHtml({ viewModel: { fittedConfig: { model }, legs }, panels }: Figure) {
  const texts = words.calibrator.panels;
  const axisNames = model === 'velocity' ? { turn: texts.turnRateAxisLabel, distance: texts.speedAxisLabel } : { turn: texts.turnAxisLabel, distance: texts.distanceAxisLabel };
  if (legs.count === 0) return html`<p>${words.calibrator.tooFewLegs}</p>`;
  return html`<figure><div class="figures">
      ${panels.flatMap(({ regressor, componentPanels }) => componentPanels.map((panel, i) =>
        html`<figure>${plotHtml(panelPlotHtml(panel, texts.componentNames[NOISE_COMPONENTS[model][i]], axisNames[regressor]))}</figure>`))}
    </div>
    <figcaption>${formatMarkup(texts.caption)}</figcaption></figure>`;
}

/** Returns the plot of a panel. `panelTitle` is the name of its noise component, and `regressorLabel` that of its regressor. */
function panelPlotHtml({ alpha, x, y, error, slope, interval }: CalibrationPanel, panelTitle: string, regressorLabel: string): PlotOptions {
  const texts = words.calibrator.panels;
  const maxRegressor = Math.max(0, ...x);
  // If the log has no rotation or no translation, the axis of that regressor ends at 1.
  const axisEnd = maxRegressor > MIN_AXIS_END ? 1.06 * maxRegressor : 1;
  // The axis has half as much space for error bars as for the bins and the line. A longer bar is cut, so that it does not compress all others.
  const [minSquare, maxSquare] = [Math.min(0, ...y), Math.max(x.length ? 1e-12 : 1, (slope ?? 0) * axisEnd, ...y)];
  const [axisBottom, axisTop] = [1.5 * minSquare, 1.5 * maxSquare];
  // Small numbers are scaled by a power of 1000, so that labels fit next to the axis.
  const exponent = Math.min(0, 3 * Math.floor(Math.log10(Math.max(axisTop, -axisBottom)) / 3));
  const scaleToAxis = (quantity: number) => quantity * 10 ** -exponent;
  const subscript = subscriptOf(alpha);
  const [low, high] = interval ?? [NaN, NaN];
  const slopeMiddle = (low + high) / 2;
  const slopeLines: Curve[] = slope === null ? [] : [
    { name: texts.slopeName(subscript), role: 'prediction', x: [0, axisEnd], y: [0, scaleToAxis(slope * axisEnd)] },
    { name: words.calibrator.alphas.intervalColumn, role: 'cloud', isBandOnly: true, x: [0, axisEnd], y: [0, scaleToAxis(slopeMiddle * axisEnd)], errors: [0, scaleToAxis(((high - low) / 2) * axisEnd)] },
  ];
  return {
    label: `${panelTitle}, α${subscript}: ${slope === null ? NO_VALUE : localizeNumber(formatAlphaOrBound(slope, interval))}`,
    x: { name: regressorLabel, min: 0, max: axisEnd },
    y: { name: `${panelTitle}, ${texts.squaredResidualLabel}${exponent < 0 ? ` (${formatPowerOfTen(exponent)})` : ''}`, min: scaleToAxis(axisBottom), max: scaleToAxis(axisTop) },
    curves: [...slopeLines, { name: texts.binMeansName, role: 'ink', x: [], y: [] }],
    points: x.map((value, i) => ({ role: 'ink' as const, x: value, y: scaleToAxis(y[i]), error: scaleToAxis(error[i]) })),
  };
}

/** Returns the lines for nav2_params.yaml; empty if Nav2 has no such model, or no α's are recommended. */
function yamlOf({ viewModel, logName, warnings }: Figure): string {
  const { fittedConfig, stats, legs: { count } } = viewModel;
  const { model, rule, distance, angle, duration } = fittedConfig;
  const date = new Date().toISOString().slice(0, 10);
  const fittedLog = { calibration: stats, legCount: count, model, rule, legs: duration > 0 ? { duration } : { distance, angle }, logName, warnings, date };
  return formatNav2Lines(fittedLog).map((yamlLine) => `${yamlLine}\n`).join('');
}

/** Returns all results as JSON, with typed arrays as plain arrays. */
function jsonOf({ viewModel: { fittedConfig, stats, legs, truth }, logName }: Figure) {
  const allResults = { log: logName, date: new Date().toISOString(), settings: fittedConfig, ...stats, ...(truth && { truth }), legs };
  return JSON.stringify(allResults, (_, value) => (ArrayBuffer.isView(value) ? [...(value as Float64Array)] : value), 1);
}

/**
 * Returns the button that copies the lines for nav2_params.yaml. For α's of another rule than Nav2's, it is a button that fits Nav2's rule.
 * `disabledReason` is the reason why the button is disabled; empty if it is enabled.
 */
export function nav2ButtonHtml(figure: Figure, disabledReason: string) {
  const texts = words.calibrator.nav2;
  if (!NAV2_RULES.includes(modelRuleOf(figure.viewModel.fittedConfig))) return buttonHtml(texts.fitLabel, () => figure.gesture.requestAndCommit(settingsOfModelRule('nav2')), { disabled: disabledReason !== '', title: disabledReason || texts.fitTooltip });
  const yaml = yamlOf(figure);
  return copyButtonHtml(figure, texts.copyLabel, () => yaml, { disabled: !yaml || disabledReason !== '', title: disabledReason || (yaml ? texts.yamlLabel : texts.noYamlNote) });
}

/** Returns the lines for nav2_params.yaml, and the button that saves all results. `disabledReason` is the reason why the button is disabled; empty if it is enabled. */
export function nav2ExportControlsHtml(figure: Figure, disabledReason: string) {
  const texts = words.calibrator.nav2;
  const yaml = yamlOf(figure);
  const fileName = `${figure.localName}-${figure.viewModel.config.seed}.json`;
  return html`${yaml ? html`<textarea class="yaml" lang="en" readonly rows=${yaml.split('\n').length} aria-label=${texts.yamlLabel} .value=${yaml}></textarea>` : html`<p>${texts.noYamlNote}</p>`}
    <div class="buttons">
      ${buttonHtml(texts.saveJsonLabel, () => downloadFile(fileName, new Blob([jsonOf(figure)], { type: 'application/json' })), { disabled: disabledReason !== '', title: disabledReason || undefined })}
    </div>`;
}
