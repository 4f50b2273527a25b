/** Readouts of Dead Reckoning: chart of predicted over measured covariance by step, and table of the steps with wrong predictions (misses). */

import { html } from 'lit';
import { sampleField, legend } from '../../figure/controls.ts';
import { words } from '../../messages/registry.ts';
import { formatMarkup } from '../../ui/controls.ts';
import { NO_VALUE, fixed, integer, formatSignificant } from '../../ui/format.ts';
import { plot, type Role } from '../../ui/plot.ts';
import { figureTable, readoutList } from '../../ui/readouts.ts';
import { COMPONENTS, type ViewModel } from './view-model.ts';
import { CURVE_STYLES, RECURSIONS } from './settings.ts';
import { shownComponentsOf, finalErrorText, ratioText, worstComponentAt } from './words.ts';
import type { Misses } from '../../types.d.ts';

/** Allowed heights of the plot, so that its axis does not change with every step of a drag. */
const CHART_HEIGHTS = [1.2, 1.6, 2, 3, 5, 10];

/** Relative error up to which a predicted variance counts as correct. */
const RATIO_TOLERANCE = 0.05;

/** Returns the chart of predicted over measured variance, whose line at the selected step is a slider. */
export function ratioPlot(figure: import('./dead-reckoning.ts').DeadReckoningElement, viewModel: ViewModel): ReturnType<typeof plot> {
  const { config: { step, steps }, curves } = viewModel;
  const { overlays } = figure.state.elementState;
  const texts = words.reckoning;
  const x = Array.from({ length: steps }, (_, i) => i + 1);
  const highestRatio = Math.max(...curves.flatMap(({ ratio }) => Array.from(ratio, (value) => value || 0)));
  const shownCurves = COMPONENTS.map((name, axis) => ({ ...curveStyle(name, figure.highlight), name, ...curves[axis] })).filter(({ name }) => overlays.includes(name));
  const toleranceBand = { name: texts.overlays.tolerance, ...curveStyle('tolerance', figure.highlight), x: [0, steps], y: [1, 1], error: [RATIO_TOLERANCE, RATIO_TOLERANCE], area: true };
  return plot({
    label: ratioText(viewModel, overlays),
    x: { name: texts.stepAxis, from: 0, to: steps },
    y: { name: texts.ratioAxis, from: 0, to: CHART_HEIGHTS.find((height) => height >= highestRatio) ?? highestRatio },
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
      input: (newStep) => figure.settings.request({ step: Math.max(1, newStep) }),
      commit: () => figure.gesture.commit(),
    },
    legend: legend(figure, CURVE_STYLES),
  });
}

/** Returns role, dash and highlight of a curve in the chart of ratios. */
function curveStyle(name: keyof typeof CURVE_STYLES, highlight: string | null) {
  const { role, dash } = CURVE_STYLES[name] as import('../../scene/draw.ts').LineStyle & { role: Role };
  const isHighlighted = highlight !== null && highlight in CURVE_STYLES ? name === highlight : undefined;
  return { role, dash: dash?.join(' '), lit: isHighlighted };
}

/** Returns the headline of the figure: the ratio at the selected step that is furthest from 1. */
export function headlineHtml(viewModel: ViewModel, overlays: string[]) {
  const texts = words.reckoning;
  const { ratio, error, component } = worstComponentAt(viewModel, overlays);
  const headlineDetail = texts.ofMeasured(Number.isNaN(error) ? '' : fixed(error, 2), viewModel.config.step, integer(viewModel.shown));
  return readoutList([[texts.predicted(texts.of[component]), fixed(ratio, 2), headlineDetail]], 0);
}

/** Ranges of both logarithmic axes: fixed, so that a slider moves the curves and not the axes. */
const GROWTH_AXES = { durations: [0.1, 10], variances: [1e-6, 100] };

export function straightGrowthPlot({ durations: x, along, across, alongFirstOrder, acrossFirstOrder, crossing }: import('../../types.d.ts').StraightGrowth) {
  const texts = words.reckoning.straight;
  const [minDuration, maxDuration] = GROWTH_AXES.durations;
  const [minVariance, maxVariance] = GROWTH_AXES.variances;
  const crossingText = crossing === null ? '' : formatSignificant(crossing, 3);
  return html`<figure>
    <p class="panel-title">${texts.title}</p>
    ${plot({
      label: texts.label(crossing === null ? texts.never : texts.crossing(crossingText)),
      x: { name: 'Δt (s)', from: minDuration, to: maxDuration, logarithmic: true },
      y: { name: texts.y, from: minVariance, to: maxVariance, logarithmic: true },
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
function missText({ decidable, first, last, end }: Misses) {
  const { never, unknown, from: rangeText } = words.reckoning.misses;
  if (!decidable) return Number.isNaN(end) ? NO_VALUE : unknown;
  return first === null || last === null ? never : rangeText(first, last);
}

/** Returns the table of the steps at which each recursion misses the measured variance, by component. */
export function missTable({ stats: { misses } }: ViewModel, overlays: string[]) {
  const texts = words.reckoning;
  return figureTable({
    caption: texts.misses.caption,
    columns: [texts.misses.component, ...RECURSIONS.map((recursion) => texts.recursions[recursion])],
    rows: shownComponentsOf(overlays).flatMap((component) => {
      const missesOfRecursions = RECURSIONS.map((recursion) => misses[recursion][COMPONENTS.indexOf(component)]);
      return [[texts.overlays[component], ...missesOfRecursions.map(missText)], [texts.misses.endOf(texts.overlays[component]), ...missesOfRecursions.map(finalErrorText)]];
    }),
  });
}

/** Returns the field with the number of the marked robot, and the pose of that robot at the step. */
export function markedRobotField(figure: import('./dead-reckoning.ts').DeadReckoningElement, marked: Float64Array | undefined): import('lit').TemplateResult {
  const { config: { step }, shown } = figure.viewModel;
  const [x, y, theta] = Array.from(marked?.subarray(3 * (step - 1), 3 * step) ?? [], (value) => fixed(value, 3));
  return sampleField(figure, 'robot', shown, marked && `x ${x} m, y ${y} m, θ ${theta} rad`);
}
