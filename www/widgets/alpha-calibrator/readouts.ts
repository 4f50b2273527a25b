/** Results of the Alpha Calibrator as words and tables: verdict, α's, systematic errors, checks of the fit, and lines for nav2_params.yaml. */

import { html } from 'lit';
import { copyButtonHtml, downloadFile } from '../../figure/export.ts';
import { addEnglishMessages, words } from '../../messages/registry.ts';
import { buttonHtml, fieldsetHtml, formatMarkup, checkboxHtml } from '../../ui/controls.ts';
import { NO_VALUE, formatInteger } from '../../ui/format.ts';
import { plotHtml, type PlotCurve, type PlotOptions } from '../../ui/plot.ts';
import { tableHtml, readoutsHtml } from '../../ui/readouts.ts';
import { subscriptOf } from '../shared/sliders.ts';
import { en } from './en.ts';
import { LOST_LEG_CAUSES, NAV2_RULES, SYSTEMATIC_ERRORS, checkMessageOf, formatAlphaOrBound, formatJson, judgementOf, localizeNumber, formatNav2Yaml, type CalibrationResult } from './result.ts';
import { alphaTableOf, checkTableOf, noiseTableOf, systematicTableOf, windowTableOf } from './tables.ts';
import { NOISE_COMPONENTS, isTruthComparable, modelRuleOf, settingsOfModelRule, type ViewModel } from './settings.ts';
import type { CalibrationPanel } from '../../types.d.ts';
import type { AlphaCalibratorElement as Figure } from './alpha-calibrator.ts';

addEnglishMessages({ calibrator: en });

/** Properties of the figure that are needed to describe its results in words. */
type FittedFigure = Pick<Figure, 'viewModel' | 'warnings' | 'logName'>;

function resultOf({ viewModel: { stats, legs, fittedConfig }, warnings, logName }: FittedFigure): CalibrationResult {
  const { model, rule, distance, angle, duration } = fittedConfig;
  return { stats, legCount: legs.count, model, rule, legLength: duration > 0 ? { duration } : { distance, angle }, corrections: fittedConfig, logName, warnings };
}

export const judgeFit = (figure: FittedFigure) => judgementOf(resultOf(figure), words.calibrator, words.moreControls);

/** Returns a sentence with the name of the log, and its numbers of legs and outliers; empty if there are no legs. */
function describeLegs({ viewModel: { legs }, logName }: FittedFigure) {
  if (legs.count === 0) return '';
  const outlierCount = legs.outliers.reduce((sum, outlierFlag) => sum + outlierFlag, 0);
  return words.calibrator.legCountSentence(logName, formatInteger(legs.count), outlierCount > 0 ? formatInteger(outlierCount) : '');
}

export function captionOf(figure: FittedFigure) {
  const { badge, finding, advice } = judgeFit(figure);
  return [`${badge}.`, finding, describeLegs(figure), ...advice].filter(Boolean).join(' ');
}

/** Icons and colours of the ratings. */
const RATING_ICONS = { consistent: ['✓', 'posterior'], questionable: ['!', 'prediction'], unusable: ['✕', 'accent'] };

/** Returns the verdict: a badge with the rating of the α's, the main finding, and the number of legs. */
export function verdictHtml(figure: FittedFigure) {
  const { rating, badge, finding } = judgeFit(figure);
  const [icon, colourRole] = RATING_ICONS[rating];
  return html`<span class="badge" data-role=${colourRole}><span aria-hidden="true">${icon}</span> ${badge}</span>
    <strong>${finding}</strong> <span class="muted">${describeLegs(figure)}</span>`;
}

/** Returns the table of the α's. It includes the true values of the simulated log if the fit has the same rule and leg length. */
export function alphaTableHtml(viewModel: ViewModel) {
  const { stats, truth, fittedConfig: { model } } = viewModel;
  const { columnHeadings, rows } = alphaTableOf(stats, model, words, isTruthComparable(viewModel) ? truth?.alphas : undefined);
  const rowHtml = ([nameText, fittedText, recommendedText, ...otherCells]: string[]) => [
    formatMarkup(nameText), stackedTextsHtml(fittedText), ...(recommendedText === undefined ? [] : [html`<strong>${recommendedText}</strong>`]), ...otherCells,
  ];
  return html`<div class="alphas">${tableHtml({ columnHeadings, rows: rows.map(rowHtml) })}</div>`;
}

