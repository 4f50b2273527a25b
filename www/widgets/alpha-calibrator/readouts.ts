/** Readouts of the Alpha Calibrator: verdict, table of the α's, systematic errors, diagnostics of the fit, and lines for Nav2. */

import { extent, range } from 'd3-array';
import { html, nothing, svg } from 'lit';
import { downloadFile } from '../../figure/export.ts';
import { words } from '../../messages/registry.ts';
import { button, group, radioGroup, formatMarkup, toggle } from '../../ui/controls.ts';
import { NO_VALUE, integer, fixed, percent, formatPowerOfTen, formatRounded, tick } from '../../ui/format.ts';
import { plot, type Curve, type Plot } from '../../ui/plot.ts';
import { figureTable, readoutList } from '../../ui/readouts.ts';
import { subscriptOf } from '../shared/sliders.ts';
import { NAV2_RULES, formatAlphaOrBound, formatEstimate, isZero, localized, nav2Lines } from './lines.ts';
import { NOISE_COMPONENTS, modelRuleOf, settingsFor, type Regressor } from './settings.ts';
import { SYSTEMATIC_ERRORS, adviceOf, checkMessage, componentTextsOf } from './verdict.ts';
import { isTruthComparable, type ViewModel } from './view-model.ts';
import { checkText, expectedRangeText, judge, legsText, noiseNames, rangeText } from './words.ts';
import type { CalibrationPanel, Estimate } from '../../types.d.ts';
import type { AlphaCalibratorElement as Figure } from './alpha-calibrator.ts';

/** Size of the plot of one α's interval (a whisker) in the table. */
const WHISKER_ROW = { width: 200, height: 24, middle: 12, inset: 12 };

/** Maximum number of intervals between labels of the axis. */
const MAX_AXIS_INTERVALS = 4;

/** Icons and colours of the ratings. */
const RATING_LOOKS = { consistent: ['✓', 'posterior'], questionable: ['!', 'prediction'], unusable: ['✕', 'accent'] };

/** Returns the badge that rates the α's, the finding, and the number of legs. On a wide page it has at most two lines. */
export function verdictHtml({ viewModel, logName, warnings }: Figure) {
  const { rating, badge, finding } = judge(viewModel, warnings);
  const [icon, role] = RATING_LOOKS[rating];
  return html`<span class="badge" data-role=${role}><span aria-hidden="true">${icon}</span> ${badge}</span>
    <strong>${finding}</strong> <span class="muted">${legsText(viewModel, logName)}</span>`;
}

export function alphaTable(viewModel: ViewModel) {
  const { alphas, intervals } = viewModel.stats;
  const texts = words.calibrator.alphas;
  const noiseLabels = noiseNames(viewModel.fitted.model);
  const truth = isTruthComparable(viewModel) ? viewModel.truth?.alphas : undefined;
  const axis = logarithmicAxis([...alphas, ...intervals.flatMap((interval) => interval ?? []), ...(truth ?? [])]);
  return html`<table class="alphas" part="table">
    <thead>
      <tr><th scope="col">${formatMarkup('*α*')}</th><th scope="col">${truth ? texts.noiseTrue : texts.noise}</th><th scope="col">${texts.value}</th><th scope="col">${texts.recommended}</th></tr>
    </thead>
    <tbody>
      ${alphas.map((alpha, i) => html`<tr>
        <th scope="row">${formatMarkup(`*α*${subscriptOf(i)}`)}</th>
        ${alpha === null
          ? html`<td colspan="3"><div class="of muted">${noiseLabels[i]}</div><i>${missingAlphaText(viewModel, i)}</i></td>`
          : html`<td class="chart"><div class="line"><div class="of muted">${noiseLabels[i]}</div>${whiskerSvg(axis, alpha, intervals[i], truth?.[i])}</div></td>
            <td><div class="line"><div class="fitted-value" data-longest="0.00000">${alphaText(viewModel, i)}</div><div class="between muted" data-longest=${rangeText('0.00000', '0.00000')}>${intervalText(viewModel, i)}</div></div></td>
            <td class="recommended" data-longest="0.00000">${recommendedAlphaText(viewModel, i)}</td>`}
      </tr>`)}
      <tr class="axis" aria-hidden="true">
        <td></td>
        <td class="chart">
          <div class="line"><div class="of muted"></div><div class="scale muted small">${axis.decades.map((decade) => html`<span .style=${`left: ${(100 * axis.at(decade)) / WHISKER_ROW.width}%`}>${decade < 5e-4 ? formatPowerOfTen(Math.round(Math.log10(decade))) : tick(decade, decade)}</span>`)}</div></div>
        </td>
        <td colspan="2"></td>
      </tr>
    </tbody>
  </table>`;
}

