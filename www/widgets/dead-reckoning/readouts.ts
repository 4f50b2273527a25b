/** Readouts of Dead Reckoning and their text alternatives: chart of predicted over measured variance by step, and table of steps with wrong predictions (misses). */

import { greatest, max } from 'd3-array';
import { html, nothing } from 'lit';
import { addEnglishMessages, words } from '../../messages/registry.ts';
import { formatMarkup } from '../../ui/controls.ts';
import { NO_VALUE, formatInteger, formatFixed, formatWithError, formatSignificant } from '../../ui/format.ts';
import { plotHtml } from '../../ui/plot.ts';
import { tableHtml, readoutsHtml } from '../../ui/readouts.ts';
import { en } from './en.ts';
import { TWIST_COMPONENTS, CURVE_STYLES, RECURSIONS, type ViewModel } from './settings.ts';
import type { Misses } from '../../types.d.ts';

addEnglishMessages({ reckoning: en });

/** Steps for which the caption states the ratio of predicted to measured variance of the worst component. */
const CAPTION_STEPS = [1, 2, 5];

/** Prints a fraction in per cent, with a sign unless it rounds to 0. */
function formatSignedPercent(fraction: number, printedPercent: string = formatFixed(100 * fraction, 1)) {
  if (Number.isNaN(fraction)) return NO_VALUE;
  return `${100 * fraction >= 0.05 ? '+' : ''}${printedPercent}\u202f%`;
}

/** Returns the relative error of the predicted variance after the last step, as text. */
const formatFinalError = ({ end, error }: { end: number, error: number }) => formatSignedPercent(end, formatWithError(100 * end, 100 * error, 1));

/** Returns a caption that says how well the recursion predicts the variances of the visible components. */
export function captionOf({ config: { compounding }, stats: { misses, n }, ratioCondition, curves }: ViewModel, overlays: string[]) {
  const texts = words.reckoning;
  if (ratioCondition !== 'certain') return texts.conditions[ratioCondition];
  const recursionMisses = misses[compounding];
  if (recursionMisses.every(({ first }) => first === null)) return texts.correctPrediction(formatInteger(n));
  // `endComponentIndex` is the component whose ratio is furthest from 1 at the last step. `worstIndex` is the component whose ratio is furthest from 1 at any step.
  const endComponentIndex = worstComponentIndexOf(overlays, (componentIndex) => Math.abs(recursionMisses[componentIndex].end));
  const worstIndex = worstComponentIndexOf(overlays, (componentIndex) => max(curves[componentIndex].ratio, (varianceRatio) => Math.abs(varianceRatio - 1)) ?? NaN);
  const ratioList = formatRatiosAtSteps(Array.from(curves[worstIndex].ratio));
  return texts.wrongPrediction(texts.componentAdjectives[TWIST_COMPONENTS[worstIndex]], ratioList, formatSignedPercent(recursionMisses[endComponentIndex].end), texts.componentAdjectives[TWIST_COMPONENTS[endComponentIndex]]);
}

/** Returns the index of the visible component with the greatest miss (error of the predicted variance). A miss of NaN does not count. */
function worstComponentIndexOf(overlays: string[], missOf: (componentIndex: number) => number) {
  const shownIndices = shownComponentsOf(overlays).map((name) => TWIST_COMPONENTS.indexOf(name));
  return greatest(shownIndices, missOf) ?? shownIndices[0];
}

const formatRatiosAtSteps = (ratiosByStep: number[]) =>
  CAPTION_STEPS.filter((captionStep) => captionStep <= ratiosByStep.length).map((captionStep) => `${formatFixed(ratiosByStep[captionStep - 1], 2)} (${words.reckoning.stepMark(captionStep)})`).join(', ');

/** Returns the components whose curves are shown, or all components if no curve is shown. */
function shownComponentsOf(overlays: string[]): readonly (typeof TWIST_COMPONENTS)[number][] {
  const selectedComponents = TWIST_COMPONENTS.filter((name) => overlays.includes(name));
  return selectedComponents.length > 0 ? selectedComponents : TWIST_COMPONENTS;
}

function describeRatios({ config: { step, compounding }, curves }: ViewModel, overlays: string[]) {
  const texts = words.reckoning;
  const ratioTexts = shownComponentsOf(overlays).map((name) => {
    const { ratio, error } = curves[TWIST_COMPONENTS.indexOf(name)];
    return `${texts.overlays[name]} ${formatWithError(ratio[step - 1], error[step - 1], 2)}`;
  });
  return texts.chartDescription(texts.recursions[compounding], String(step), ratioTexts.join(', '));
}

/** Values that the maximum of the ratio axis can have. They are few, so that the axis seldom changes during a drag. */
const CHART_MAXIMA = [1.2, 1.6, 2, 3, 5, 10];

/** Maximum relative error with which a predicted variance counts as correct. */
const RATIO_TOLERANCE = 0.05;

