/** Readouts of Dead Reckoning, sentences and text equivalents: chart of predicted over measured variance by step, and table of wrong predictions (misses). */

import { greatest, max } from 'd3-array';
import { html, nothing } from 'lit';
import { addEnglishMessages, words } from '../../messages/registry.ts';
import { formatMarkup } from '../../ui/controls.ts';
import { NO_VALUE, formatInteger, formatFixed, formatWithError, formatSignificant } from '../../ui/format.ts';
import { plotHtml, type ColourRole } from '../../ui/plot.ts';
import { tableHtml, readoutsHtml } from '../../ui/readouts.ts';
import { sampleFieldHtml } from '../shared/cloud.ts';
import { en } from './en.ts';
import { COMPONENTS, CURVE_STYLES, RECURSIONS, type ViewModel } from './settings.ts';
import type { Misses } from '../../types.d.ts';

addEnglishMessages({ reckoning: en });

/** Steps at which the caption gives the ratio of the worst component. */
const CAPTION_STEPS = [1, 2, 5];

/** Prints a fraction in per cent, with a sign unless it rounds to 0. */
function formatSignedPercent(share: number, printedPercent: string = formatFixed(100 * share, 1)) {
  if (Number.isNaN(share)) return NO_VALUE;
  return `${100 * share >= 0.05 ? '+' : ''}${printedPercent}\u202f%`;
}

/** Returns the relative error of the predicted variance after the last step, as text. */
const formatFinalError = ({ end, error }: { end: number, error: number }) => formatSignedPercent(end, formatWithError(100 * end, 100 * error, 1));

/** Returns a caption that says how well the recursion predicts the components that are shown. */
export function captionOf({ config: { compounding }, stats: { misses, n }, condition, curves }: ViewModel, overlays: string[]) {
  const texts = words.reckoning;
  if (condition !== 'certain') return texts.conditions[condition];
  const recursionMisses = misses[compounding];
  if (recursionMisses.every(({ first }) => first === null)) return texts.right(formatInteger(n));
  // `endAxis` has the ratio furthest from 1 at the end, and `worstAxis` the ratio furthest from 1 at any step.
  const endAxis = worstAxisOf(overlays, (axis) => Math.abs(recursionMisses[axis].end));
  const worstAxis = worstAxisOf(overlays, (axis) => max(curves[axis].ratio, (ratio) => Math.abs(ratio - 1)) ?? NaN);
  const ratioList = ratiosAtSteps(Array.from(curves[worstAxis].ratio));
  return texts.wrong(texts.of[COMPONENTS[worstAxis]], ratioList, formatSignedPercent(recursionMisses[endAxis].end), texts.of[COMPONENTS[endAxis]]);
}

/** Returns the index of the shown component whose miss (error of the prediction) is greatest; NaN is not a miss. */
function worstAxisOf(overlays: string[], missOf: (axis: number) => number) {
  const shownAxes = shownComponentsOf(overlays).map((name) => COMPONENTS.indexOf(name));
  return greatest(shownAxes, missOf) ?? shownAxes[0];
}

const ratiosAtSteps = (ratios: number[]) =>
  CAPTION_STEPS.filter((step) => step <= ratios.length).map((step) => `${formatFixed(ratios[step - 1], 2)} (${words.reckoning.atStepMark(step)})`).join(', ');

/** Returns the components whose curves are shown, or all components if no curve is shown. */
function shownComponentsOf(overlays: string[]): readonly (typeof COMPONENTS)[number][] {
  const selectedComponents = COMPONENTS.filter((name) => overlays.includes(name));
  return selectedComponents.length > 0 ? selectedComponents : COMPONENTS;
}

function formatRatio({ config: { step, compounding }, curves }: ViewModel, overlays: string[]) {
  const texts = words.reckoning;
  const ratioTexts = shownComponentsOf(overlays).map((name) => {
    const { ratio, error } = curves[COMPONENTS.indexOf(name)];
    return `${texts.overlays[name]} ${formatWithError(ratio[step - 1], error[step - 1], 2)}`;
  });
  return texts.ratioText(texts.recursions[compounding], String(step), ratioTexts.join(', '));
}

/** Allowed heights of the plot, so that its axis does not change with every step of a drag. */
const CHART_HEIGHTS = [1.2, 1.6, 2, 3, 5, 10];

/** Relative error up to which a predicted variance counts as correct. */
const RATIO_TOLERANCE = 0.05;

/** Returns the chart of predicted over measured variance, whose line at the selected step is a slider. */
export function ratioPlotHtml(figure: import('./dead-reckoning.ts').DeadReckoningElement, viewModel: ViewModel): ReturnType<typeof plotHtml> {
  const { config: { step, steps }, curves } = viewModel;
  const { overlays } = figure.settings.elementState;
  const texts = words.reckoning;
  const x = Array.from({ length: steps }, (_, i) => i + 1);
  const highestRatio = Math.max(...curves.flatMap(({ ratio }) => Array.from(ratio, (value) => value || 0)));
  const shownCurves = COMPONENTS.map((name, axis) => ({ ...curveStyleOf(name, figure.highlight), name, ...curves[axis] })).filter(({ name }) => overlays.includes(name));
  const toleranceBand = { name: texts.overlays.tolerance, ...curveStyleOf('tolerance', figure.highlight), x: [0, steps], y: [1, 1], error: [RATIO_TOLERANCE, RATIO_TOLERANCE], isBandOnly: true };
  return plotHtml({
    label: formatRatio(viewModel, overlays),
    x: { name: texts.stepAxis, min: 0, max: steps },
    y: { name: texts.ratioAxis, min: 0, max: CHART_HEIGHTS.find((height) => height >= highestRatio) ?? highestRatio },
    curves: [
      ...(overlays.includes('tolerance') ? [toleranceBand] : []),
      ...shownCurves.map(({ ratio, ...curve }) => ({ ...curve, x, y: ratio })),
    ],
    points: shownCurves.map(({ role, ratio, error }) => ({ role, x: step, y: ratio[step - 1], error: error[step - 1] })),
    marks: [{ x: step, text: texts.atStepMark(step) }],
    slider: {
      id: 'chart-step',
      name: texts.settings.step.name,
      step: 1,
      value: step,
      text: texts.atStepMark(step),
      onInput: (newStep) => figure.settings.requestChange({ step: Math.max(1, newStep) }),
      onCommit: () => figure.gesture.commit(),
    },
    legend: nothing,
  });
}