/** Returns the table of the systematic errors. Each row has a checkbox by which the user corrects the error. */
export function systematicTableHtml(figure: Figure) {
  const { viewModel: { stats, truth }, settings: { requestedValues } } = figure;
  const { columnHeadings, rows } = systematicTableOf(stats, words, truth);
  const checkboxOf = (labelContent: string, errorName: string) => checkboxHtml({ labelContent, isChecked: requestedValues[errorName], onChange: (isChecked) => figure.gesture.requestAndCommit({ [errorName]: isChecked }) });
  return html`<div class="systematic">
    ${tableHtml({ columnHeadings, rows: rows.map(([name, ...cells], i) => [checkboxOf(name, SYSTEMATIC_ERRORS[i]), ...cells.map(stackedTextsHtml)]) })}
  </div>`;
}

const stackedTextsHtml = (cellText: string) => cellText.split('\n').map((line) => html`<div>${line}</div>`);

export function diagnosticsHtml({ viewModel: { stats } }: Figure) {
  const { checks: checkTexts, windowTable, noiseTable, lostLegs } = words.calibrator;
  const checkTable = checkTableOf(stats, words);
  const checkRows = checkTable.rows.map(([name, ...cells], i) => [html`${name}<div class="muted">${checkMessageOf(stats.diagnostics.checks[i], words.calibrator)}</div>`, ...cells]);
  return html`${fieldsetHtml(checkTexts.title, tableHtml({ ...checkTable, rows: checkRows }))}
    ${fieldsetHtml(windowTable.title, tableHtml({ caption: windowTable.caption, ...windowTableOf(stats, words) }))}
    ${fieldsetHtml(noiseTable.title, tableHtml(noiseTableOf(stats, words)))}
    ${fieldsetHtml(lostLegs.title, readoutsHtml(LOST_LEG_CAUSES.map((cause) => [lostLegs[cause], formatInteger(stats.lost[cause])])))}`;
}

/** Minimum range of a plot's horizontal axis, which shows squared distances (m²) or squared rotations (rad²): (1 mm)² or (1 mrad)². */
const MIN_AXIS_END = 1e-6;

/** Returns two plots for each noise component: its squared residuals against squared rotation, and against squared translation. */
export function regressionPanelsHtml({ viewModel: { fittedConfig: { model }, legs }, regressionPanels }: Figure) {
  const texts = words.calibrator.panels;
  const axisLabels = model === 'velocity' ? { turn: texts.turnRateAxisLabel, distance: texts.speedAxisLabel } : { turn: texts.turnAxisLabel, distance: texts.distanceAxisLabel };
  if (legs.count === 0) return html`<p>${words.calibrator.tooFewLegsSentence}</p>`;
  return html`<figure><div class="figures">
      ${regressionPanels.flatMap(({ regressor, componentPanels }) => componentPanels.map((panel, i) =>
        html`<figure>${plotHtml(panelPlotHtml(panel, texts.componentNames[NOISE_COMPONENTS[model][i]], axisLabels[regressor]))}</figure>`))}
    </div>
    <figcaption>${formatMarkup(texts.caption)}</figcaption></figure>`;
}