/** Returns the chart of predicted over measured variance. The line at the selected step is a slider. */
export function ratioPlotHtml(figure: import('./dead-reckoning.ts').DeadReckoningElement, viewModel: ViewModel): ReturnType<typeof plotHtml> {
  const { config: { step, steps }, curves } = viewModel;
  const { overlays } = figure.settings.elementState;
  const texts = words.reckoning;
  const stepNumbers = Array.from({ length: steps }, (_, i) => i + 1);
  const highestRatio = Math.max(...curves.flatMap(({ ratio }) => Array.from(ratio, (ratio) => ratio || 0)));
  const shownCurves = TWIST_COMPONENTS.map((name, componentIndex) => ({ ...curveStyleOf(name, figure.highlight), name, ...curves[componentIndex] })).filter(({ name }) => overlays.includes(name));
  const toleranceBand = { name: texts.overlays.tolerance, ...curveStyleOf('tolerance', figure.highlight), x: [0, steps], y: [1, 1], errors: [RATIO_TOLERANCE, RATIO_TOLERANCE], isBandOnly: true };
  return plotHtml({
    plotLabel: describeRatios(viewModel, overlays),
    x: { axisLabel: texts.stepAxisLabel, min: 0, max: steps },
    y: { axisLabel: texts.ratioAxisLabel, min: 0, max: CHART_MAXIMA.find((maxRatio) => maxRatio >= highestRatio) ?? highestRatio },
    plotCurves: [
      ...(overlays.includes('tolerance') ? [toleranceBand] : []),
      ...shownCurves.map(({ ratio, error, ...curve }) => ({ ...curve, x: stepNumbers, y: ratio, errors: error })),
    ],
    dataPoints: shownCurves.map(({ colourRole, ratio, error }) => ({ colourRole, x: step, y: ratio[step - 1], error: error[step - 1] })),
    verticalMarks: [{ x: step, text: texts.stepMark(step) }],
    slider: {
      id: 'chart-step',
      name: texts.settings.step.name,
      step: 1,
      value: step,
      valueText: texts.stepMark(step),
      onInput: (newStep) => figure.settings.requestChange({ step: Math.max(1, newStep) }),
      onCommit: () => figure.gesture.commitChange(),
    },
    legendContent: nothing,
  });
}

/** Returns the colour role, the dash and the highlight of a curve in the chart of predicted over measured variance. */
function curveStyleOf(name: keyof typeof CURVE_STYLES, highlight: string | null) {
  const { colourRole, dash } = CURVE_STYLES[name] as import('../../ui/theme.ts').LineStyle;
  const isHighlighted = highlight !== null && highlight in CURVE_STYLES ? name === highlight : undefined;
  return { colourRole, dash, isHighlighted };
}

/** Returns the headline of the figure: of the ratios at the selected step, the one that is furthest from 1. */
export function headlineHtml({ config: { step }, curves, shown }: ViewModel, overlays: string[]) {
  const texts = words.reckoning;
  const componentIndex = worstComponentIndexOf(overlays, (i) => Math.abs(curves[i].ratio[step - 1] - 1));
  const ratioError = curves[componentIndex].error[step - 1];
  const headlineDetail = texts.afterRatio(Number.isNaN(ratioError) ? '' : formatFixed(ratioError, 2), step, formatInteger(shown));
  return readoutsHtml([[texts.beforeRatio(texts.componentAdjectives[TWIST_COMPONENTS[componentIndex]]), formatFixed(curves[componentIndex].ratio[step - 1], 2), headlineDetail]], 0);
}

/** Fixed ranges of the two logarithmic axes. A slider then moves only the curves, and not the axes. */
const GROWTH_AXIS_RANGES = { durations: [0.1, 10], variances: [1e-6, 100] };

export function straightGrowthPlotHtml({ durations: x, along, across, alongFirstOrder, acrossFirstOrder, crossing }: import('../../types.d.ts').StraightGrowth) {
  const texts = words.reckoning.straightDrive;
  const [minDuration, maxDuration] = GROWTH_AXIS_RANGES.durations;
  const [minVariance, maxVariance] = GROWTH_AXIS_RANGES.variances;
  const crossingText = crossing === null ? '' : formatSignificant(crossing, 3);
  return html`<figure>
    <p class="panel-title">${texts.title}</p>
    ${plotHtml({
      plotLabel: `${texts.title}${crossingText && `: ${crossingText} s`}`,
      x: { axisLabel: 'Δt (s)', min: minDuration, max: maxDuration, isLogarithmic: true },
      y: { axisLabel: texts.varianceAxisLabel, min: minVariance, max: maxVariance, isLogarithmic: true },
      plotCurves: [
        { name: texts.alongCurve, colourRole: 'ink', dash: [8, 4], x, y: alongFirstOrder },
        { name: texts.acrossCurve, colourRole: 'prediction', x, y: acrossFirstOrder },
        // The exact curves along and across the track are drawn as one curve with a gap, so that the legend lists them once.
        { name: texts.exactCurves, colourRole: 'truth', dash: [2, 3], x: [...x, NaN, ...x], y: [...along, NaN, ...across] },
      ],
      verticalMarks: crossing !== null && crossing >= minDuration && crossing <= maxDuration ? [{ x: crossing, text: `${crossingText} s` }] : [],
    })}
    <figcaption>${formatMarkup(texts.caption)}</figcaption>
  </figure>`;
}

/** Returns as text the range of steps at which a recursion's variance differs too much from the measured variance. */
function formatMissRange({ decidable, first, last, end }: Misses) {
  const { noMiss, tooFewRobots, stepRange } = words.reckoning.missTable;
  if (!decidable) return Number.isNaN(end) ? NO_VALUE : tooFewRobots;
  return first === null || last === null ? noMiss : stepRange(first, last);
}

/** Returns a table of the steps at which the variance of each recursion differs too much from the measured variance, by component. */
export function missTableHtml({ stats: { misses } }: ViewModel, overlays: string[]) {
  const texts = words.reckoning;
  return tableHtml({
    caption: texts.missTable.caption,
    columnHeadings: [texts.missTable.componentHeader, ...RECURSIONS.map((recursion) => texts.recursions[recursion])],
    rows: shownComponentsOf(overlays).flatMap((component) => {
      const missesOfRecursions = RECURSIONS.map((recursion) => misses[recursion][TWIST_COMPONENTS.indexOf(component)]);
      return [[texts.overlays[component], ...missesOfRecursions.map(formatMissRange)], [texts.missTable.atEndLabel(texts.overlays[component]), ...missesOfRecursions.map(formatFinalError)]];
    }),
  });
}
