/**
 * The results of a run as Markdown.
 *
 * @module
 */

import { THROTTLE } from './drag.js';
import { SMALLEST_OBJECT } from './memory.js';
import { REST, shareOfLimit } from './roofline.js';

/**
 * @typedef {import('./suite.js').Measured} Measured
 * @typedef {import('./timing.js').Spread} Spread
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
 * @property {number} seconds
 * @property {Measured} node
 * @property {Measured} chromium
 * @property {import('./start.js').Start} start
 * @property {import('./drag.js').Drag[]} drags
 */

/**
 * @typedef {object} Target
 * @property {string} what
 * @property {string} bound as words
 * @property {(value: number) => boolean} reached
 * @property {string} unit
 * @property {(measured: Measured) => Spread | number | undefined} of undefined where a quick run leaves it out
 */

const atMost = (/** @type {number} */ bound) => (/** @type {number} */ value) => value <= bound;
const atLeast = (/** @type {number} */ bound) => (/** @type {number} */ value) => value >= bound;
const refreshOf = (/** @type {number} */ samples) => (/** @type {Measured} */ { refresh }) => refresh.find((row) => row.samples === samples);
/** The baselines where they run with the most samples. */
const raced = (/** @type {Measured} */ { refresh }) => refresh.findLast((row) => row.typed !== undefined);
/** Cost with the most walls over that with the fewest. */
const wallGrowth = (/** @type {import('./squeeze.js').Walls[]} */ rows) => rows[rows.length - 1].time.median / rows[0].time.median;
/** log 10 000 / log 10: what a cost that is logarithmic in the walls, from nothing, grows by. */
const LOGARITHMIC = 4;
/** Of a screen with 60 frames a second, ms. */
const FRAME = 16.7;

/** @type {Target[]} */
const TARGETS = [
  { what: 'Refresh of 1 000 000 poses', bound: '≤ 16.7 ms', reached: atMost(16.7), unit: 'ms', of: (m) => refreshOf(1e6)(m)?.core },
  { what: 'Refresh of 100 000 poses', bound: '≤ 2 ms', reached: atMost(2), unit: 'ms', of: (m) => refreshOf(1e5)(m)?.core },
  { what: 'Faster than the obvious JavaScript', bound: '≥ 40 ×', reached: atLeast(40), unit: '×', of: (m) => raced(m)?.overObvious },
  { what: 'Faster than the best JavaScript we could write', bound: '≥ 3 ×', reached: atLeast(3), unit: '×', of: (m) => raced(m)?.overTyped },
  { what: 'New seed of 100 000 poses', bound: '≤ 4 ms', reached: atMost(4), unit: 'ms', of: (m) => m.seed.seed },
  { what: '100 000 conditioned samples in the apartment', bound: '≤ 15 ms', reached: atMost(15), unit: 'ms', of: (m) => m.squeeze.squeeze },
  {
    what: 'Their cost with 10 000 walls over that with 10, in a growing building',
    bound: `≤ ${LOGARITHMIC} × (logarithmic)`, reached: atMost(LOGARITHMIC), unit: '×', of: (m) => wallGrowth(m.walls.growing),
  },
  {
    what: 'The same in one apartment of ever shorter walls',
    bound: `≤ ${LOGARITHMIC} × (logarithmic)`, reached: atMost(LOGARITHMIC), unit: '×', of: (m) => wallGrowth(m.walls.divided),
  },
  { what: '50 000 rollouts of 20 steps, with their moments', bound: '≤ 100 ms', reached: atMost(100), unit: 'ms', of: (m) => m.reckoning.few },
  { what: '50 000 rollouts of 200 steps', bound: '≤ 1 s', reached: atMost(1000), unit: 'ms', of: (m) => m.reckoning.many },
  { what: 'Memory of a pose', bound: '≤ 40 bytes', reached: atMost(40), unit: 'bytes', of: (m) => m.memory.bytesPerPose },
  { what: 'Growth of the module’s memory over all events', bound: '0 bytes', reached: atMost(0), unit: 'bytes', of: (m) => m.memory.coreGrowth },
  {
    what: 'Growth of the JavaScript heap, an event', bound: `< ${SMALLEST_OBJECT} bytes (the smallest object)`,
    reached: (value) => value < SMALLEST_OBJECT, unit: 'bytes', of: (m) => m.memory.heapGrowth / m.memory.events,
  },
];

