/** Systematic errors of the Alpha Calibrator: as a table, and as sentences. */

import { html, nothing } from 'lit';
import { words } from '../../messages/registry.js';
import { toggle } from '../../ui/controls.js';
import { fixed } from '../../ui/format.js';
import { SYSTEMATIC } from './settings.js';

/**
 * @import { Interval } from '../../types.d.ts'
 * @import { Reading } from './reading.js'
 * @typedef {import('./alpha-calibrator.js').AlphaCalibratorElement} Figure
 * @typedef {Reading['stats']['systematicErrors']['mountYaw' | 'leverArm']} SystematicError
 */

/** Most decimals of a systematic error: a micrometre. */
const MOST_DECIMALS = 6;

/**
 * Returns the systematic errors in two sentences: those that were corrected, and those that the α's include.
 *
 * @param {Reading} reading
 */
export function systematicTexts({ stats: { systematicErrors: errors } }) {
  const say = words.calibrator.systematic;
  const list = (/** @type {boolean} */ corrected) => SYSTEMATIC.filter((key) => errors[key].corrected === corrected).flatMap((key) => textOf(key, errors[key])).join('; ');
  const [corrected, left] = [list(true), list(false)];
  return [...(corrected ? [say.removed(corrected)] : []), ...(left ? [say.left(left)] : [])];
}

/**
 * Names the systematic errors that differ from 0, or a scale from 1, but are not to be corrected.
 *
 * @param {Reading} reading
 * @returns {string} empty if there are none
 */
export function uncorrectedText({ stats: { systematicErrors: errors }, config }) {
  const say = words.calibrator.systematic;
  const uncorrected = SYSTEMATIC.filter((key) => !config[key] && matters(key, errors[key])).flatMap((key) => textOf(key, errors[key]));
  return uncorrected.length > 0 ? say.matters(uncorrected.join('; ')) : '';
}

/** Checks whether an error differs from 0, or a scale from 1, beyond its interval. @param {string} key @param {SystematicError} error */
function matters(key, { interval }) {
  const neutral = key.endsWith('Scale') ? 1 : 0;
  return intervalsOf(interval).some((ends) => ends && (ends[0] > neutral || ends[1] < neutral));
}

/** Prints an error with its name. @param {typeof SYSTEMATIC[number]} key @param {SystematicError} error @returns {string[]} one text, or none if it is unknown */
function textOf(key, error) {
  const { values, halves } = digitsOf(error);
  return values.length ? [`${words.calibrator.systematic.names[key]} ${values.map((value, i) => `${value} ± ${halves[i]}`).join(', ')}`] : [];
}

/** Returns the intervals of an error: two for a lever arm. @param {SystematicError['interval']} interval */
function intervalsOf(interval) {
  const isPair = Array.isArray(interval) && interval.some((end) => typeof end !== 'number');
  return /** @type {(Interval | null)[]} */ (isPair ? interval : [interval]);
}

/** Table of the systematic errors, each with a box for its correction. @param {Figure} figure */
export function systematicTable(figure) {
  const { stats: { systematicErrors: errors }, truth } = figure.reading;
  const say = words.calibrator.systematic;
  const told = figure.settings.told;
  return html`<table class="systematic" part="table">
    <thead>
      <tr>
        <th scope="col">${say.what}</th><th scope="col">${say.value}</th><th scope="col">${say.interval}</th><th scope="col">${say.treatment}</th>
        ${truth ? html`<th scope="col">${say.truth}</th>` : nothing}
      </tr>
    </thead>
    <tbody>
      ${SYSTEMATIC.map((key) => {
        const { values, halves } = digitsOf(errors[key]);
        const box = toggle({ label: say.names[key], checked: told[key], change: (on) => figure.gesture.decide({ [key]: on }) });
        if (values.length === 0) return html`<tr><th scope="row">${box}</th><td colspan="4">${say.unknown}</td></tr>`;
        return html`<tr>
          <th scope="row">${box}</th>
          <td>${lines(values)}</td>
          <td class="between">${lines(halves.map((half) => `± ${half}`))}</td>
          <td>${errors[key].corrected ? say.corrected : errors[key].constant ? say.notCorrected : say.notConstant}</td>
          ${truth ? html`<td class="muted">${lines([truth[key]].flat().map((each) => fixed(each, 3)))}</td>` : nothing}
        </tr>`;
      })}
    </tbody>
  </table>`;
}

/** One below the other. @param {string[]} texts */
const lines = (texts) => texts.map((text) => html`<div>${text}</div>`);

/**
 * Prints an error as far as it is determined: its values, two for a lever arm, and half the width of each interval.
 *
 * @param {SystematicError} error
 */
function digitsOf({ value, interval }) {
  const known = intervalsOf(interval).map((each) => each && (each[1] - each[0]) / 2);
  return {
    values: [value].flat().flatMap((each, i) => (each === null ? [] : [fixed(each, decimalsOf(known[i]))])),
    halves: known.flatMap((half) => (half === null ? [] : [fixed(half, decimalsOf(half))])),
  };
}

/** Decimals of an error: three, or more if it is known better than to a thousandth. @param {number | null | undefined} half of an interval */
const decimalsOf = (half) => (half ? Math.min(MOST_DECIMALS, Math.max(3, -Math.floor(Math.log10(2 * half)))) : 3);
