/** Diagnostics of the Alpha Calibrator: drivers of the residuals, their distribution, and the effect of inflation. */

import { html } from 'lit';
import { slider } from '../../figure/controls.js';
import { words } from '../../messages/registry.js';
import { button, radioGroup, rich } from '../../ui/controls.js';
import { NOTHING, counted, fixed, percent, significant } from '../../ui/format.js';
import { plot } from '../../ui/plot.js';
import { figureTable } from '../../ui/readouts.js';
import { axisOf, axisOfSquares, between } from './curve.js';
import { OVERSTATED, adviceOf, isZero, neededFor } from './lines.js';
import { QUANTILES, REACH } from './quantiles.js';
import { alphaName, significantly, thousandths } from './words.js';

/**
 * @import { CalibrationPanel } from '../../types.d.ts'
 * @import { Curve, Role } from '../../ui/plot.js'
 * @typedef {import('./alpha-calibrator.js').AlphaCalibratorElement} Figure
 */

/** Least square of a way or turn: a millimetre, or a thousandth of a radian. */
const DRIVEN = 1e-6;

/** Larger figures have an exponent: the noise of a log that is exact to rounding is 10³⁰ times as large as expected. */
const LONG = 1e6;

/** @param {number} value */
const two = (value) => (Math.abs(value) < LONG ? fixed(value, 2) : significant(value, 3));

/** Squared residuals of the three noises against what drives them. @param {Figure} figure */
export function panels(figure) {
  const { reading, state: { own: { driver } }, gesture } = figure;
  const say = words.calibrator.panels;
  if (reading.legs.count === 0) return html`<p>${words.calibrator.none}</p>`;
  const choose = (/** @type {import('./settings.js').Driver} */ name) => gesture.choose('driver', name);
  return html`${radioGroup(say.against, 'driver', say.drivers, driver, choose)}
    <div class="panels">
      ${panelsOf(figure).map(({ panel, plot: described }) => html`<figure>
        ${plot(described)}
        ${noteOf(panel, reading)}
      </figure>`)}
    </div>
    <p class="figcaption">${rich(say.caption)}</p>`;
}

/** Panels with their plots; none without legs. @param {Figure} figure */
export function panelsOf({ machine, reading: { config, legs, stats }, state: { own: { driver } } }) {
  const say = words.calibrator.panels;
  const axes = config.model === 'velocity' ? { turn: say.turnRate, way: say.speed } : { turn: say.turn, way: say.way };
  const all = legs.count > 0 ? (machine?.panels(driver) ?? []) : [];
  return all.map((panel, i) => {
    const kind = say.kinds[/** @type {keyof typeof say.kinds} */ (stats.doubts.kinds[i].name)];
    return { panel, plot: panelPlot(panel, kind, axes[/** @type {'turn' | 'way'} */ (driver)]) };
  });
}

/**
 * @param {CalibrationPanel} panel
 * @param {string} kind
 * @param {string} axis
 * @returns {import('../../ui/plot.js').Plot}
 */
function panelPlot({ alpha, x, y, error, slope, interval }, kind, axis) {
  const say = words.calibrator.panels;
  const furthest = Math.max(0, ...x);
  // A log without turns or without ways has an empty axis.
  const last = furthest > DRIVEN ? 1.06 * furthest : 1;
  const { from, to } = axisOfSquares(y, error, (slope ?? 0) * last);
  const highest = 1.1 * Math.max(x.length ? 1e-12 : 1, to);
  const { scaled, unit } = thousandths(Math.max(highest, -from));
  const name = alphaName(alpha);
  const [low, high] = interval ?? [NaN, NaN];
  const middle = (low + high) / 2;
  /** @type {Curve[]} */
  const lines = slope === null ? [] : [
    { name: say.slope(name), role: 'prediction', x: [0, last], y: [0, scaled(slope * last)] },
    { name: words.calibrator.alphas.interval, role: 'cloud', area: true, x: [0, last], y: [0, scaled(middle * last)], error: [0, scaled(((high - low) / 2) * last)] },
  ];
  return {
    label: say.label(kind, String(alpha + 1), slope === null ? NOTHING : significantly(slope)),
    x: { name: axis, from: 0, to: last },
    y: { name: `${kind}, ${say.axis}${unit && ` (${unit})`}`, from: scaled(from), to: scaled(highest) },
    curves: [...lines, { name: say.bins, role: 'ink', x: [], y: [] }],
    points: x.map((at, i) => ({ role: /** @type {const} */ ('ink'), x: at, y: scaled(y[i]), error: scaled(error[i]) })),
  };
}

/** Note on an α that is not determined or not told from 0. @param {CalibrationPanel} panel @param {import('./reading.js').Reading} reading */
function noteOf({ alpha, slope, interval }, { config: { model }, stats: { doubts: { verdict } } }) {
  const { panels: say, alphas: { lacking } } = words.calibrator;
  if (slope !== null && (!isZero(slope, interval) || verdict === OVERSTATED)) return '';
  const name = alphaName(alpha);
  return html`<p class="note">${rich(slope === null ? say.noSlope(name) : say.zero(name, adviceOf(lacking, model, neededFor(model, alpha)).drive))}</p>`;
}