/** Prints an α times a factor. */
const alphaText = ({ stats: { alphas, intervals } }: ViewModel, index: number, factor?: number) => localized(formatAlphaOrBound(alphas[index], intervals[index], factor));

const recommendedAlphaText = (viewModel: ViewModel, index: number) =>
  (viewModel.stats.recommended ? alphaText(viewModel, index, viewModel.stats.recommended.inflation) : NO_VALUE);

/** Returns the reason why an α is not identifiable, and the drive that would identify it. */
function missingAlphaText({ stats: { notIdentifiable }, fitted: { model } }: ViewModel, index: number) {
  const texts = words.calibrator.alphas;
  const reason = notIdentifiable[index];
  if (!reason) return NO_VALUE;
  const { lack, drive } = adviceOf(texts.lacking, model, reason);
  return texts.unknown(lack, drive);
}

/** Returns all α's as texts, each with its interval. */
export function alphaTexts(viewModel: ViewModel) {
  const { stats: { alphas }, fitted } = viewModel;
  const recommendedName = words.calibrator.alphas.recommended.replace('\u00AD', '');
  return alphas.map((alpha, i) => {
    const alphaParts = alpha === null ? [missingAlphaText(viewModel, i)] : [alphaText(viewModel, i), intervalText(viewModel, i), `${recommendedName} ${recommendedAlphaText(viewModel, i)}`];
    return `α${subscriptOf(i)} ${noiseNames(fitted.model)[i]}: ${alphaParts.join(', ')}`;
  });
}

function intervalText({ stats: { intervals } }: ViewModel, index: number) {
  const interval = intervals[index];
  return interval ? rangeText(localized(formatEstimate(interval[0], interval)), localized(formatEstimate(interval[1], interval))) : NO_VALUE;
}

/** Returns a logarithmic axis over whole decades that contain the values. */
function logarithmicAxis(values: (number | null)[]) {
  const [lowest = -3, highest = 0] = extent(values.filter((value) => value && value < Infinity), (value) => Math.log10(value ?? 0));
  const minExponent = Math.floor(Math.min(0, Math.max(lowest, highest - 4)));
  const maxExponent = Math.max(minExponent + 1, Math.ceil(highest));
  const { width, inset } = WHISKER_ROW;
  const at = (value: number) => {
    const axisFraction = (Math.log10(Math.max(value, 0)) - minExponent) / (maxExponent - minExponent);
    // A mark outside the axis is drawn at its edge.
    return Math.max(inset / 3, Math.min(width - inset / 3, inset + axisFraction * (width - 2 * inset)));
  };
  // At most MAX_AXIS_INTERVALS + 1 labels fit without touching.
  const decadesPerLabel = Math.ceil((maxExponent - minExponent) / MAX_AXIS_INTERVALS);
  return { at, decades: range(minExponent, maxExponent + 1, decadesPerLabel).map((exponent) => 10 ** exponent) };
}