/**
 * @param {Results} results
 * @returns {string}
 */
export function report(results) {
  const { node, chromium, start, drags } = results;
  const slowest = drags.reduce((most, drag) => (drag.time.median > most.time.median ? drag : most));
  const rows = TARGETS.map(({ what, bound, reached, unit, of }) => {
    const values = [node, chromium].map((measured) => of(measured));
    return [what, bound, ...values.map((value) => cell(value, unit)), verdict(values, reached)];
  });
  rows.splice(8, 0, ['From script start to first cloud', '≤ 100 ms', '', cell(start.total, 'ms'), verdict([start.total], atMost(100))]);
  rows.splice(9, 0, [
    `A step of the slowest drag (${slowest.what}), processor ${THROTTLE} times slower`, `≤ ${FRAME} ms (a frame)`, '', cell(slowest.time, 'ms'), verdict([slowest.time], atMost(FRAME)),
  ]);
  return [
    ranOn(results),
    table(['', 'target', 'Node', 'Chromium', 'reached'], rows),
    curve('Node', node),
    curve('Chromium', chromium),
    walls(node, chromium),
    roofline('Node', node),
    roofline('Chromium', chromium),
    stages(start),
    dragged(drags),
  ].join('\n\n');
}

/** @param {Results} results */
function ranOn({ date, commit, processor, cores, nodeVersion, chromiumVersion, rustVersion, quick, node }) {
  return (
    `Measured on ${date.slice(0, 10)} at commit ${commit}, on ${processor} with ${cores} cores; ` +
    `Node ${nodeVersion}, Chromium ${chromiumVersion}, ${rustVersion}. Medians, quartiles in brackets; ratios turn by turn, ` +
    `at ${whole(raced(node)?.samples ?? 0)} samples; memory over ${whole(node.memory.events)} events.` +
    (quick ? ' A quick run: too few turns to be quoted.' : '')
  );
}

/**
 * @param {string} where
 * @param {Measured} measured
 */
function curve(where, { refresh }) {
  const put = refresh.some((row) => row.put);
  const heads = ['samples', 'refresh, ms', 'of that all but the picture, ms', 'the same, ns a sample'];
  if (put) heads.push('then putImageData, ms');
  heads.push('best JavaScript, ms', 'ratio', 'obvious JavaScript, ms', 'ratio');
  const rows = refresh.map(({ samples, core, figures, ...row }) => [
    whole(samples), cell(core), cell(figures), digits((figures.median / samples) * 1e6),
    ...(put ? [cell(row.put)] : []),
    cell(row.typed), cell(row.overTyped), cell(row.obvious), cell(row.overObvious),
  ]);
  return `One event of the slider, ${where}:\n\n${table(heads, rows)}`;
}

/**
 * @param {Measured} node
 * @param {Measured} chromium
 */
function walls(node, chromium) {
  const perSample = (/** @type {Measured} */ { walls: { samples } }, /** @type {import('./squeeze.js').Walls} */ { time }) =>
    cell({ ...time, median: time.median / samples, lower: time.lower / samples, upper: time.upper / samples }, '', 1e6);
  const rows = node.walls.growing.map((row, i) => [
    whole(row.walls),
    ...(/** @type {const} */ (['growing', 'divided'])).flatMap((kind) =>
      [node, chromium].map((measured) => perSample(measured, measured.walls[kind][i])),
    ),
  ]);
  const heads = ['walls', 'growing, Node', 'growing, Chromium', 'divided, Node', 'divided, Chromium'];
  return `A conditioned sample, both verdicts, ns:\n\n${table(heads, rows)}`;
}