/** Returns the plot of squared residuals against a regressor. `panelTitle` names the noise component, and `regressorLabel` the regressor. */
function panelPlotHtml({ alpha, x, y, error, slope, interval }: CalibrationPanel, panelTitle: string, regressorLabel: string): PlotOptions {
  const texts = words.calibrator.panels;
  const maxRegressor = Math.max(0, ...x);
  // If the log lacks the motion (rotation or translation) of a plot's horizontal axis, this axis ends at 1.
  const axisEnd = maxRegressor > MIN_AXIS_END ? 1.06 * maxRegressor : 1;
  // The vertical axis leaves half as much space for error bars as for bins and line. Longer error bars are cut, so that they do not compress everything else.
  const [minSquaredResidual, maxSquaredResidual] = [Math.min(0, ...y), Math.max(x.length ? 1e-12 : 1, (slope ?? 0) * axisEnd, ...y)];
  const [axisBottom, axisTop] = [1.5 * minSquaredResidual, 1.5 * maxSquaredResidual];
  const subscript = subscriptOf(alpha);
  const [lowSlope, highSlope] = interval ?? [NaN, NaN];
  const middleSlope = (lowSlope + highSlope) / 2;
  const slopeLines: PlotCurve[] = slope === null ? [] : [
    { name: texts.slopeName(subscript), colourRole: 'prediction', x: [0, axisEnd], y: [0, slope * axisEnd] },
    { name: words.calibrator.alphas.intervalColumn, colourRole: 'cloud', isBandOnly: true, x: [0, axisEnd], y: [0, middleSlope * axisEnd], errors: [0, ((highSlope - lowSlope) / 2) * axisEnd] },
  ];
  return {
    plotLabel: `${panelTitle}, α${subscript}: ${slope === null ? NO_VALUE : localizeNumber(formatAlphaOrBound(slope, interval))}`,
    x: { axisLabel: regressorLabel, min: 0, max: axisEnd },
    y: { axisLabel: `${panelTitle}, ${texts.squaredResidualLabel}`, min: axisBottom, max: axisTop },
    plotCurves: [...slopeLines, { name: texts.binMeansName, colourRole: 'ink', x: [], y: [] }],
    dataPoints: x.map((regressorValue, i) => ({ colourRole: 'ink' as const, x: regressorValue, y: y[i], error: error[i] })),
  };
}

const yamlOf = (figure: Figure) => formatNav2Yaml(resultOf(figure), new Date().toISOString().slice(0, 10));

/** Returns all results as JSON. */
const jsonOf = ({ viewModel: { fittedConfig, stats, legs, truth }, logName }: Figure) =>
  formatJson({ log: logName, date: new Date().toISOString(), settings: fittedConfig, ...stats, ...(truth && { truth }), legs });

/**
 * Returns the button that copies the lines for nav2_params.yaml. If the α's were not fitted with a noise rule of Nav2, the button fits with Nav2's rule
 * instead. `disabledReason` says why the button is disabled; empty if it is enabled.
 */
export function nav2ButtonHtml(figure: Figure, disabledReason: string) {
  const texts = words.calibrator.nav2;
  if (!NAV2_RULES.includes(modelRuleOf(figure.viewModel.fittedConfig))) return buttonHtml(texts.fitLabel, () => figure.gesture.requestAndCommit(settingsOfModelRule('nav2')), { disabled: disabledReason !== '', title: disabledReason || texts.fitTooltip });
  const yaml = yamlOf(figure);
  return copyButtonHtml(figure, texts.copyLabel, () => yaml, { disabled: !yaml || disabledReason !== '', title: disabledReason || (yaml ? texts.yamlLabel : texts.noYamlNote) });
}

/** Returns the lines for nav2_params.yaml, and the button that saves all results. `disabledReason` says why the button is disabled; empty if it is enabled. */
export function nav2ExportControlsHtml(figure: Figure, disabledReason: string) {
  const texts = words.calibrator.nav2;
  const yaml = yamlOf(figure);
  const fileName = `${figure.localName}-${figure.viewModel.config.seed}.json`;
  return html`${yaml ? html`<textarea class="yaml" lang="en" readonly rows=${yaml.split('\n').length} aria-label=${texts.yamlLabel} .value=${yaml}></textarea>` : html`<p>${texts.noYamlNote}</p>`}
    <div class="buttons">
      ${buttonHtml(texts.saveJsonLabel, () => downloadFile(fileName, new Blob([jsonOf(figure)], { type: 'application/json' })), { disabled: disabledReason !== '', title: disabledReason || undefined })}
    </div>`;
}
