// Report of the results of a benchmark, as Markdown.

import { quantileSorted } from 'd3-array';
import { CPU_SLOWDOWN } from './drag.js';

/**
 * @typedef {import('./suite.js').Timings} Timings
 *
 * @typedef {object} Results
 * @property {Record<string, string>} machineDescription machine, versions and date
 * @property {boolean} isQuickRun
 * @property {Timings} nodeTimings
 * @property {Timings} chromiumTimings
 * @property {Record<string, number[]>} pageStartTimes ms from the script's start to the end of each stage, for each load of the page
 * @property {import('./drag.js').Drag[]} dragTimings
 */

/** Duration of a frame at 60 Hz, ms. */
const FRAME_MS = 16.7;

/** Returns the report as Markdown. @param {Results} results */
export function formatReport({ machineDescription, isQuickRun, nodeTimings, chromiumTimings, pageStartTimes, dragTimings }) {
  const slowestDrag = dragTimings.reduce((slowestSoFar, dragTiming) => (computeQuantile(dragTiming.pictureTimes) > computeQuantile(slowestSoFar.pictureTimes) ? dragTiming : slowestSoFar));
  const valuesByRuntime = (/** @type {(timings: Timings) => number[]} */ valuesOf) => ({ Node: valuesOf(nodeTimings), Chromium: valuesOf(chromiumTimings) });
  const refreshTimingsOf = (/** @type {number} */ sampleCount) => (/** @type {Timings} */ { refreshTimings }) => refreshTimings.find((refreshRow) => refreshRow.samples === sampleCount) ?? refreshTimings[0];
  const computeSpeedRatios = (/** @type {Timings['refreshTimings'][number]} */ { core: coreTimes, baseline: baselineTimes }) => baselineTimes.map((baselineTime, turnIndex) => baselineTime / coreTimes[turnIndex]);
  const [findLargestRefresh, findMiddleRefresh] = [1e6, 1e5].map(refreshTimingsOf);
  /** @type {[string, '≤' | '≥', number, string, Record<string, number[]>][]} */
  const speedTargets = [
    ['Refresh of 1 000 000 poses', '≤', FRAME_MS, 'ms', valuesByRuntime((runtimeTimings) => findLargestRefresh(runtimeTimings).core)],
    ['Refresh of 100 000 poses', '≤', 2, 'ms', valuesByRuntime((runtimeTimings) => findMiddleRefresh(runtimeTimings).core)],
    ['JavaScript takes longer, at 1 000 000 poses', '≥', 3, '×', valuesByRuntime((runtimeTimings) => computeSpeedRatios(findLargestRefresh(runtimeTimings)))],
    ['Calibration of the example log', '≤', 1000, 'ms', valuesByRuntime(({ calibrationTimes }) => calibrationTimes)],
    ['From script start to first cloud', '≤', 100, 'ms', { Chromium: Object.values(pageStartTimes).at(-1) ?? [] }],
    [`Step of the slowest drag (${slowestDrag.controlName}), processor ${CPU_SLOWDOWN} times slower`, '≤', FRAME_MS, 'ms', { Chromium: slowestDrag.pictureTimes }],
  ];
  const targetRows = speedTargets.map(([targetName, comparisonSign, targetLimit, targetUnit, { Node = [], Chromium = [] }]) => {
    const targetResults = [Node, Chromium].filter(({ length }) => length > 0).map((measuredValues) => (comparisonSign === '≤' ? computeQuantile(measuredValues) <= targetLimit : computeQuantile(measuredValues) >= targetLimit));
    const targetVerdict = targetResults.every(Boolean) ? 'yes' : !targetResults.some(Boolean) ? 'no' : `in ${targetResults[0] ? 'Node' : 'Chromium'} alone`;
    return { '': targetName, target: `${comparisonSign} ${targetLimit} ${targetUnit}`, Node: cellTextOf(Node, targetUnit), Chromium: cellTextOf(Chromium, targetUnit), reached: targetVerdict };
  });
  const refreshRows = Object.entries({ Node: nodeTimings, Chromium: chromiumTimings }).flatMap(([runtimeName, { refreshTimings }]) => refreshTimings.map((refreshRow) => (
    { where: runtimeName, samples: formatDigits(refreshRow.samples), 'refresh, ms': cellTextOf(refreshRow.core), 'JavaScript, ms': cellTextOf(refreshRow.baseline), ratio: cellTextOf(computeSpeedRatios(refreshRow)) }
  )));
  return [
    `${Object.entries(machineDescription).map(([versionKey, partVersion]) => `${versionKey} ${partVersion}`).join('; ')}. Medians, with quartiles in brackets.${isQuickRun ? ' A quick run: too few rounds to be quoted.' : ''}`,
    formatMarkdownTable(targetRows),
    `One event of the slider:\n\n${formatMarkdownTable(refreshRows)}`,
    `First cloud, from the start of the script:\n\n${formatMarkdownTable(Object.entries(pageStartTimes).map(([stageName, stageTimes]) => ({ until: stageName, ms: cellTextOf(stageTimes) })))}`,
    `Step of a drag, processor ${CPU_SLOWDOWN} times slower, opening sizes:\n\n${formatMarkdownTable(dragTimings.map(({ widgetTag, controlName, pictureTimes, textTimes, frameTimes }) => (
      { widget: widgetTag, dragged: controlName, 'frame with the picture, ms': cellTextOf(pictureTimes), 'text after it, ms': cellTextOf(textTimes), 'between frames, a step in each, ms': cellTextOf(frameTimes) }
    )))}`,
  ].join('\n\n');
}

/** Returns a quantile of the values, by default the median. @param {number[]} sortableValues @param {number} [quantileLevel] */
function computeQuantile(sortableValues, quantileLevel = 0.5) {
  return quantileSorted(sortableValues.toSorted((a, b) => a - b), quantileLevel) ?? NaN;
}

/** Returns the median and the quartiles as text. @param {number[]} measuredValues @param {string} [unitText] */
function cellTextOf(measuredValues, unitText = '') {
  const [lowerQuartile, median, upperQuartile] = [0.25, 0.5, 0.75].map((quantileLevel) => formatDigits(computeQuantile(measuredValues, quantileLevel)));
  return measuredValues.length > 0 ? `${`${median} ${unitText}`.trim()} [${lowerQuartile} to ${upperQuartile}]` : '';
}

/** Rounds a number to three significant digits. @param {number} unroundedValue */
const formatDigits = (unroundedValue) => unroundedValue.toLocaleString('en', { maximumSignificantDigits: 3 }).replaceAll(',', '\u202f');

/** Returns a Markdown table with a column for each key of the rows. @param {Record<string, string>[]} rowObjects */
function formatMarkdownTable(rowObjects) {
  const columnNames = Object.keys(rowObjects[0]);
  const tableRows = [columnNames, columnNames.map(() => '---'), ...rowObjects.map(Object.values)];
  return tableRows.map((rowCells) => `| ${rowCells.join(' | ')} |`).join('\n');
}
