/** The Banana Machine's readouts: the statistics of the cloud, the marked robot, and the tables of moments. */

import { html } from 'lit';
import { markedField } from '../../figure/controls.js';
import { words } from '../../messages/registry.js';
import { rich } from '../../ui/controls.js';
import { NOTHING, counted, fixed, percent, powerOfE, significant, withError } from '../../ui/format.js';
import { figureTable, readoutList } from '../../ui/readouts.js';

/**
 * @import { Inspection, Moments, Table } from '../../types.d.ts'
 * @import { Reading } from './reading.js'
 */

/** Share of a Gaussian in the plane inside its 2σ ellipse, 1 − e⁻². */
const NOMINAL = 1 - Math.exp(-2);

/**
 * The three that matter: whether the cloud leans, how much likelier the other coordinates make it, and how much floor the
 * ellipse wastes.
 *
 * @param {Reading} reading
 */
export function readouts({ stats, exactSkew, gain }) {
  const say = words.banana.readouts;
  const { coverage, areaRatio } = stats;
  return readoutList([
    [
      say.skew,
      withError(stats.crossTrackSkew, stats.crossTrackSkewError, 3),
      Number.isNaN(exactSkew) ? NOTHING : say.skewDetail(fixed(exactSkew, 3)),
    ],
    [gain.unbounded ? say.gainOnFloor : say.gain, withError(gain.value, gain.error, 3), gainText(gain)],
    [
      say.area,
      fixed(areaRatio, 2),
      [coverage.ellipse, coverage.exponential].every(Number.isNaN) ? NOTHING : say.areaDetail(percent(coverage.ellipse), percent(coverage.exponential)),
    ],
  ]);
}

/** What the gain means for the whole cloud. @param {Reading['gain']} gain */
function gainText({ n, unbounded, value }) {
  const { unbounded: without, onLine, likelier, unlikelier } = words.banana.readouts;
  if (Number.isNaN(value)) return NOTHING;
  if (value === Infinity) return onLine;
  const [nats, robots] = [counted(n * value), counted(n)];
  if (unbounded) return without(nats, robots);
  return (value < 0 ? unlikelier : likelier)(nats, robots, powerOfE(Math.abs(n * value)));
}

/** The others. @param {Reading} reading */
export function otherReadouts({ config, stats, gain, table }) {
  const say = words.banana.readouts;
  const { nOfAll } = words.banana;
  return readoutList([
    [say.robots, nOfAll(counted(stats.n), counted(config.samples))],
    [say.gaussian, fixed(stats.gaussianSkew, 3)],
    [say.rho, fixed(stats.rhoCrossHeading, 3)],
    [say.exactGain, fixed(gain.exact, 4)],
    [say.exactArea, fixed(table.exact.areaRatio, 3)],
    [say.nominal, percent(NOMINAL)],
  ]);
}

/**
 * The marked robot, with the arc that reaches its place.
 *
 * @param {import('./banana-machine.js').BananaMachineElement} figure
 * @param {Inspection | undefined} inspection of it, if there is one
 * @returns {import('lit').TemplateResult}
 */
export function markedRobot(figure, inspection) {
  const { robot, markHint } = words.banana;
  const { shown } = figure.reading;
  const quantity = (/** @type {string} */ symbol, /** @type {number} */ value, /** @type {string} */ unit) =>
    html`<span><i>${symbol}</i> = ${fixed(value, 3)} ${unit}</span>`;
  const told = inspection && (inspection.legs
    ? legsOf(inspection.legs, /** @type {import('../../types.d.ts').Legs} */ (figure.reading.reading))
    : [
        quantity('v̂', inspection.vHat, 'm/s'),
        quantity('ω̂', inspection.omegaHat, 'rad/s'),
        quantity('γ̂', inspection.gammaHat, 'rad/s'),
      ]);
  return markedField(figure, { id: 'robot', label: robot, hint: markHint, shown, told });
}

/**
 * The noise of each hinge: what was read less what was driven, as Table 5.6 subtracts it.
 *
 * @param {import('../../types.d.ts').Legs} driven
 * @param {import('../../types.d.ts').Legs} read
 */
function legsOf(driven, read) {
  return /** @type {const} */ ([['rot1', 'rad'], ['trans', 'm'], ['rot2', 'rad']]).map(([leg, unit]) => {
    const noise = read[leg] - driven[leg];
    return html`<span><i>ε</i><sub>${leg}</sub> = ${fixed(noise, 3)} ${unit}</span>`;
  });
}

/** Digits of what is computed, as many as the book prints; and of what chance leaves uncertain. */
const DIGITS = 5;
const MEASURED_DIGITS = 3;

/** @param {string} indices */
const sigma = (indices) => html`<i>Σ</i><sub><i>${indices}</i></sub>`;

/** @param {Reading} reading */
export function workedExample({ table: { linearized, exact, measured }, stats }) {
  const computed = [linearized, exact];
  const [skew, ...error] = withError(stats.crossTrackSkew, stats.crossTrackSkewError, 3).split(' ');
  // Two lines, also while there is no error: the row keeps its height.
  const measuredSkew = html`${skew} <br />${error.join(' ') || '\u00a0'}`;
  const say = words.banana.table;
  /** @type {[unknown, (column: Table['exact']) => number, unknown?][]} */
  const rows = [
    [rich(say.mean('*x*')), ({ mean }) => mean[0]],
    [rich(say.mean('*y*')), ({ mean }) => mean[1]],
    [rich(say.mean('*θ*')), ({ mean }) => mean[2]],
    [sigma('xx'), ({ cov }) => cov[0][0]],
    [sigma('yy'), ({ cov }) => cov[1][1]],
    [sigma('xy'), ({ cov }) => cov[0][1]],
    [sigma('xθ'), ({ cov }) => cov[0][2]],
    [sigma('yθ'), ({ cov }) => cov[1][2]],
    [sigma('θθ'), ({ cov }) => cov[2][2]],
    [html`<i>ρ</i><sub><i>yθ</i></sub>`, ({ cov }) => cov[1][2] / Math.sqrt(cov[1][1] * cov[2][2])],
    [say.skew, ({ crossTrackSkew }) => crossTrackSkew, measuredSkew],
  ];
  return figureTable({
    caption: say.caption,
    columns: [say.quantity, say.linearized, say.exact, say.measured],
    rows: rows.map(([name, of, withItsError]) => [
      name,
      ...computed.map((column) => significant(of(column), DIGITS)),
      withItsError ?? significant(of(measured), MEASURED_DIGITS),
    ]),
  });
}

/** @param {Reading} reading */
export function twistTable({ table: { tangent }, stats: { exponential } }) {
  const say = words.banana.table;
  const rows = say.axes.flatMap((axis, i) => /** @type {[string, (moments: Moments) => number][]} */ ([
    [say.mean(axis), ({ mean }) => mean[i]],
    [say.variance(axis), ({ cov }) => cov[i][i]],
  ]));
  return figureTable({
    caption: say.twistCaption,
    columns: [say.quantity, say.command, say.measured],
    rows: rows.map(([name, of]) => [
      rich(name),
      tangent === null ? NOTHING : significant(of(tangent), DIGITS),
      significant(of(exponential), MEASURED_DIGITS),
    ]),
  });
}
