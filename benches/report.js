/**
 * Results of a run as Markdown.
 *
 * @module
 */

import { THROTTLE } from './drag.js';

/**
 * @typedef {import('./suite.js').Measured} Measured
 * @typedef {import('./timing.js').Quartiles} Quartiles
 *
 * @typedef {object} Results
 * @property {string} date
 * @property {string} commit
 * @property {string} processor
 * @property {number} cores
 * @property {string} nodeVersion
 * @property {string} chromiumVersion
 * @property {string} rustVersion
 * @property {boolean} quick
 * @property {Measured} node
 * @property {Measured} chromium
 * @property {import('./start.js').Start} start
 * @property {import('./drag.js').Drag[]} drags
 */

/** Duration of a frame at 60 Hz, ms. */
const FRAME = 16.7;

/**
 * @param {Results} results
 * @returns {string}
 */
export function report(results) {
  const { node, chromium, start, drags } = results;
  const slowest = drags.reduce((most, drag) => (drag.time.median > most.time.median ? drag : most));
  const refreshOf = (/** @type {number} */ samples) => [node, chromium].map(({ refresh }) => refresh.find((row) => row.samples === samples));
  const million = refreshOf(1e6);
  const atMost = (/** @type {number} */ bound) => (/** @type {number} */ value) => value <= bound;
  const atLeast = (/** @type {number} */ bound) => (/** @type {number} */ value) => value >= bound;
  /** @type {[string, string, (Quartiles | undefined)[], string, (value: number) => boolean][]} */
  const targets = [
    ['Refresh of 1 000 000 poses', '≤ 16.7 ms', million.map((row) => row?.core), 'ms', atMost(FRAME)],
    ['Refresh of 100 000 poses', '≤ 2 ms', refreshOf(1e5).map((row) => row?.core), 'ms', atMost(2)],
    ['JavaScript takes longer, at 1 000 000 poses', '≥ 3 ×', million.map((row) => row?.times), '×', atLeast(3)],
    ['Calibration of the example log', '≤ 1 s', [node.calibration, chromium.calibration], 'ms', atMost(1000)],
    ['From script start to first cloud', '≤ 100 ms', [undefined, start.total], 'ms', atMost(100)],
    [`Step of the slowest drag (${slowest.what}), processor ${THROTTLE} times slower`, '≤ 16.7 ms (a frame)', [undefined, slowest.time], 'ms', atMost(FRAME)],
  ];
  const rows = targets.map(([what, bound, values, unit, reached]) => [what, bound, ...values.map((value) => cell(value, unit)), verdict(values, reached)]);
  return [
    ranOn(results),
    table(['', 'target', 'Node', 'Chromium', 'reached'], rows),
    curve('Node', node),
    curve('Chromium', chromium),
    stages(start),
    dragged(drags),
  ].join('\n\n');
}

/** @param {Results} results */
function ranOn({ date, commit, processor, cores, nodeVersion, chromiumVersion, rustVersion, quick }) {
  return (
    `Measured on ${date.slice(0, 10)} at commit ${commit}, on ${processor} with ${cores} cores; ` +
    `Node ${nodeVersion}, Chromium ${chromiumVersion}, ${rustVersion}. Medians, with quartiles in brackets.` +
    (quick ? ' A quick run: too few turns to be quoted.' : '')
  );
}

/**
 * @param {string} where
 * @param {Measured} measured
 */
function curve(where, { refresh }) {
  const rows = refresh.map(({ samples, core, baseline, times }) => [
    whole(samples), cell(core), digits((core.median / samples) * 1e6), cell(baseline), cell(times),
  ]);
  return `One event of the slider, ${where}:\n\n${table(['samples', 'refresh, ms', 'ns a sample', 'JavaScript, ms', 'ratio'], rows)}`;
}

/** @param {import('./start.js').Start} start */
function stages({ loads, stages: parts }) {
  const rows = parts.map(({ stage, time }) => [stage, cell(time)]);
  return `First cloud, ${loads} loads in Chromium:\n\n${table(['until', 'ms'], rows)}`;
}

/** @param {import('./drag.js').Drag[]} drags */
function dragged(drags) {
  const rows = drags.map(({ widget, what, time, words, steady }) => [widget, what, cell(time), cell(words), cell(steady)]);
  const heads = ['widget', 'dragged', 'frame with the picture, ms', 'words after it, ms', 'between frames, a step in each, ms'];
  return `Step of a drag, processor ${THROTTLE} times slower, opening sizes:\n\n${table(heads, rows)}`;
}

/**
 * @param {(Quartiles | undefined)[]} values in Node and in Chromium; undefined where nothing is measured
 * @param {(value: number) => boolean} reached
 */
function verdict([node, chromium], reached) {
  const verdicts = [node, chromium].flatMap((value) => (value ? [reached(value.median)] : []));
  if (verdicts.every(Boolean)) return 'yes';
  return verdicts.some(Boolean) ? `in ${verdicts[0] ? 'Node' : 'Chromium'} alone` : 'no';
}

/**
 * @param {Quartiles | undefined} value
 * @param {string} [unit]
 */
function cell(value, unit = '') {
  if (value === undefined) return '';
  const suffix = unit === '' ? '' : ` ${unit}`;
  return `${digits(value.median)}${suffix} [${digits(value.lower)} to ${digits(value.upper)}]`;
}

/** Rounds to three significant digits. @param {number} value */
function digits(value) {
  if (Math.abs(value) >= 1000) return whole(Math.round(value));
  return value === 0 ? '0' : String(Number(value.toPrecision(3)));
}

/** @param {number} value */
function whole(value) {
  return value.toLocaleString('en').replaceAll(',', '\u202f');
}

/**
 * @param {string[]} heads
 * @param {string[][]} rows
 */
function table(heads, rows) {
  const line = (/** @type {string[]} */ row) => `| ${row.join(' | ')} |`;
  return [line(heads), line(heads.map(() => '---')), ...rows.map(line)].join('\n');
}
