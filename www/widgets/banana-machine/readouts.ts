/** The Banana Machine's readouts: the statistics of the cloud, the marked robot, and the tables of moments. */

import { html } from 'lit';
import { sampleField } from '../../figure/controls.ts';
import { words } from '../../messages/registry.ts';
import { formatMarkup } from '../../ui/controls.ts';
import { NO_VALUE, integer, fixed, percent, formatSignificant, formatWithError } from '../../ui/format.ts';
import { figureTable, readoutList } from '../../ui/readouts.ts';
import type { Inspection, Moments, Table } from '../../types.d.ts';
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
  const { robot, markHint } = words.banana;
  const { shown } = figure.viewModel;
  const quantityHtml = (symbol: string, value: number, unit: string) =>
    html`<span><i>${symbol}</i> = ${fixed(value, 3)} ${unit}</span>`;
  const selectedHtml = inspection && (inspection.legs
    ? legNoiseHtml(inspection.legs, figure.viewModel.reading as import('../../types.d.ts').OdomDelta)
    : [
        quantityHtml('v̂', inspection.vHat, 'm/s'),
        quantityHtml('ω̂', inspection.omegaHat, 'rad/s'),
        quantityHtml('γ̂', inspection.gammaHat, 'rad/s'),
      ]);
  return sampleField(figure, { id: 'robot', label: robot, hint: markHint, shown, selected: selectedHtml });
}

/** Returns the noise of each leg: the reading minus the executed motion, as Table 5.6 subtracts it. */
function legNoiseHtml(executedLegs: import('../../types.d.ts').OdomDelta, odometryReading: import('../../types.d.ts').OdomDelta) {
  return ([['rot1', 'rad'], ['trans', 'm'], ['rot2', 'rad']] as const).map(([leg, unit]) => {
    const noise = odometryReading[leg] - executedLegs[leg];
    return html`<span><i>ε</i><sub>${leg}</sub> = ${fixed(noise, 3)} ${unit}</span>`;
  });
}

/** Significant digits of computed numbers, as in the book, and of measured numbers. */
const COMPUTED_DIGITS = 5;
const MEASURED_DIGITS = 3;

const covarianceNameHtml = (indices: string) => html`<i>Σ</i><sub><i>${indices}</i></sub>`;

export function workedExampleTable({ table: { linearized, exact, measured }, stats }: ViewModel) {
  const computedColumns = [linearized, exact];
  const [skew, ...errorWords] = formatWithError(stats.crossTrackSkew, stats.crossTrackSkewError, 3).split(' ');
  // Two lines, also without an error, so that the row keeps its height.
  const measuredSkew = html`${skew} <br />${errorWords.join(' ') || '\u00a0'}`;
  const texts = words.banana.table;
  const exampleRows: [unknown, (column: Table['exact']) => number, unknown?][] = [
    [formatMarkup(texts.mean('*x*')), ({ mean }) => mean[0]],
    [formatMarkup(texts.mean('*y*')), ({ mean }) => mean[1]],
    [formatMarkup(texts.mean('*θ*')), ({ mean }) => mean[2]],
    [covarianceNameHtml('xx'), ({ cov }) => cov[0][0]],
    [covarianceNameHtml('yy'), ({ cov }) => cov[1][1]],
    [covarianceNameHtml('xy'), ({ cov }) => cov[0][1]],
    [covarianceNameHtml('xθ'), ({ cov }) => cov[0][2]],
    [covarianceNameHtml('yθ'), ({ cov }) => cov[1][2]],
    [covarianceNameHtml('θθ'), ({ cov }) => cov[2][2]],
    [html`<i>ρ</i><sub><i>yθ</i></sub>`, ({ cov }) => cov[1][2] / Math.sqrt(cov[1][1] * cov[2][2])],
    [words.banana.readouts.skew, ({ crossTrackSkew }) => crossTrackSkew, measuredSkew],
  ];
  return figureTable({
    caption: texts.caption,
    columns: [texts.quantity, texts.linearized, texts.exact, texts.measured],
    rows: exampleRows.map(([name, valueOf, withItsError]) => [
      name,
      ...computedColumns.map((column) => formatSignificant(valueOf(column), COMPUTED_DIGITS)),
      withItsError ?? formatSignificant(valueOf(measured), MEASURED_DIGITS),
    ]),
  });
}

export function twistTable({ table: { tangent }, stats: { exponential } }: ViewModel) {
  const texts = words.banana.table;
  const twistRows = texts.axes.flatMap((axis, i) => [
    [texts.mean(axis), ({ mean }) => mean[i]],
    [texts.variance(axis), ({ cov }) => cov[i][i]],
  ] as [string, (moments: Moments) => number][]);
  return figureTable({
    caption: texts.twistCaption,
    columns: [texts.quantity, texts.command, texts.measured],
    rows: twistRows.map(([name, valueOf]) => [
      formatMarkup(name),
      tangent === null ? NO_VALUE : formatSignificant(valueOf(tangent), COMPUTED_DIGITS),
      formatSignificant(valueOf(exponential), MEASURED_DIGITS),
    ]),
  });
}
