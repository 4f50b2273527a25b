/** Plots of the α's by the length of legs: level if the tables are right, falling if noise grows with the way itself. */

import { html } from 'lit';
import { check } from '../../figure/controls.js';
import { words } from '../../messages/registry.js';
import { NOTHING, typed } from '../../ui/format.js';
import { plot } from '../../ui/plot.js';
import { driverOf } from './lines.js';
import { toldOf } from './readouts.js';
import { SIMULATED } from './settings.js';
import { alphaName, significantly } from './words.js';

/**
 * @import { AlphasAtLength, AlphaCalibratorSettings } from '../../types.d.ts'
 * @typedef {import('./alpha-calibrator.js').AlphaCalibratorElement} Figure
 */

/** Least decades of an axis: over one a law is hard to see. */
const DECADES = 2;

/** @param {Figure} figure */
export function lengths(figure) {
  const { stats: { alphas, byLength }, config, truth } = figure.reading;
  const say = words.calibrator.lengths;
  return html`${check(figure, 'byLength', say.fit)}
    ${byLength.length === 0
      ? ''
      : html`<div class="panels">${alphas.map((_, i) => html`<figure>${lengthPlot(config, byLength, i)}</figure>`)}</div>
        <p class="figcaption">${say.caption} ${truth ? say.simulated(typed(SIMULATED.distance, 0), typed(SIMULATED.angle, 0)) : ''}</p>`}`;
}

/**
 * @param {AlphaCalibratorSettings} config
 * @param {AlphasAtLength[]} byLength
 * @param {number} index of the α, from 0
 */
function lengthPlot(config, byLength, index) {
  const say = words.calibrator.lengths;
  const driver = driverOf(config.model, index);
  const lasts = config.duration > 0;
  const asked = lasts ? config.duration : driver === 'turn' ? config.angle : config.distance;
  const told = byLength.map(({ factor, alphas, bootstrap }) => ({ x: factor * asked, y: alphas[index] ?? NaN, ends: bootstrap[index] }));
  const there = told.flatMap(({ y, ends }) => [y, ...(ends ?? [])]).filter((value) => value > 0 && value < Infinity).map(Math.log10);
  const to = there.length ? Math.ceil(Math.max(...there)) : 0;
  // An interval from 0 has no end on such an axis, and one that is nearly so leaves it.
  const from = Math.min(to - DECADES, Math.floor(Math.min(...told.map(({ y }) => (y > 0 ? Math.log10(y) : to)))));
  const [shortest, last] = [told[0].x / 1.2, told[told.length - 1].x * 1.2];
  const fitted = byLength.find(({ factor }) => factor === 1)?.alphas[index] ?? null;
  const ends = [shortest, last];
  return plot({
    label: say.label(String(index + 1), told.map(({ x, y, ends }) => say.at(Number.isNaN(y) ? NOTHING : toldOf(y, ends), significantly(x))).join(', ')),
    x: { name: say[lasts ? 'time' : driver], from: shortest, to: last, logarithmic: true },
    y: { name: `α${alphaName(index)}`, from: 10 ** from, to: 10 ** to, logarithmic: true },
    curves: !fitted ? [] : [
      { name: say.square, role: 'truth', dash: '1 3', x: ends, y: [fitted, fitted] },
      { name: say.linear, role: 'prior', dash: '7 4', x: ends, y: ends.map((x) => (fitted * asked) / x) },
    ],
    points: told.map(({ ends, ...point }) => ({ role: /** @type {const} */ ('prediction'), error: 0, ends: ends ?? undefined, ...point })),
  });
}