function whiskerSvg({ at }: ReturnType<typeof logarithmicAxis>, value: number, interval: [number, number] | null, truth: number | undefined) {
  const { width, height, middle } = WHISKER_ROW;
  const [low, high] = (interval ?? [value, value]).map(at);
  return html`<svg viewBox="0 0 ${width} ${height}" preserveAspectRatio="none" aria-hidden="true">
    ${truth === undefined ? nothing : svg`<path vector-effect="non-scaling-stroke" stroke="var(--truth)" stroke-width="3" d="M${at(truth)} 2V${height - 2}" />`}
    <path vector-effect="non-scaling-stroke" fill="none" stroke="var(--prediction)" stroke-width="1.9" d="M${low} ${middle}H${high}M${low} ${middle - 4}v8M${high} ${middle - 4}v8" />
    <path vector-effect="non-scaling-stroke" stroke="var(--prediction)" stroke-width="5" stroke-linecap="round" d="M${at(value)} ${middle}h0" />
  </svg>`;
}

export function systematicTable(figure: Figure) {
  const { stats: { systematicErrors: errors }, truth } = figure.viewModel;
  const texts = words.calibrator.systematic;
  const { requested } = figure.settings;
  const rows = SYSTEMATIC_ERRORS.map((key) => {
    const components = componentTextsOf(errors[key]);
    const correctCheckbox = toggle({ label: texts.names[key], checked: requested[key], change: (on) => figure.gesture.decide({ [key]: on }) });
    if (components.length === 0) return [correctCheckbox, texts.unknown];
    return [
      correctCheckbox,
      stackTexts(components.map(({ text }) => text)),
      html`<div class="muted">${stackTexts(components.map(({ halfText }) => halfText))}</div>`,
      errors[key].corrected ? texts.corrected : errors[key].constant ? texts.notCorrected : texts.notConstant,
      ...(truth ? [html`<div class="muted">${stackTexts([truth[key]].flat().map((component) => fixed(component, 3)))}</div>`] : []),
    ];
  });
  const columns = [texts.what, texts.value, words.calibrator.alphas.interval, texts.treatment, ...(truth ? [texts.truth] : [])];
  return html`<div class="systematic">${figureTable({ columns, rows })}</div>`;
}

const stackTexts = (texts: string[]) => texts.map((text) => html`<div>${text}</div>`);

export function diagnosticsHtml(figure: Figure) {
  const { checks, windows, noise, lost } = words.calibrator;
  return html`${group(checks.title, checksTable(figure))}
    ${group(windows.title, windowsTable(figure))}
    ${group(noise.title, noiseTable(figure))}
    ${group(lost.title, lostLegsReadouts(figure))}`;
}

function checksTable({ viewModel: { stats: { diagnostics: { checks } } } }: Figure) {
  const texts = words.calibrator.checks;
  return figureTable({
    columns: [texts.check, texts.value, texts.expected, texts.result],
    rows: checks.map((check) => [
      html`${texts.names[check.name]}<div class="muted">${checkMessage(check, words.calibrator)}</div>`,
      checkText(check.name, check.value),
      expectedRangeText(check),
      check.passed ? `✓ ${texts.passed}` : html`<strong>✕ ${texts.failed}</strong>`,
    ]),
  });
}

function windowsTable({ viewModel: { stats: { diagnostics: { windows } } } }: Figure) {
  const texts = words.calibrator.windows;
  return figureTable({
    caption: texts.caption,
    columns: [texts.length, texts.count, texts.coverage, texts.nees],
    rows: windows.map(({ length, count, coverage, nees }) => [`${fixed(length, 1)} m`, integer(count), percent(coverage), fixed(nees, 2)]),
  });
}

function noiseTable({ viewModel: { stats: { referenceNoise: { positionStd, yawStd }, persistence: { correlation, length } } } }: Figure) {
  const { noise: texts, systematic, settings, alphas: { interval: intervalName } } = words.calibrator;
  const formatStd = (value: number) => (value === 0 ? '0' : Number.isFinite(value) ? formatRounded(value, 2) : '∞');
  const noiseRow = (name: string, { value, interval: [low, high] }: Estimate) => [name, formatStd(value), rangeText(formatStd(low), formatStd(high))];
  return figureTable({
    columns: [texts.what, systematic.value, intervalName],
    rows: [
      noiseRow(`${settings.positionStd.name} (m)`, positionStd),
      noiseRow(`${settings.yawStd.name} (rad)`, yawStd),
      noiseRow(texts.correlation, correlation),
      [texts.length, length > 0 ? `${formatRounded(length, 2)} m` : NO_VALUE, NO_VALUE],
    ],
  });
}

