/** Squared residuals of the Alpha Calibrator against what drives them: the slope is an α. */

import { html } from 'lit';
import { words } from '../../messages/registry.js';
import { radioGroup, rich } from '../../ui/controls.js';
import { NOTHING } from '../../ui/format.js';
import { plot } from '../../ui/plot.js';
import { adviceOf, alphaOrBound, isZero, neededFor } from './lines.js';
import { COMPONENTS } from './settings.js';
import { alphaName, localized, thousandths } from './words.js';

/**
 * @import { CalibrationPanel } from '../../types.d.ts'
 * @import { Curve } from '../../ui/plot.js'
 * @typedef {import('./alpha-calibrator.js').AlphaCalibratorElement} Figure
 */

/** Least square of a way or turn: a millimetre, or a thousandth of a radian. */
const DRIVEN = 1e-6;

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
function panelsOf({ machine, reading: { config, legs }, state: { own: { driver } } }) {
  const say = words.calibrator.panels;
  const axes = config.model === 'velocity' ? { turn: say.turnRate, way: say.speed } : { turn: say.turn, way: say.way };
  const all = legs.count > 0 ? (machine?.panels(driver) ?? []) : [];
  return all.map((panel, i) => {
    const kind = say.kinds[COMPONENTS[config.model][i]];
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
    label: say.label(kind, String(alpha + 1), slope === null ? NOTHING : localized(alphaOrBound(slope, interval))),
    x: { name: axis, from: 0, to: last },
    y: { name: `${kind}, ${say.axis}${unit && ` (${unit})`}`, from: scaled(from), to: scaled(highest) },
    curves: [...lines, { name: say.bins, role: 'ink', x: [], y: [] }],
    points: x.map((at, i) => ({ role: /** @type {const} */ ('ink'), x: at, y: scaled(y[i]), error: scaled(error[i]) })),
  };
}

/** Note on an α that is not determined or not told from 0. @param {CalibrationPanel} panel @param {import('./reading.js').Reading} reading */
function noteOf({ alpha, slope, interval }, { config: { model } }) {
  const { panels: say, alphas: { lacking } } = words.calibrator;
  if (slope !== null && !isZero(slope, interval)) return '';
  const name = alphaName(alpha);
  return html`<p class="note">${rich(slope === null ? say.noSlope(name) : say.zero(name, adviceOf(lacking, model, neededFor(model, alpha)).drive))}</p>`;
}

/**
 * Range of an axis of squares: all bins and the line, and half as much again of their bars. The bar of a single leg would leave the
 * others no room.
 *
 * @param {number[]} squares of bins
 * @param {number[]} error of each
 * @param {number} line its highest square
 * @returns {{ from: number, to: number }}
 */
function axisOfSquares(squares, error, line) {
  const [lowest, highest] = [Math.min(0, ...squares), Math.max(0, line, ...squares)];
  const ends = (/** @type {number} */ side) => squares.map((square, i) => square + side * error[i]);
  const room = (highest - lowest) / 2;
  return {
    from: Math.max(lowest - room, Math.min(lowest, ...ends(-1))),
    to: Math.min(highest + room, Math.max(highest, ...ends(1))),
  };
}