/**
 * @param {string} where
 * @param {Measured} measured
 */
function roofline(where, { roofline: { limits, roofs } }) {
  const heads = ['a sample', 'operations', 'divisions, roots', 'ns at the arithmetic’s limit', 'ns at that of memory', 'measured, ns', 'share of the limit'];
  const rows = roofs.map((roof) => [
    roof.what, digits(roof.operations.arithmetic), digits(roof.operations.divisions), digits(roof.arithmetic), digits(roof.memory), cell(roof.measured),
    `${digits(100 * shareOfLimit(roof))} %`,
  ]);
  const { arithmetic, divisions, reading } = limits;
  const others = roofs.map(({ what, operations, arithmetic, rest, measured }) => {
    const sum = REST.reduce((ns, kind) => ns + rest[kind], arithmetic);
    const cells = REST.map((kind) => `${digits(operations[kind])}: ${digits(rest[kind])}`);
    return [what, digits(arithmetic), ...cells, digits(operations.branches), digits(sum), `${digits((100 * sum) / measured.median)} %`];
  });
  const headsOfOthers = ['a sample', 'arithmetic, ns', 'choices: ns', 'loads and stores: ns', 'whole numbers: ns', 'branches', 'one after the other, ns', 'of what was measured'];
  return (
    `The machine’s own limits, ${where}: ${digits(1 / arithmetic)} operations of two lanes a ns, a division in ${digits(divisions)} ns, ` +
    `${digits(1 / reading)} bytes a ns:\n\n${table(heads, rows)}\n\n` +
    `All that a sample does, each kind at its own limit (choices ${digits(1 / limits.choices)}, loads ${digits(1 / limits.memory)}, ` +
    `whole numbers ${digits(1 / limits.whole)} a ns):\n\n${table(headsOfOthers, others)}`
  );
}

/** @param {import('./start.js').Start} start */
function stages({ loads, stages: parts }) {
  const rows = parts.map(({ stage, time }) => [stage, cell(time)]);
  return `To the first cloud, ${loads} loads in Chromium:\n\n${table(['until', 'ms'], rows)}`;
}

/** @param {import('./drag.js').Drag[]} drags */
function dragged(drags) {
  const rows = drags.map(({ widget, what, time, words, steady }) => [widget, what, cell(time), cell(words), cell(steady)]);
  const head = ['widget', 'dragged', 'the frame with the picture, ms', 'the words after it', 'from frame to frame, a step in each'];
  return `A step of a drag, processor ${THROTTLE} times slower, opening sizes:\n\n${table(head, rows)}`;
}

/**
 * @param {(Spread | number | undefined)[]} values
 * @param {(value: number) => boolean} reached
 */
function verdict(values, reached) {
  const verdicts = values.filter((value) => value !== undefined).map((value) => reached(typeof value === 'number' ? value : value.median));
  if (verdicts.every(Boolean)) return 'yes';
  return verdicts.some(Boolean) ? `in ${verdicts[0] ? 'Node' : 'Chromium'} alone` : 'no';
}

/**
 * @param {Spread | number | undefined} value
 * @param {string} [unit]
 * @param {number} [scale]
 */
function cell(value, unit = '', scale = 1) {
  if (value === undefined) return '';
  const suffix = unit === '' ? '' : ` ${unit}`;
  if (typeof value === 'number') return digits(value * scale) + suffix;
  const [median, lower, upper] = [value.median, value.lower, value.upper].map((number) => digits(number * scale));
  return `${median}${suffix} [${lower} to ${upper}]`;
}

/**
 * Three digits are all that a measurement has.
 *
 * @param {number} value
 */
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
  const all = [heads, ...rows];
  const widths = heads.map((_, i) => Math.max(3, ...all.map((row) => row[i].length)));
  const line = (/** @type {string[]} */ row) => `| ${row.map((text, i) => text.padEnd(widths[i])).join(' | ')} |`;
  return [line(heads), line(widths.map((width) => '-'.repeat(width))), ...rows.map(line)].join('\n');
}