function lostLegsReadouts({ viewModel: { stats: { lost } } }: Figure) {
  const causes = ['withoutReference', 'acrossBreaks', 'acrossPauses', 'standing'] as const;
  return readoutList(causes.map((cause) => [words.calibrator.lost[cause], integer(lost[cause])]));
}

/** Minimum squared distance or rotation at the end of an axis: (1 mm)², or (1 mrad)². */
const MIN_REGRESSOR = 1e-6;

/** Returns a plot for each noise component: its squared residuals against the regressor. */
export function regressionPanels(figure: Figure) {
  const { viewModel, viewModel: { fitted: { model } }, state: { elementState: { regressor } }, gesture } = figure;
  const texts = words.calibrator.panels;
  const axisNames = model === 'velocity' ? { turn: texts.turnRate, distance: texts.speed } : { turn: texts.turn, distance: texts.distance };
  if (viewModel.legs.count === 0) return html`<p>${words.calibrator.none}</p>`;
  const chooseRegressor = (name: Regressor) => gesture.choose('regressor', name);
  return html`${radioGroup(texts.against, 'regressor', texts.regressors, regressor, chooseRegressor)}
    <figure><div class="panels">
      ${figure.panels.map((panel, i) => html`<figure>
        ${plot(panelPlot(panel, texts.kinds[NOISE_COMPONENTS[model][i]], axisNames[regressor as Regressor]))}
        ${identifiabilityNote(panel, viewModel)}
      </figure>`)}
    </div>
    <figcaption>${formatMarkup(texts.caption)}</figcaption></figure>`;
}

/** Returns the plot of a panel. `kind` is the name of its noise component, and `axis` that of its regressor. */
function panelPlot({ alpha, x, y, error, slope, interval }: CalibrationPanel, kind: string, axis: string): Plot {
  const texts = words.calibrator.panels;
  const maxRegressor = Math.max(0, ...x);
  // A log without rotation or without translation has an empty axis.
  const axisEnd = maxRegressor > MIN_REGRESSOR ? 1.06 * maxRegressor : 1;
  // The axis has half as much space for error bars as for the bins and the line. A longer bar is cut, so that it does not compress all others.
  const [minSquare, maxSquare] = [Math.min(0, ...y), Math.max(x.length ? 1e-12 : 1, (slope ?? 0) * axisEnd, ...y)];
  const [axisBottom, axisTop] = [1.5 * minSquare, 1.5 * maxSquare];
  // Small numbers are scaled by a power of 1000, so that labels fit next to the axis.
  const exponent = Math.min(0, 3 * Math.floor(Math.log10(Math.max(axisTop, -axisBottom)) / 3));
  const scale = (value: number) => value * 10 ** -exponent;
  const subscript = subscriptOf(alpha);
  const [low, high] = interval ?? [NaN, NaN];
  const slopeMiddle = (low + high) / 2;
  const slopeLines: Curve[] = slope === null ? [] : [
    { name: texts.slope(subscript), role: 'prediction', x: [0, axisEnd], y: [0, scale(slope * axisEnd)] },
    { name: words.calibrator.alphas.interval, role: 'cloud', area: true, x: [0, axisEnd], y: [0, scale(slopeMiddle * axisEnd)], error: [0, scale(((high - low) / 2) * axisEnd)] },
  ];
  return {
    label: texts.label(kind, String(alpha + 1), slope === null ? NO_VALUE : localized(formatAlphaOrBound(slope, interval))),
    x: { name: axis, from: 0, to: axisEnd },
    y: { name: `${kind}, ${texts.axis}${exponent < 0 ? ` (${formatPowerOfTen(exponent)})` : ''}`, from: scale(axisBottom), to: scale(axisTop) },
    curves: [...slopeLines, { name: texts.bins, role: 'ink', x: [], y: [] }],
    points: x.map((value, i) => ({ role: 'ink' as const, x: value, y: scale(y[i]), error: scale(error[i]) })),
  };
}

