/** The Alpha Calibrator's α's by the length of legs: level where the tables are right, falling where noise grows with the way itself. */

import { html } from 'lit';
import { check } from '../../figure/controls.js';
import { words } from '../../messages/registry.js';
import { NOTHING, typed } from '../../ui/format.js';
import { plot } from '../../ui/plot.js';
import { SIMULATED } from './settings.js';
import { alphaName, driverOf, significantly, thousandths } from './words.js';

/**
 * @import { AlphasAtLength, AlphaCalibratorSettings } from '../../types.d.ts'
 * @typedef {import('./alpha-calibrator.js').AlphaCalibratorElement} Figure
 */

/** Of a curve that bends. */
const CHORDS = 40;

/** An interval that reaches so many times as high as all α's would make them small: it leaves the plot instead. */
const MUCH_HIGHER = 2;

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
  const driver = driverOf(config, index);
  const asked = driver === 'turn' ? config.angle : config.distance;
  const told = byLength.map(({ factor, alphas, intervals }) => ({ x: factor * asked, y: alphas[index] ?? NaN, ends: intervals[index] ?? undefined }));
  const values = told.map(({ y }) => y).filter(Number.isFinite);
  const most = Math.max(1e-12, ...values);
  const highest = 1.1 * Math.max(most, ...told.map(({ ends }) => Math.min(ends?.[1] ?? 0, MUCH_HIGHER * most)));
  const { scaled, unit } = thousandths(highest);
  const [shortest, last] = [told[0].x, 1.05 * told[told.length - 1].x];
  const fitted = byLength.find(({ factor }) => factor === 1)?.alphas[index] ?? null;
  const along = Array.from({ length: CHORDS + 1 }, (_, i) => shortest * (last / shortest) ** (i / CHORDS));
  const name = `α${alphaName(index)}`;
  return plot({
    label: say.label(String(index + 1), told.map(({ x, y }) => say.at(Number.isNaN(y) ? NOTHING : significantly(y), significantly(x))).join(', ')),
    x: { name: say[driver], from: 0, to: last },
    y: { name: unit === '' ? name : `${name} (${unit})`, from: 0, to: scaled(highest) },
    curves: fitted === null ? [] : [
      { name: say.square, role: 'truth', dash: '1 3', x: [shortest, last], y: [fitted, fitted].map(scaled) },
      { name: say.linear, role: 'prior', dash: '7 4', x: along, y: along.map((x) => scaled((fitted * asked) / x)) },
    ],
    points: told.map(({ x, y, ends }) => ({ role: /** @type {const} */ ('prediction'), x, y: scaled(y), error: 0, ends: ends?.map(scaled) })),
  });
}
