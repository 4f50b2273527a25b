/** Diagnostics of the Alpha Calibrator: checks, held-out windows, noise of the reference, lost legs, and regression panels. */

import { html } from 'lit';
import { words } from '../../messages/registry.ts';
import { group, radioGroup, formatMarkup } from '../../ui/controls.ts';
import { NO_VALUE, integer, fixed, percent, formatRounded } from '../../ui/format.ts';
import { plot, type Curve } from '../../ui/plot.ts';
import { figureTable, readoutList } from '../../ui/readouts.ts';
import { subscriptOf } from '../shared/sliders.ts';
import { adviceOf, alphaOrBound, isZero, missingMotion } from './lines.ts';
import { NOISE_COMPONENTS, type Regressor } from './settings.ts';
import { checkText, expectedRangeText, checkMessage, localized, scaleByPowerOf1000 } from './words.ts';
import type { CalibrationPanel } from '../../types.d.ts';
import type { AlphaCalibratorElement as Figure } from './alpha-calibrator.ts';

export function diagnostics(figure: Figure) {
  const { checks, windows, noise, lost } = words.calibrator;
  return html`${group(checks.title, checksTable(figure))}
    ${group(windows.title, windowsTable(figure))}
    ${group(noise.title, noiseTable(figure))}
    ${group(lost.title, lostLegs(figure))}`;
}

function checksTable({ viewModel: { stats: { diagnostics: { checks } } } }: Figure) {
  const say = words.calibrator.checks;
  return figureTable({
    caption: say.caption,
    columns: [say.check, say.value, say.expected, say.result],
    rows: checks.map((check) => [
      html`${say.names[check.name]}<div class="muted">${checkMessage(check)}</div>`,
      checkText(check.name, check.value),
      expectedRangeText(check),
      check.passed ? `✓ ${say.passed}` : html`<strong>✕ ${say.failed}</strong>`,
    ]),
  });
}

function windowsTable({ viewModel: { stats: { diagnostics: { windows } } } }: Figure) {
  const say = words.calibrator.windows;
  return figureTable({
    caption: say.caption,
    columns: [say.length, say.count, say.coverage, say.nees],
    rows: windows.map(({ length, count, coverage, nees }) => [`${integer(length)} m`, integer(count), percent(coverage), fixed(nees, 2)]),
  });
}

function noiseTable({ viewModel: { stats: { referenceNoise: { positionStd, yawStd }, persistence: { correlation, length } } } }: Figure) {
  const { noise: say, systematic, settings, alphas: { interval: intervalName, between } } = words.calibrator;
  const formatStd = (value: number) => (value === 0 ? '0' : Number.isFinite(value) ? formatRounded(value, 2) : '∞');
  const row = (name: string, { value, interval: [low, high] }: import('../../types.d.ts').Estimate) => [name, formatStd(value), between(formatStd(low), formatStd(high))];
  return figureTable({
    caption: say.caption,
    columns: [say.what, systematic.value, intervalName],
    rows: [
      row(`${settings.positionStd.name} (m)`, positionStd),
      row(`${settings.yawStd.name} (rad)`, yawStd),
      row(say.correlation, correlation),
      [say.length, length > 0 ? `${formatRounded(length, 2)} m` : NO_VALUE, NO_VALUE],
    ],
  });
}

function lostLegs({ viewModel: { stats: { lost }, legs } }: Figure) {
  const say = words.calibrator.lost;
  const causes = ['withoutReference', 'acrossBreaks', 'acrossPauses', 'standing'] as const;
  const outliers = legs.outliers.reduce((sum, is) => sum + is, 0);
  return readoutList([...causes.map((cause) => [say[cause], integer(lost[cause])] as [string, string]), [say.outliers, integer(outliers)]]);
}

/** Minimum squared distance or rotation at the end of an axis: (1 mm)², or (1 mrad)². */
const MIN_REGRESSOR = 1e-6;