/** Styles of the curves. @type {{ role: Role, dash?: string }[]} */
const LOOKS = [{ role: 'prediction' }, { role: 'prior', dash: '7 4' }, { role: 'posterior', dash: '2 4' }];

/** @param {Figure} figure */
export function doubts(figure) {
  if (figure.reading.legs.count === 0) return html`<p>${words.calibrator.none}</p>`;
  const { config: { noise }, stats: { doubts: { kinds, heldOut, squaredError, worst }, outliers, gaps } } = figure.reading;
  const say = words.calibrator.doubts;
  const nameOf = (/** @type {string} */ name) => /** @type {Record<string, string>} */ (words.calibrator.panels.kinds)[name];
  const range = (/** @type {readonly number[]} */ [low, high], /** @type {(value: number) => string} */ print) =>
    Number.isFinite(high - low) ? `${print(low)} – ${print(high)}` : NOTHING;
  return html`<div class="figures">
      <figure>
        ${plot({
          label: say.qqLabel(kinds.map(({ name }) => nameOf(name)).join(', ')),
          x: { name: say.qqX, from: -3, to: 3 },
          y: { name: say.qqY, from: -REACH, to: REACH },
          curves: [
            { name: words.calibrator.noises[noise], role: 'truth', x: [-REACH, REACH], y: [-REACH, REACH] },
            ...kinds.map(({ name, quantiles }, i) => ({ name: nameOf(name), ...LOOKS[i], x: QUANTILES[noise], y: quantiles })),
          ],
        })}
        <figcaption>${say.qq}</figcaption>
      </figure>
      <div>
        ${figureTable({
          caption: say.caption,
          columns: [say.what, say.measured, say.ifTrue],
          rows: [
            [say.heldOut, percent(heldOut.coverage), range(heldOut.interval, percent)],
            [say.squared, two(squaredError.mean), range(squaredError.interval, two)],
            ...kinds.map(({ name, kurtosis, kurtosisExpected }) => [say.kurtosis(nameOf(name)), two(kurtosis), two(kurtosisExpected)]),
            ...kinds.map(({ name, autocorrelation, autocorrelationLimit: most }) => [say.autocorrelation(nameOf(name)), two(autocorrelation), range([-most, most], two)]),
            [say.outliers, outliers === null ? NOTHING : percent(outliers), NOTHING],
            [say.gaps, `${counted(gaps.odometry)}, ${counted(gaps.reference)}`, NOTHING],
          ],
        })}
        <div class="buttons" role="group" aria-label=${say.worst}>
          ${worst.slice(0, 5).map((leg) => button(say.worstLeg(String(leg + 1)), () => figure.choose(leg), { pressed: leg === figure.chosen }))}
        </div>
      </div>
    </div>`;
}

/** Effect of the inflation on held-out legs. @param {Figure} figure */
export function inflation(figure) {
  const { config: { inflation: factor }, stats: { inflation: { factors, coverage, logLikelihood }, doubts: { heldOut, verdict } } } = figure.reading;
  const say = words.calibrator.inflation;
  if (factors.length === 0) return html`<p>${words.calibrator.none}</p>`;
  const x = { name: say.factor, from: factors[0], to: factors[factors.length - 1], logarithmic: true };
  /** @type {(axis: { from: number, to: number }) => Curve} */
  const present = ({ from, to }) => ({ name: say.present(fixed(factor, 2)), role: 'accent', dash: '2 3', x: [factor, factor], y: [from, to] });
  const ends = axisOf(logLikelihood, 6);
  const [covered, nats] = [between(factors, coverage, factor), between(factors, logLikelihood, factor)];
  const [low, high] = heldOut.interval;
  // An overstated error of the reference, not the factor, decides the coverage.
  const signature = Number.isNaN(covered) || verdict === OVERSTATED ? '' : covered < low ? say.signature.small : covered > high ? say.signature.large : say.signature.right;
  return html`<fieldset>${slider(figure, 'inflation')}</fieldset>
    <div class="figures">
      <figure>${plot({
        label: say.coverageLabel(fixed(factor, 2), percent(covered)),
        x,
        y: { name: say.coverage, from: 0, to: 1 },
        curves: [
          { name: say.expected, role: 'truth', dash: '1 3', x: [x.from, x.to], y: [heldOut.expected, heldOut.expected] },
          { name: say.coverage, role: 'prediction', x: factors, y: coverage },
          present({ from: 0, to: 1 }),
        ],
        points: [{ role: 'prediction', x: factor, y: covered, error: 0 }],
      })}</figure>
      <figure>${plot({
        label: say.likelihoodLabel(fixed(factor, 2), two(nats)),
        x,
        y: { name: say.likelihood, ...ends },
        curves: [{ name: say.likelihood, role: 'prediction', x: factors, y: logLikelihood }, present(ends)],
        points: [{ role: 'prediction', x: factor, y: nats, error: 0 }],
      })}</figure>
    </div>
    <p class="caption">${signature}</p>`;
}
