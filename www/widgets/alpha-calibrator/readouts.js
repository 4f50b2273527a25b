/** The Alpha Calibrator's figures: the α's and what is systematic, each with its interval. */

import { html, nothing, svg } from 'lit';
import { words } from '../../messages/registry.js';
import { rich, toggle } from '../../ui/controls.js';
import { NOTHING, fixed, powerOfTen, significant, tick } from '../../ui/format.js';
import { adviceOf, isZero } from './lines.js';
import { truthHolds } from './reading.js';
import { SYSTEMATIC } from './settings.js';
import { alphaName, intervalsOf, judgementOf, legsText, noiseNames, significantly, uncorrectedText } from './words.js';

/**
 * @import { Interval } from '../../types.d.ts'
 * @import { Reading } from './reading.js'
 * @typedef {import('./alpha-calibrator.js').AlphaCalibratorElement} Figure
 */

/** Size of a whisker's row. */
const CHART = { width: 200, height: 24, middle: 18.5, inset: 12 };

/** Most decades between labels of the axis. */
const MOST_DECADES = 4;

/** Icons of the ratings. */
const ICONS = { consistent: '✓', questionable: '!', unusable: '✕' };

/** Returns the badge of the α's, with the verdict, the next step and the legs. @param {Figure} figure */
export function verdictLine({ reading, logName }) {
  const { rating, badge, finding, next } = judgementOf(reading);
  return html`<span class="badge ${rating}"><span aria-hidden="true">${ICONS[rating]}</span> ${badge}</span>
    <strong>${finding} ${uncorrectedText(reading)}</strong> ${next} <span class="muted">${legsText(reading, logName)}</span>`;
}

/** Table of the α's, each with its interval on a common axis. @param {Reading} reading */
export function alphaTable(reading) {
  const { alphas, intervals } = reading.stats;
  const say = words.calibrator.alphas;
  const noises = noiseNames(reading.config.model);
  const truth = truthHolds(reading) ? reading.truth?.alphas : undefined;
  const place = axisOf([...alphas, ...intervals.flatMap((interval) => interval ?? []), ...(truth ?? [])]);
  return html`<table class="alphas" part="table">
    <thead>
      <tr><th scope="col">${rich(say.alpha)}</th><th scope="col">${truth ? trueHead() : say.noise}</th><th scope="col">${say.value}</th><th scope="col">${say.recommended}</th></tr>
    </thead>
    <tbody>
      ${alphas.map((alpha, i) => html`<tr>
        <th scope="row">${rich(`*α*${alphaName(i)}`)}</th>
        ${alpha === null
          ? html`<td colspan="3"><div class="of">${noises[i]}</div><span class="unknown">${lackOf(reading, i)}</span></td>`
          : html`<td class="chart"><div class="of">${noises[i]}</div>${whisker(place, alpha, intervals[i], truth?.[i])}</td>
            <td class="roomy" data-room=${say.between('0.0000', '0.0000')}>${toldOf(alpha, intervals[i])}<div class="between">${betweenOf(intervals[i])}</div></td>
            <td class="roomy recommended" data-room="0.0000">${recommendedOf(reading, i)}</td>`}
      </tr>`)}
      <tr class="axis" aria-hidden="true">
        <td></td>
        <td class="chart">
          <div class="scale">${place.decades.map((decade) => html`<span .style=${`left: ${(100 * place.at(decade)) / CHART.width}%`}>${decade < 5e-4 ? powerOfTen(Math.round(Math.log10(decade))) : tick(decade, decade)}</span>`)}</div>
        </td>
        <td colspan="2"></td>
      </tr>
    </tbody>
  </table>`;
}

/** Prints a recommended α. @param {Reading} reading @param {number} index */
function recommendedOf({ stats: { recommended, intervals } }, index) {
  const alpha = recommended?.alphas[index] ?? null;
  const ends = /** @type {Interval | null} */ (intervals[index]?.map((end) => (recommended?.inflation ?? 1) * end) ?? null);
  return alpha === null ? NOTHING : toldOf(alpha, ends);
}

/** Prints an α, or its upper bound if it is not told from 0. @param {number} alpha @param {Interval | null} interval */
export const toldOf = (alpha, interval) => (isZero(alpha, interval) ? `≤ ${interval ? significant(interval[1], 2) : NOTHING}` : significantly(alpha));

