/**
 * Report of the results of a run, as Markdown.
 *
 * @module
 */

import { quantileSorted } from 'd3-array';
import { SLOWDOWN } from './drag.js';

/**
 * @typedef {import('./suite.js').Timings} Timings
 *
 * @typedef {object} Results
 * @property {Record<string, string>} ranOn simulation, versions and date
 * @property {boolean} quick
 * @property {Timings} node
 * @property {Timings} chromium
 * @property {Record<string, number[]>} start ms from the script's start to the end of each stage, for each load of the page
 * @property {import('./drag.js').Drag[]} drags
 */

/** Duration of a frame at 60 Hz, ms. */
const FRAME_MS = 16.7;

/** Returns the report as text. @param {Results} results */
export function report({ ranOn, quick, node, chromium, start, drags }) {
  const slowest = drags.reduce((slowestSoFar, drag) => (quantileOf(drag.picture) > quantileOf(slowestSoFar.picture) ? drag : slowestSoFar));
  const byRuntime = (/** @type {(timings: Timings) => number[]} */ valuesOf) => ({ Node: valuesOf(node), Chromium: valuesOf(chromium) });
  const refreshOf = (/** @type {number} */ samples) => (/** @type {Timings} */ { refresh }) => refresh.find((row) => row.samples === samples) ?? refresh[0];
  const ratios = (/** @type {Timings['refresh'][number]} */ { core, baseline }) => baseline.map((value, turn) => value / core[turn]);
  const [largestRefresh, middleRefresh] = [1e6, 1e5].map(refreshOf);
  /** @type {[string, '≤' | '≥', number, string, Record<string, number[]>][]} */
  const targets = [
    ['Refresh of 1 000 000 poses', '≤', FRAME_MS, 'ms', byRuntime((timings) => largestRefresh(timings).core)],
    ['Refresh of 100 000 poses', '≤', 2, 'ms', byRuntime((timings) => middleRefresh(timings).core)],
    ['JavaScript takes longer, at 1 000 000 poses', '≥', 3, '×', byRuntime((timings) => ratios(largestRefresh(timings)))],
    ['Calibration of the example log', '≤', 1000, 'ms', byRuntime(({ calibration }) => calibration)],
    ['From script start to first cloud', '≤', 100, 'ms', { Chromium: Object.values(start).at(-1) ?? [] }],
    [`Step of the slowest drag (${slowest.control}), processor ${SLOWDOWN} times slower`, '≤', FRAME_MS, 'ms', { Chromium: slowest.picture }],
  ];
  const targetRows = targets.map(([targetName, comparison, limit, unit, { Node = [], Chromium = [] }]) => {
    const reachedIn = [Node, Chromium].filter(({ length }) => length > 0).map((values) => (comparison === '≤' ? quantileOf(values) <= limit : quantileOf(values) >= limit));
    const verdict = reachedIn.every(Boolean) ? 'yes' : !reachedIn.some(Boolean) ? 'no' : `in ${reachedIn[0] ? 'Node' : 'Chromium'} alone`;
    return { '': targetName, target: `${comparison} ${limit} ${unit}`, Node: cellText(Node, unit), Chromium: cellText(Chromium, unit), reached: verdict };
  });
  const refreshRows = Object.entries({ Node: node, Chromium: chromium }).flatMap(([where, { refresh }]) => refresh.map((row) => (
    { where, samples: formatDigits(row.samples), 'refresh, ms': cellText(row.core), 'JavaScript, ms': cellText(row.baseline), ratio: cellText(ratios(row)) }
  )));
  return [
    `${Object.entries(ranOn).map(([name, value]) => `${name} ${value}`).join('; ')}. Medians, with quartiles in brackets.${quick ? ' A quick run: too few turns to be quoted.' : ''}`,
    markdownTable(targetRows),
    `One event of the slider:\n\n${markdownTable(refreshRows)}`,
    `First cloud, from the start of the script:\n\n${markdownTable(Object.entries(start).map(([until, times]) => ({ until, ms: cellText(times) })))}`,
    `Step of a drag, processor ${SLOWDOWN} times slower, opening sizes:\n\n${markdownTable(drags.map(({ widget, control, picture, text, steady }) => (
      { widget, dragged: control, 'frame with the picture, ms': cellText(picture), 'text after it, ms': cellText(text), 'between frames, a step in each, ms': cellText(steady) }
    )))}`,
  ].join('\n\n');
}

/** Returns a quantile, by default the median. @param {number[]} values @param {number} [share] */
function quantileOf(values, share = 0.5) {
  return quantileSorted(values.toSorted((a, b) => a - b), share) ?? NaN;
}

/** @param {number[]} values @param {string} [unit] */
function cellText(values, unit = '') {
  const [lower, middle, upper] = [0.25, 0.5, 0.75].map((share) => formatDigits(quantileOf(values, share)));
  return values.length > 0 ? `${`${middle} ${unit}`.trim()} [${lower} to ${upper}]` : '';
}

/** Rounds to three significant digits. @param {number} value */
const formatDigits = (value) => value.toLocaleString('en', { maximumSignificantDigits: 3 }).replaceAll(',', '\u202f');

/** Returns a table with a column for each key. @param {Record<string, string>[]} rows */
function markdownTable(rows) {
  const columnNames = Object.keys(rows[0]);
  const lines = [columnNames, columnNames.map(() => '---'), ...rows.map(Object.values)];
  return lines.map((cells) => `| ${cells.join(' | ')} |`).join('\n');
}
