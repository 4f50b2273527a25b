/** Diagnostics of the Alpha Calibrator: checks, held-out windows, noise of the reference, and lost legs. */

import { html } from 'lit';
import { words } from '../../messages/registry.ts';
import { button, group } from '../../ui/controls.ts';
import { NOTHING, counted, fixed, percent, rounded } from '../../ui/format.ts';
import { figureTable, readoutList } from '../../ui/readouts.ts';
import { checked, expectedOf, messageOf } from './words.ts';
import type { AlphaCalibratorElement as Figure } from './alpha-calibrator.ts';

/** Returns all diagnostics, each in a separate group. */
export function diagnostics(figure: Figure) {
  const { checks, windows, noise, lost, largest } = words.calibrator;
  return html`${group(checks.title, checksTable(figure))}
    ${group(windows.title, windowsTable(figure))}
    ${group(noise.title, noiseTable(figure))}
    ${group(lost.title, lostLegs(figure))}
    ${group(largest.title, largestResiduals(figure))}`;
}

function checksTable({ reading: { stats: { diagnostics: { checks } } } }: Figure) {
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

function windowsTable({ reading: { stats: { diagnostics: { windows } } } }: Figure) {
  const say = words.calibrator.windows;
  return figureTable({
    caption: say.caption,
    columns: [say.length, say.count, say.coverage, say.nees],
    rows: windows.map(({ length, count, coverage, nees }) => [`${counted(length)} m`, counted(count), percent(coverage), fixed(nees, 2)]),
  });
}

function noiseTable({ reading: { stats: { referenceNoise: { positionStd, yawStd }, persistence: { correlation, length } } } }: Figure) {
  const { noise: say, settings, alphas: { interval: intervalName, between } } = words.calibrator;
  const print = (value: number) => (value === 0 ? '0' : Number.isFinite(value) ? rounded(value, 2) : '∞');
  const row = (name: string, { value, interval: [low, high] }: import('../../types.d.ts').Estimate) => [name, print(value), between(print(low), print(high))];
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

function lostLegs({ reading: { stats: { lost }, legs } }: Figure) {
  const say = words.calibrator.lost;
  const causes = ['withoutReference', 'acrossBreaks', 'acrossPauses', 'standing'] as const;
  const outliers = legs.outliers.reduce((sum, is) => sum + is, 0);
  return readoutList([...causes.map((cause) => [say[cause], counted(lost[cause])] as [string, string]), [say.outliers, counted(outliers)]]);
}

/** Buttons that show the legs with the largest residuals. */
function largestResiduals(figure: Figure) {
  const say = words.calibrator.largest;
  const { worst, legs } = figure.reading;
  return html`<div class="buttons" role="group" aria-label=${say.title}>
    ${worst.map((leg) => button(say.leg(counted(leg + 1), legs.outliers[leg] > 0), () => figure.choose(leg), { pressed: leg === figure.chosen }))}
  </div>`;
}