/** Returns role, dash and highlight of a curve in the chart of ratios. */
function curveStyleOf(name: keyof typeof CURVE_STYLES, highlight: string | null) {
  const { role, dash } = CURVE_STYLES[name] as import('../../scene/draw.ts').LineStyle & { role: ColourRole };
  const isHighlighted = highlight !== null && highlight in CURVE_STYLES ? name === highlight : undefined;
  return { role, dash: dash?.join(' '), isHighlighted };
}

/** Returns the headline of the figure: the ratio at the selected step that is furthest from 1. */
export function headlineHtml({ config: { step }, curves, shown }: ViewModel, overlays: string[]) {
  const texts = words.reckoning;
  const axis = worstAxisOf(overlays, (i) => Math.abs(curves[i].ratio[step - 1] - 1));
  const error = curves[axis].error[step - 1];
  const headlineDetail = texts.ofMeasured(Number.isNaN(error) ? '' : formatFixed(error, 2), step, formatInteger(shown));
  return readoutsHtml([[texts.predicted(texts.of[COMPONENTS[axis]]), formatFixed(curves[axis].ratio[step - 1], 2), headlineDetail]], 0);
}

/** Ranges of both logarithmic axes: fixed, so that a slider moves the curves and not the axes. */
const GROWTH_AXES = { durations: [0.1, 10], variances: [1e-6, 100] };

export function straightGrowthPlotHtml({ durations: x, along, across, alongFirstOrder, acrossFirstOrder, crossing }: import('../../types.d.ts').StraightGrowth) {
  const texts = words.reckoning.straight;
  const [minDuration, maxDuration] = GROWTH_AXES.durations;
  const [minVariance, maxVariance] = GROWTH_AXES.variances;
  const crossingText = crossing === null ? '' : formatSignificant(crossing, 3);
  return html`<figure>
    <p class="panel-title">${texts.title}</p>
    ${plotHtml({
      label: texts.label(crossing === null ? texts.never : texts.crossing(crossingText)),
      x: { name: 'Δt (s)', min: minDuration, max: maxDuration, isLogarithmic: true },
      y: { name: texts.y, min: minVariance, max: maxVariance, isLogarithmic: true },
      curves: [
        { name: texts.along, role: 'ink', dash: '8 4', x, y: alongFirstOrder },
        { name: texts.across, role: 'prediction', x, y: acrossFirstOrder },
        // One curve with a gap contains both exact curves.
        { name: texts.exact, role: 'truth', dash: '2 3', x: [...x, NaN, ...x], y: [...along, NaN, ...across] },
      ],
      marks: crossing !== null && crossing >= minDuration && crossing <= maxDuration ? [{ x: crossing, text: `${crossingText} s` }] : [],
    })}
    <figcaption>${formatMarkup(texts.caption)}</figcaption>
  </figure>`;
}

/** Returns the range of steps at which a recursion misses the measured variance, as text. */
function formatMissRange({ decidable, first, last, end }: Misses) {
  const { never, unknown, from: formatRange } = words.reckoning.misses;
  if (!decidable) return Number.isNaN(end) ? NO_VALUE : unknown;
  return first === null || last === null ? never : formatRange(first, last);
}

/** Returns the table of the steps at which each recursion misses the measured variance, by component. */
export function missTableHtml({ stats: { misses } }: ViewModel, overlays: string[]) {
  const texts = words.reckoning;
  return tableHtml({
    caption: texts.misses.caption,
    columns: [texts.misses.component, ...RECURSIONS.map((recursion) => texts.recursions[recursion])],
    rows: shownComponentsOf(overlays).flatMap((component) => {
      const missesOfRecursions = RECURSIONS.map((recursion) => misses[recursion][COMPONENTS.indexOf(component)]);
      return [[texts.overlays[component], ...missesOfRecursions.map(formatMissRange)], [texts.misses.endOf(texts.overlays[component]), ...missesOfRecursions.map(formatFinalError)]];
    }),
  });
}

/** Returns the field with the number of the marked robot, and the pose of that robot at the step. */
export function markedRobotFieldHtml(figure: import('./dead-reckoning.ts').DeadReckoningElement, marked: Float64Array | undefined): import('lit').TemplateResult {
  const { config: { step }, shown } = figure.viewModel;
  const [x, y, theta] = Array.from(marked?.subarray(3 * (step - 1), 3 * step) ?? [], (coordinate) => formatFixed(coordinate, 3));
  return sampleFieldHtml(figure, 'robot', shown, marked && `x ${x} m, y ${y} m, θ ${theta} rad`);
}