/** Says why an α is not determined, and the drive that would determine it. @param {Reading} reading @param {number} index */
function lackOf({ stats: { notIdentifiable }, config: { model } }, index) {
  const say = words.calibrator.alphas;
  const reason = notIdentifiable[index];
  if (!reason) return NOTHING;
  const { lack, drive } = adviceOf(say.lacking, model, reason);
  return say.unknown(lack, drive);
}

/** All α's as texts, each with its interval. @param {Reading} reading */
export function alphaTexts(reading) {
  const { stats: { alphas, intervals }, config } = reading;
  return alphas.map((alpha, i) => {
    const told = alpha === null ? [lackOf(reading, i)] : [toldOf(alpha, intervals[i]), betweenOf(intervals[i]), words.calibrator.alphas.recommendedText(recommendedOf(reading, i))];
    return `α${alphaName(i)} ${noiseNames(config.model)[i]}: ${told.join(', ')}`;
  });
}

/** @param {Interval | null} interval */
const betweenOf = (interval) => (interval ? words.calibrator.alphas.between(significantly(interval[0]), significantly(interval[1])) : NOTHING);

/** Returns the head of the noises with the mark of the true value. */
function trueHead() {
  const [before, after] = words.calibrator.alphas.noiseTrue.split('|');
  return html`${before}<svg class="sample" viewBox="0 0 6 12" aria-hidden="true"><path class="true" d="M3 1V11" /></svg>${after}`;
}

/**
 * Logarithmic axis over the decades of some values.
 *
 * @param {(number | null)[]} values
 */
function axisOf(values) {
  const logs = values.filter((value) => value !== null && value > 0 && Number.isFinite(value)).map((value) => Math.log10(/** @type {number} */ (value)));
  const from = Math.floor(Math.min(0, ...(logs.length ? [Math.max(Math.min(...logs), Math.max(...logs) - 4)] : [-3])));
  const to = Math.max(from + 1, Math.ceil(logs.length ? Math.max(...logs) : 0));
  const { width, inset } = CHART;
  const at = (/** @type {number} */ value) => {
    const share = (Math.log10(Math.max(value, 0)) - from) / (to - from);
    // A mark beyond the axis stays whole at its edge.
    return Math.max(inset / 3, Math.min(width - inset / 3, inset + share * (width - 2 * inset)));
  };
  // More labels would touch.
  const step = Math.ceil((to - from) / MOST_DECADES);
  return { at, decades: Array.from({ length: Math.floor((to - from) / step) + 1 }, (_, i) => 10 ** (from + i * step)) };
}

/**
 * @param {ReturnType<typeof axisOf>} axis
 * @param {number} value
 * @param {[number, number] | null} interval
 * @param {number | undefined} truth
 */
function whisker({ at, decades }, value, interval, truth) {
  const { width, height, middle } = CHART;
  const [low, high] = (interval ?? [value, value]).map(at);
  return html`<svg viewBox="0 0 ${width} ${height}" preserveAspectRatio="none" aria-hidden="true">
    ${decades.map((decade) => svg`<path class="grid" d="M${at(decade)} 0V${height}" />`)}
    ${truth === undefined ? nothing : svg`<path class="true" d="M${at(truth)} ${middle - 5}V${height}" />`}
    <path class="whisker" d="M${low} ${middle}H${high}M${low} ${middle - 4}v8M${high} ${middle - 4}v8" />
    <path class="dot" d="M${at(value)} ${middle}h0" />
  </svg>`;
}

/** Most decimals of a systematic error: a micrometre. */
const MOST_DECIMALS = 6;

/**
 * Systematic errors as two texts: those that were corrected, and those that the α's include.
 *
 * @param {Reading} reading
 */
export function systematicTexts({ stats: { systematicErrors: errors } }) {
  const say = words.calibrator.systematic;
  const told = (/** @type {boolean} */ corrected) =>
    SYSTEMATIC.filter((key) => errors[key].corrected === corrected).flatMap((key) => {
      const { values, halves } = digitsOf(errors[key]);
      return values.length ? [`${say.names[key]} ${values.map((value, i) => `${value} ± ${halves[i]}`).join(', ')}`] : [];
    });
  const [removed, left] = [told(true), told(false)];
  return [...(removed.length ? [say.removed(removed.join('; '))] : []), ...(left.length ? [say.left(left.join('; '))] : [])];
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
 * @param {{ value: number | null | (number | null)[], interval: Interval | [Interval | null, Interval | null] | null }} error
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
