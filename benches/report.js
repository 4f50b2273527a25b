/**
 * Report of the results of a run, as Markdown.
 *
 * @module
 */

import { quantileSorted } from 'd3-array';
import { CPU_SLOWDOWN } from './drag.js';

/**
 * @typedef {import('./suite.js').Timings} Timings
 *
 * @typedef {object} Results
 * @property {Record<string, string>} ranOn machine, versions and date
 * @property {boolean} quick
 * @property {Timings} node
 * @property {Timings} chromium
 * @property {Record<string, number[]>} start ms from the script's start to the end of each stage, for each load of the page
 * @property {import('./drag.js').Drag[]} drags
 */

/** Duration of a frame at 60 Hz, ms. */
const FRAME_MS = 16.7;

/** Returns the report as Markdown. @param {Results} results */
export function formatReport({ ranOn, quick, node, chromium, start, drags }) {
  const slowestDrag = drags.reduce((slowestSoFar, drag) => (computeQuantile(drag.picture) > computeQuantile(slowestSoFar.picture) ? drag : slowestSoFar));
  const valuesByRuntime = (/** @type {(timings: Timings) => number[]} */ valuesOf) => ({ Node: valuesOf(node), Chromium: valuesOf(chromium) });
  const refreshOfSize = (/** @type {number} */ samples) => (/** @type {Timings} */ { refresh }) => refresh.find((row) => row.samples === samples) ?? refresh[0];
  const speedRatios = (/** @type {Timings['refresh'][number]} */ { core, baseline }) => baseline.map((value, turn) => value / core[turn]);
  const [findLargestRefresh, findMiddleRefresh] = [1e6, 1e5].map(refreshOfSize);
  /** @type {[string, '≤' | '≥', number, string, Record<string, number[]>][]} */
  const speedTargets = [
    ['Refresh of 1 000 000 poses', '≤', FRAME_MS, 'ms', valuesByRuntime((timings) => findLargestRefresh(timings).core)],
    ['Refresh of 100 000 poses', '≤', 2, 'ms', valuesByRuntime((timings) => findMiddleRefresh(timings).core)],
    ['JavaScript takes longer, at 1 000 000 poses', '≥', 3, '×', valuesByRuntime((timings) => speedRatios(findLargestRefresh(timings)))],
    ['Calibration of the example log', '≤', 1000, 'ms', valuesByRuntime(({ calibration }) => calibration)],
    ['From script start to first cloud', '≤', 100, 'ms', { Chromium: Object.values(start).at(-1) ?? [] }],
    [`Step of the slowest drag (${slowestDrag.control}), processor ${CPU_SLOWDOWN} times slower`, '≤', FRAME_MS, 'ms', { Chromium: slowestDrag.picture }],
  ];
  const targetRows = speedTargets.map(([targetName, comparison, limit, unit, { Node = [], Chromium = [] }]) => {
    const isReachedByRuntime = [Node, Chromium].filter(({ length }) => length > 0).map((values) => (comparison === '≤' ? computeQuantile(values) <= limit : computeQuantile(values) >= limit));
    const targetVerdict = isReachedByRuntime.every(Boolean) ? 'yes' : !isReachedByRuntime.some(Boolean) ? 'no' : `in ${isReachedByRuntime[0] ? 'Node' : 'Chromium'} alone`;
    return { '': targetName, target: `${comparison} ${limit} ${unit}`, Node: cellTextOf(Node, unit), Chromium: cellTextOf(Chromium, unit), reached: targetVerdict };
  });
  const refreshRows = Object.entries({ Node: node, Chromium: chromium }).flatMap(([where, { refresh }]) => refresh.map((row) => (
    { where, samples: formatDigits(row.samples), 'refresh, ms': cellTextOf(row.core), 'JavaScript, ms': cellTextOf(row.baseline), ratio: cellTextOf(speedRatios(row)) }
  )));
  return [
    `${Object.entries(ranOn).map(([name, value]) => `${name} ${value}`).join('; ')}. Medians, with quartiles in brackets.${quick ? ' A quick run: too few turns to be quoted.' : ''}`,
    markdownTable(targetRows),
    `One event of the slider:\n\n${markdownTable(refreshRows)}`,
    `First cloud, from the start of the script:\n\n${markdownTable(Object.entries(start).map(([until, times]) => ({ until, ms: cellTextOf(times) })))}`,
    `Step of a drag, processor ${CPU_SLOWDOWN} times slower, opening sizes:\n\n${markdownTable(drags.map(({ widget, control, picture, text, steady }) => (
      { widget, dragged: control, 'frame with the picture, ms': cellTextOf(picture), 'text after it, ms': cellTextOf(text), 'between frames, a step in each, ms': cellTextOf(steady) }
    )))}`,
  ].join('\n\n');
}

/** Returns a quantile, by default the median. @param {number[]} values @param {number} [share] */
function computeQuantile(values, share = 0.5) {
  return quantileSorted(values.toSorted((a, b) => a - b), share) ?? NaN;
}

/** Returns the median and the quartiles as text. @param {number[]} values @param {string} [unit] */
function cellTextOf(values, unit = '') {
  const [lowerQuartile, median, upperQuartile] = [0.25, 0.5, 0.75].map((share) => formatDigits(computeQuantile(values, share)));
  return values.length > 0 ? `${`${median} ${unit}`.trim()} [${lowerQuartile} to ${upperQuartile}]` : '';
}

/** Rounds to three significant digits. @param {number} value */
const formatDigits = (value) => value.toLocaleString('en', { maximumSignificantDigits: 3 }).replaceAll(',', '\u202f');

/** Returns a table with a column for each key. @param {Record<string, string>[]} rows */
function markdownTable(rows) {
  const columnNames = Object.keys(rows[0]);
  const tableRows = [columnNames, columnNames.map(() => '---'), ...rows.map(Object.values)];
  return tableRows.map((cells) => `| ${cells.join(' | ')} |`).join('\n');
}