/** Returns a plot for each noise component: its squared residuals against the regressor. */
export function regressionPanels(figure: Figure) {
  const { viewModel, viewModel: { fitted: { model } }, state: { elementState: { regressor } }, gesture } = figure;
  const say = words.calibrator.panels;
  const axisNames = model === 'velocity' ? { turn: say.turnRate, distance: say.speed } : { turn: say.turn, distance: say.distance };
  if (viewModel.legs.count === 0) return html`<p>${words.calibrator.none}</p>`;
  const chooseRegressor = (name: Regressor) => gesture.choose('regressor', name);
  return html`${radioGroup(say.against, 'regressor', say.regressors, regressor, chooseRegressor)}
    <figure><div class="panels">
      ${figure.panels.map((panel, i) => html`<figure>
        ${plot(panelPlot(panel, say.kinds[NOISE_COMPONENTS[model][i]], axisNames[regressor as Regressor]))}
        ${identifiabilityNote(panel, viewModel)}
      </figure>`)}
    </div>
    <figcaption>${formatMarkup(say.caption)}</figcaption></figure>`;
}

/** Returns the plot of a panel. `kind` is the name of its noise component, and `axis` that of its regressor. */
function panelPlot({ alpha, x, y, error, slope, interval }: CalibrationPanel, kind: string, axis: string): import('../../ui/plot.ts').Plot {
  const say = words.calibrator.panels;
  const maxRegressor = Math.max(0, ...x);
  // A log without rotation or without translation has an empty axis.
  const axisEnd = maxRegressor > MIN_REGRESSOR ? 1.06 * maxRegressor : 1;
  // The axis has half as much space for error bars as for the bins and the line. A longer bar is cut, so that it does not compress all others.
  const [lowest, highest] = [Math.min(0, ...y), Math.max(x.length ? 1e-12 : 1, (slope ?? 0) * axisEnd, ...y)];
  const [axisBottom, axisTop] = [1.5 * lowest, 1.5 * highest];
  const { scaled, unit } = scaleByPowerOf1000(Math.max(axisTop, -axisBottom));
  const sub = subscriptOf(alpha);
  const [low, high] = interval ?? [NaN, NaN];
  const slopeMiddle = (low + high) / 2;
  const slopeLines: Curve[] = slope === null ? [] : [
    { name: say.slope(sub), role: 'prediction', x: [0, axisEnd], y: [0, scaled(slope * axisEnd)] },
    { name: words.calibrator.alphas.interval, role: 'cloud', area: true, x: [0, axisEnd], y: [0, scaled(slopeMiddle * axisEnd)], error: [0, scaled(((high - low) / 2) * axisEnd)] },
  ];
  return {
    label: say.label(kind, String(alpha + 1), slope === null ? NO_VALUE : localized(alphaOrBound(slope, interval))),
    x: { name: axis, from: 0, to: axisEnd },
    y: { name: `${kind}, ${say.axis}${unit && ` (${unit})`}`, from: scaled(axisBottom), to: scaled(axisTop) },
    curves: [...slopeLines, { name: say.bins, role: 'ink', x: [], y: [] }],
    points: x.map((value, i) => ({ role: 'ink' as const, x: value, y: scaled(y[i]), error: scaled(error[i]) })),
  };
}

/** Returns a note on an α that is not identifiable, or not distinguishable from 0. */
function identifiabilityNote({ alpha, slope, interval }: CalibrationPanel, { fitted: { model } }: import('./view-model.ts').ViewModel) {
  const { panels: say, alphas: { lacking } } = words.calibrator;
  if (slope !== null && !isZero(slope, interval)) return '';
  const sub = subscriptOf(alpha);
  return html`<p class="note">${formatMarkup(slope === null ? say.noSlope(sub) : say.zero(sub, adviceOf(lacking, model, missingMotion(model, alpha)).drive))}</p>`;
}