/** Returns the kind of motion that identifies an α (index from 0), as the reason for an α that is not identifiable. */
function missingMotion(model: string, index: number): 'insufficient-rotation' | 'insufficient-translation' {
  const needsRotation = model === 'velocity' ? index % 2 === 1 : index === 0 || index === 3;
  return needsRotation ? 'insufficient-rotation' : 'insufficient-translation';
}

/** Returns a note on an α that is not distinguishable from 0, with the drive that would identify it. */
function identifiabilityNote({ alpha, slope, interval }: CalibrationPanel, { fitted: { model } }: ViewModel) {
  const { panels: texts, alphas: { lacking } } = words.calibrator;
  if (!isZero(slope, interval)) return '';
  return html`<p class="note">${formatMarkup(texts.zero(subscriptOf(alpha), adviceOf(lacking, model, missingMotion(model, alpha)).drive))}</p>`;
}

/** Returns the lines for nav2_params.yaml; empty if Nav2 has no such model, or no α's are recommended. */
function yamlOf({ viewModel, logName, warnings }: Figure): string {
  const { fitted: config, stats, legs: { count } } = viewModel;
  const { model, rule, distance, angle, duration } = config;
  const date = new Date().toISOString().slice(0, 10);
  const fittedLog = { calibration: stats, count, model, rule, legs: duration > 0 ? { duration } : { distance, angle }, log: logName, warnings, date };
  return nav2Lines(fittedLog, words.calibrator.nav2).map((line) => `${line}\n`).join('');
}

/** Returns all results as JSON, with typed arrays as plain arrays. */
function jsonOf({ viewModel: { fitted, stats, legs, truth }, logName }: Figure) {
  const allResults = { log: logName, date: new Date().toISOString(), settings: fitted, ...stats, ...(truth && { truth }), legs };
  return JSON.stringify(allResults, (_, value) => (ArrayBuffer.isView(value) ? [...(value as Float64Array)] : value), 1);
}

/**
 * Returns the button that copies the lines. For α's of another rule than Nav2's, it is a button that fits Nav2's rule. `obstacle` is the
 * reason why the button is disabled; empty if it is enabled.
 */
export function copyButton(figure: Figure, obstacle: string) {
  const texts = words.calibrator.nav2;
  if (!NAV2_RULES.includes(modelRuleOf(figure.viewModel.fitted))) return button(texts.fit, () => figure.gesture.decide(settingsFor('nav2')), { disabled: obstacle !== '', title: obstacle || texts.fitTitle });
  const yaml = yamlOf(figure);
  return figure.copyMenu.button('nav2', texts.copy, () => yaml, { disabled: !yaml || obstacle !== '', title: obstacle || (yaml ? texts.label : texts.none) });
}

/** Returns the message of the button, which stands where it moves neither the button nor the table. */
export const copyMessage = (figure: Figure) => figure.copyMenu.messageHtml('nav2', yamlOf(figure));

/** Returns the lines, and the button that saves all results. `obstacle` is the reason why it is disabled, or empty. */
export function nav2ExportControls(figure: Figure, obstacle: string) {
  const texts = words.calibrator.nav2;
  const yaml = yamlOf(figure);
  const fileName = `${figure.localName}-${figure.viewModel.config.seed}.json`;
  return html`${yaml ? html`<textarea class="yaml" readonly rows=${yaml.split('\n').length} aria-label=${texts.label} .value=${yaml}></textarea>` : html`<p>${texts.none}</p>`}
    <div class="buttons">
      ${button(texts.json, () => downloadFile(fileName, new Blob([jsonOf(figure)], { type: 'application/json' })), { disabled: obstacle !== '', title: obstacle || undefined })}
    </div>`;
}
