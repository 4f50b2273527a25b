/** Diagnostics of the Alpha Calibrator: checks, held-out windows, noise of the reference, lost legs, and regression panels. */

import { html } from 'lit';
import { words } from '../../messages/registry.ts';
import { group, radioGroup, formatMarkup } from '../../ui/controls.ts';
import { NO_VALUE, integer, fixed, percent, formatPowerOfTen, formatRounded } from '../../ui/format.ts';
import { plot, type Curve } from '../../ui/plot.ts';
import { figureTable, readoutList } from '../../ui/readouts.ts';
import { subscriptOf } from '../shared/sliders.ts';
import { adviceOf, formatAlphaOrBound, isZero, missingMotion } from './lines.ts';
import { NOISE_COMPONENTS, type Regressor } from './settings.ts';
import { checkText, expectedRangeText, checkMessage, localized, rangeText } from './words.ts';
import type { CalibrationPanel } from '../../types.d.ts';
import type { AlphaCalibratorElement as Figure } from './alpha-calibrator.ts';

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
      html`${texts.names[check.name]}<div class="muted">${checkMessage(check)}</div>`,
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
    rows: windows.map(({ length, count, coverage, nees }) => [`${integer(length)} m`, integer(count), percent(coverage), fixed(nees, 2)]),
  });
}

function noiseTable({ viewModel: { stats: { referenceNoise: { positionStd, yawStd }, persistence: { correlation, length } } } }: Figure) {
  const { noise: texts, systematic, settings, alphas: { interval: intervalName } } = words.calibrator;
  const formatStd = (value: number) => (value === 0 ? '0' : Number.isFinite(value) ? formatRounded(value, 2) : '∞');
  const noiseRow = (name: string, { value, interval: [low, high] }: import('../../types.d.ts').Estimate) => [name, formatStd(value), rangeText(formatStd(low), formatStd(high))];
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
function panelPlot({ alpha, x, y, error, slope, interval }: CalibrationPanel, kind: string, axis: string): import('../../ui/plot.ts').Plot {
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

/** Returns a note on an α that is not distinguishable from 0, with the drive that would identify it. */
function identifiabilityNote({ alpha, slope, interval }: CalibrationPanel, { fitted: { model } }: import('./view-model.ts').ViewModel) {
  const { panels: texts, alphas: { lacking } } = words.calibrator;
  if (!isZero(slope, interval)) return '';
  return html`<p class="note">${formatMarkup(texts.zero(subscriptOf(alpha), adviceOf(lacking, model, missingMotion(model, alpha)).drive))}</p>`;
}
