/** Diagnostics of the Alpha Calibrator: checks, held-out windows, noise of the reference, and lost legs. */

import { html } from 'lit';
import { words } from '../../messages/registry.js';
import { button, group } from '../../ui/controls.js';
import { NOTHING, counted, fixed, percent, rounded } from '../../ui/format.js';
import { figureTable, readoutList } from '../../ui/readouts.js';
import { checked, expectedOf, messageOf } from './words.js';

/** @typedef {import('./alpha-calibrator.js').AlphaCalibratorElement} Figure */

/** Returns all diagnostics, each in a group of its own. @param {Figure} figure */
export function diagnostics(figure) {
  const { checks, windows, noise, lost, largest } = words.calibrator;
  return html`${group(checks.title, checksTable(figure))}
    ${group(windows.title, windowsTable(figure))}
    ${group(noise.title, noiseTable(figure))}
    ${group(lost.title, lostLegs(figure))}
    ${group(largest.title, largestResiduals(figure))}`;
}

/** @param {Figure} figure */
function checksTable({ reading: { stats: { diagnostics: { checks } } } }) {
  const say = words.calibrator.checks;
  return figureTable({
    caption: say.caption,
    columns: [say.check, say.value, say.expected, say.result],
    rows: checks.map((check) => [
      html`${say.names[check.name]}<div class="muted">${messageOf(check)}</div>`,
      checked(check.name, check.value),
      expectedOf(check),
      check.passed ? `✓ ${say.passed}` : html`<strong>✕ ${say.failed}</strong>`,
    ]),
  });
}

/** @param {Figure} figure */
function windowsTable({ reading: { stats: { diagnostics: { windows } } } }) {
  const say = words.calibrator.windows;
  return figureTable({
    caption: say.caption,
    columns: [say.length, say.count, say.coverage, say.nees],
    rows: windows.map(({ length, count, coverage, nees }) => [`${counted(length)} m`, counted(count), percent(coverage), fixed(nees, 2)]),
  });
}

/** @param {Figure} figure */
function noiseTable({ reading: { stats: { referenceNoise: { positionStd, yawStd }, persistence: { correlation, length } } } }) {
  const { noise: say, settings, alphas: { interval: intervalName, between } } = words.calibrator;
  const print = (/** @type {number} */ value) => (value === 0 ? '0' : Number.isFinite(value) ? rounded(value, 2) : '∞');
  const row = (/** @type {string} */ name, /** @type {import('../../types.d.ts').Estimate} */ { value, interval: [low, high] }) => [name, print(value), between(print(low), print(high))];
  return figureTable({
    caption: say.caption,
    columns: [say.what, say.value, intervalName],
    rows: [
      row(`${settings.positionStd.name} (m)`, positionStd),
      row(`${settings.yawStd.name} (rad)`, yawStd),
      row(say.correlation, correlation),
      [say.length, length > 0 ? `${rounded(length, 2)} m` : NOTHING, NOTHING],
    ],
  });
}

/** @param {Figure} figure */
function lostLegs({ reading: { stats: { lost }, legs } }) {
  const say = words.calibrator.lost;
  const causes = /** @type {const} */ (['withoutReference', 'acrossBreaks', 'acrossPauses', 'standing']);
  const outliers = legs.outliers.reduce((sum, is) => sum + is, 0);
  return readoutList([...causes.map((cause) => /** @type {[string, string]} */ ([say[cause], counted(lost[cause])])), [say.outliers, counted(outliers)]]);
}

/** Buttons that show the legs with the largest residuals. @param {Figure} figure */
function largestResiduals(figure) {
  const say = words.calibrator.largest;
  const { worst, legs } = figure.reading;
  return html`<div class="buttons" role="group" aria-label=${say.title}>
    ${worst.map((leg) => button(say.leg(counted(leg + 1), legs.outliers[leg] > 0), () => figure.choose(leg), { pressed: leg === figure.chosen }))}
  </div>`;
}
