/** The Banana Machine's readouts: the statistics of the cloud, the marked robot, and the tables of moments. */

import { html } from 'lit';
import { sampleField } from '../../figure/controls.ts';
import { words } from '../../messages/registry.ts';
import { formatMarkup } from '../../ui/controls.ts';
import { NO_VALUE, integer, fixed, percent, formatSignificant, formatWithError } from '../../ui/format.ts';
import { figureTable, readoutList } from '../../ui/readouts.ts';
import type { Inspection, Moments } from '../../types.d.ts';
import type { ViewModel } from './view-model.ts';

/** Fraction of a Gaussian in the plane inside its 2σ ellipse, 1 − e⁻². */
const FRACTION_IN_ELLIPSE = 1 - Math.exp(-2);

/**
 * Returns the three main numbers: the area ratio of the ellipse, the gain of exponential coordinates, and the skew of the cloud. The
 * numbers of a pinned cloud are next to them.
 */
export function mainReadouts(viewModel: ViewModel, pinned?: ViewModel) {
  const texts = words.banana.readouts;
  const { stats: { coverage, areaRatioError }, exactSkew, gain } = viewModel;
  const printedValues = printedStatistics(viewModel);
  const pinnedValues = pinned && printedStatistics(pinned).map((value) => `${words.banana.pinned}: ${value}`);
  const coverages = [coverage.ellipse, coverage.exponential];
  return readoutList([
    [texts.area, printedValues[0], coverages.every(Number.isNaN) ? NO_VALUE : texts.areaDetail(Number.isNaN(areaRatioError) ? '' : formatSignificant(areaRatioError, 1), percent(coverages[0]), percent(coverages[1])), pinnedValues?.[0]],
    // A gain on the floor and one of poses are not comparable.
    [gain.unbounded ? texts.gainOnFloor : texts.gain, printedValues[1], gainText(gain), pinned?.gain.unbounded === gain.unbounded ? pinnedValues?.[1] : undefined],
    [texts.skew, printedValues[2], Number.isNaN(exactSkew) ? NO_VALUE : texts.exactly(fixed(exactSkew, 3)), pinnedValues?.[2]],
  ], 0);
}

/** Returns the area ratio, the gain and the skew as they are printed. */
function printedStatistics({ stats, gain }: ViewModel) {
  return [
    Number.isNaN(stats.areaRatio) ? NO_VALUE : `${fixed(stats.areaRatio, 2)} ×`,
    formatWithError(gain.value, gain.error, 3),
    formatWithError(stats.crossTrackSkew, stats.crossTrackSkewError, 3),
  ];
}

/** Returns the exact gain, or the reason why it has no limit. */
function gainText({ unbounded, value, exact, wraps }: ViewModel['gain']) {
  const { withoutLimit, onLine, exactly, unwrapped, nat } = words.banana.readouts;
  if (Number.isNaN(value)) return NO_VALUE;
  if (value === Infinity) return onLine;
  if (unbounded) return withoutLimit;
  if (Number.isNaN(exact)) return nat;
  return wraps ? unwrapped(fixed(exact, 3)) : `${exactly(fixed(exact, 3))}; ${nat}`;
}

export function otherReadouts({ config, stats, table }: ViewModel) {
  const texts = words.banana.readouts;
  const { nOfAll } = words.banana;
  return readoutList([
    [texts.robots, nOfAll(integer(stats.n), integer(config.samples))],
    [texts.gaussian, fixed(stats.gaussianSkew, 3)],
    [texts.rho, fixed(stats.rhoCrossHeading, 3)],
    [texts.exactArea, fixed(table.exact.areaRatio, 3)],
    [texts.nominal, percent(FRACTION_IN_ELLIPSE)],
  ]);
}

/** Returns the field with the number of the marked robot, and the motion of that robot. */
export function markedRobotField(figure: import('./banana-machine.ts').BananaMachineElement, inspection: Inspection | undefined): import('lit').TemplateResult {
  const { shown, reading } = figure.viewModel;
  const quantityHtml = (symbol: string, value: number, unit: string) => html`<span>${formatMarkup(symbol)} = ${fixed(value, 3)} ${unit}</span>`;
  if (!inspection) return sampleField(figure, 'robot', shown, undefined);
  const { legs, vHat, omegaHat, gammaHat } = inspection;
  // The noise of a leg is the reading minus the executed motion, as Table 5.6 subtracts it.
  return sampleField(figure, 'robot', shown, legs && reading
    ? ([['rot1', 'rad'], ['trans', 'm'], ['rot2', 'rad']] as const).map(([leg, unit]) => quantityHtml(`*ε*_{${leg}}`, reading[leg] - legs[leg], unit))
    : [quantityHtml('*v̂*', vHat, 'm/s'), quantityHtml('*ω̂*', omegaHat, 'rad/s'), quantityHtml('*γ̂*', gammaHat, 'rad/s')]);
}

/** Significant digits of computed numbers, as in the book, and of measured numbers. */
const COMPUTED_DIGITS = 5;
const MEASURED_DIGITS = 3;

/** Returns a table of moments, with computed columns and then the measured one. */
function momentsTable<Column>(caption: string, computed: Record<string, Column | null>, measured: Column, rows: [name: unknown, (column: Column) => number][]) {
  const { quantity, measured: measuredName } = words.banana.table;
  return figureTable({
    caption,
    columns: [quantity, ...Object.keys(computed), measuredName],
    rows: rows.map(([name, valueOf]) => [
      name,
      ...Object.values(computed).map((column) => (column === null ? NO_VALUE : formatSignificant(valueOf(column), COMPUTED_DIGITS))),
      formatSignificant(valueOf(measured), MEASURED_DIGITS),
    ]),
  });
}

export function workedExampleTable({ table: { linearized, exact, measured } }: ViewModel) {
  const texts = words.banana.table;
  const symbolOf = (letter: string, indices: string) => html`<i>${letter}</i><sub><i>${indices}</i></sub>`;
  return momentsTable(texts.caption, { [texts.linearized]: linearized, [texts.exact]: exact }, measured, [
    ...['x', 'y', 'θ'].map((axis, i): MomentsRow => [formatMarkup(texts.mean(`*${axis}*`)), ({ mean }) => mean[i]]),
    ...['xx', 'yy', 'xy', 'xθ', 'yθ', 'θθ'].map((pair): MomentsRow => [symbolOf('Σ', pair), ({ cov }) => cov['xyθ'.indexOf(pair[0])]['xyθ'.indexOf(pair[1])]]),
    [symbolOf('ρ', 'yθ'), ({ cov }) => cov[1][2] / Math.sqrt(cov[1][1] * cov[2][2])],
    [words.banana.readouts.skew, ({ crossTrackSkew }) => crossTrackSkew],
  ]);
}

type MomentsRow = [name: unknown, (column: Moments) => number];

export function twistTable({ table: { tangent }, stats: { exponential } }: ViewModel) {
  const texts = words.banana.table;
  return momentsTable<Moments>(texts.twistCaption, { [texts.command]: tangent }, exponential, texts.axes.flatMap((axis, i): MomentsRow[] => [
    [formatMarkup(texts.mean(axis)), ({ mean }) => mean[i]],
    [formatMarkup(texts.variance(axis)), ({ cov }) => cov[i][i]],
  ]));
}
