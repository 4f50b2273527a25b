/** Chart in SVG: curves with bands, points with error bars, and marks, over linear or logarithmic axes. A slider over the chart may set a value on the x axis. */

import { css, html, nothing, svg, unsafeCSS } from 'lit';
import { formatMarkup } from './controls.ts';
import { clampNumber, formatPowerOfTen, ticksOfAxis } from './format.ts';
import { sliderTrackHtml } from './slider.ts';
import { swatchHtml, type LineStyle } from './theme.ts';

const CHART_WIDTH = 380;
const CHART_HEIGHT = 250;
const PLOT_LEFT = 46;
const PLOT_RIGHT = CHART_WIDTH - 12;
const PLOT_TOP = 22;
const PLOT_BOTTOM = CHART_HEIGHT - 34;

/** Maximum number of labels along an axis. More labels would touch each other. */
const MAX_LABEL_COUNTS = { x: 6, y: 7 };

/** Coordinate outside every plot, and within the range of SVG paths. */
const FAR_OUTSIDE_PX = 10_000;

const ERROR_BAR_CAP = 4;

/** Size of the bar that marks a slider's value in the chart. A dot would look like a data point. */
const GRIP_SIZE = { width: 8, height: 28 };

export const plotStyles = css`
  .plot {
    display: block;
    width: 100%;
  }

  .plotted {
    position: relative;
    max-width: 26em;
  }

  /* Invisible slider over the plot area; the chart shows its value. It is longer, so that the middle of its thumb reaches both ends of the axis. */
  .plotted input {
    position: absolute;
    top: ${unsafeCSS((100 * PLOT_TOP) / CHART_HEIGHT)}%;
    left: calc(${unsafeCSS((100 * PLOT_LEFT) / CHART_WIDTH)}% - 0.5em);
    width: calc(${unsafeCSS((100 * (PLOT_RIGHT - PLOT_LEFT)) / CHART_WIDTH)}% + 1em);
    height: ${unsafeCSS((100 * (PLOT_BOTTOM - PLOT_TOP)) / CHART_HEIGHT)}%;
    opacity: 0;
  }

  .plotted:has(:focus-visible) .grip {
    outline: 2px solid var(--accent);
    outline-offset: 2px;
  }

  .plot text {
    fill: var(--muted);
    font-size: 13px;
  }

  .plot .marked {
    fill: var(--accent);
    stroke: var(--paper);
    stroke-width: 3px;
    paint-order: stroke;
  }

  .plot .lit {
    stroke-width: 3.6;
  }

  .plot .unlit {
    opacity: 0.3;
  }

  .plot .band.unlit {
    opacity: 0.1;
  }
`;

interface PlotAxis {
  axisLabel: string;
  min: number;
  /** Largest value on the axis, greater than `min`. */
  max: number;
  /** True for a logarithmic axis, on which `min` and `max` are above 0. */
  isLogarithmic?: boolean;
}

export interface PlotCurve extends Pick<LineStyle, 'colourRole' | 'dash'> {
  /** Name in the legend; *stars* make italics. */
  name: string;
  x: ArrayLike<number>;
  /** Values along y. A NaN leaves a gap in the curve. */
  y: ArrayLike<number>;
  errors?: ArrayLike<number>;
  /** True if only the band is drawn. */
  isBandOnly?: boolean;
  /** True if this curve is highlighted, false if another curve is, undefined if none is. */
  isHighlighted?: boolean;
}

/** Vertical line across the plot, with a text. */
interface VerticalMark {
  x: number;
  text: string;
}

export interface PlotOptions {
  /** Description for screen readers, a sentence. */
  plotLabel: string;
  x: PlotAxis;
  y: PlotAxis;
  plotCurves: PlotCurve[];
  dataPoints?: (Pick<LineStyle, 'colourRole'> & { x: number, y: number, error: number })[];
  verticalMarks?: VerticalMark[];
  /** Slider that covers the plot and sets a value on the x axis. */
  slider?: Omit<Parameters<typeof sliderTrackHtml>[0], 'min' | 'max'>;
  /** Legend that replaces the default one. */
  legendContent?: unknown;
}

export function plotHtml({ plotLabel, x, y, plotCurves, dataPoints = [], verticalMarks = [], slider, legendContent = curveLegendHtml(plotCurves) }: PlotOptions) {
  const [toPixelX, toPixelY] = [createPixelScale(x, PLOT_LEFT, PLOT_RIGHT), createPixelScale(y, PLOT_BOTTOM, PLOT_TOP)];
  const [xTicks, yTicks] = [ticksOfPlotAxis(x, MAX_LABEL_COUNTS.x), ticksOfPlotAxis(y, MAX_LABEL_COUNTS.y)];
  return html`<div class="plotted" dir="ltr">
    <svg class="plot" viewBox="0 0 ${CHART_WIDTH} ${CHART_HEIGHT}" role="img" aria-label=${plotLabel} part="chart">
      ${xTicks.tickValues.map((tickValue) => gridLineSvg(toPixelX(tickValue), toPixelX(tickValue), PLOT_TOP, PLOT_BOTTOM, { x: toPixelX(tickValue), y: PLOT_BOTTOM + 18, textAnchor: 'middle', gridLabel: xTicks.formatLabel(tickValue) }))}
      ${yTicks.tickValues.map((tickValue) => gridLineSvg(PLOT_LEFT, PLOT_RIGHT, toPixelY(tickValue), toPixelY(tickValue), { x: PLOT_LEFT - 6, y: toPixelY(tickValue) + 4, textAnchor: 'end', gridLabel: yTicks.formatLabel(tickValue) }))}
      <text font-style="italic" x=${PLOT_RIGHT} y=${PLOT_BOTTOM + 30} text-anchor="end">${xTicks.axisName}</text>
      <text font-style="italic" x="0" y="12">${yTicks.axisName}</text>
      <svg x=${PLOT_LEFT} y=${PLOT_TOP} width=${PLOT_RIGHT - PLOT_LEFT} height=${PLOT_BOTTOM - PLOT_TOP} viewBox="${PLOT_LEFT} ${PLOT_TOP} ${PLOT_RIGHT - PLOT_LEFT} ${PLOT_BOTTOM - PLOT_TOP}">
        ${plotCurves.map((plotCurve) => plotCurve.errors && svg`<path class="band ${highlightClassOf(plotCurve)}" opacity="0.22" fill="var(--${plotCurve.colourRole})" d=${bandPathDataOf(plotCurve, toPixelX, toPixelY)} />`)}
        ${plotCurves.map((plotCurve) => !plotCurve.isBandOnly && svg`<path class="curve ${highlightClassOf(plotCurve)}" fill="none" stroke-width="1.9" stroke="var(--${plotCurve.colourRole})" stroke-dasharray=${plotCurve.dash?.join(' ') ?? nothing} d=${curvePathDataOf(plotCurve, toPixelX, toPixelY)} />`)}
        ${verticalMarks.map((verticalMark, labelRow) => markSvg(verticalMark, labelRow, toPixelX(verticalMark.x)))}
        ${dataPoints.filter(({ y: axisValue, error }) => !Number.isNaN(axisValue + error)).map(
          ({ colourRole, x: pointX, y: axisValue, error }) => svg`<path
            stroke="var(--${colourRole})"
            stroke-width="1.9"
            d="M${toPixelX(pointX) - ERROR_BAR_CAP},${toPixelY(axisValue - error)}h${2 * ERROR_BAR_CAP}m${-ERROR_BAR_CAP},0V${toPixelY(axisValue + error)}m${-ERROR_BAR_CAP},0h${2 * ERROR_BAR_CAP}"
          /><circle cx=${toPixelX(pointX)} cy=${toPixelY(axisValue)} r="3" fill="var(--${colourRole})" />`,
        )}
      </svg>
      ${slider ? svg`<rect class="grip" fill="var(--accent)" stroke="var(--paper)" stroke-width="3" paint-order="stroke" rx="4" width=${GRIP_SIZE.width} height=${GRIP_SIZE.height} x=${toPixelX(slider.value) - GRIP_SIZE.width / 2} y=${(PLOT_TOP + PLOT_BOTTOM - GRIP_SIZE.height) / 2} />` : nothing}
    </svg>
    ${slider ? sliderTrackHtml({ ...slider, min: x.min, max: x.max }) : nothing}
    </div>
    ${legendContent}
  `;
}

const gridLineSvg = (x1: number, x2: number, y1: number, y2: number, { x, y, textAnchor, gridLabel }: { x: number, y: number, textAnchor: string, gridLabel: string }) => svg`
  <line stroke="var(--rule)" x1=${x1} x2=${x2} y1=${y1} y2=${y2} />
  <text class="notranslate" translate="no" x=${x} y=${y} text-anchor=${textAnchor}>${gridLabel}</text>`;

const highlightClassOf = ({ isHighlighted }: PlotCurve) => (isHighlighted === undefined ? '' : isHighlighted ? 'lit' : 'unlit');

function curveLegendHtml(plotCurves: PlotCurve[]) {
  return html`<ul class="plot-key" part="legend">
    ${plotCurves.map(({ name: curveName, isBandOnly, ...lineStyle }) => html`<li>${swatchHtml({ ...lineStyle, shape: isBandOnly ? 'area' : 'line' })} ${formatMarkup(curveName)}</li>`)}
  </ul>`;
}

/** Returns a function that converts a value on an axis to a pixel, and NaN to NaN. On a logarithmic axis, values of 0 or less are far below the axis. */
function createPixelScale({ min: minValue, max: maxValue, isLogarithmic }: PlotAxis, firstPixel: number, lastPixel: number): (axisValue: number) => number {
  const toLinear = isLogarithmic ? (axisValue: number) => Math.log10(Math.max(axisValue, 0)) : Number;
  const [startValue, endValue] = [toLinear(minValue), toLinear(maxValue)];
  return (axisValue) => clampNumber(firstPixel + ((toLinear(axisValue) - startValue) * (lastPixel - firstPixel)) / (endValue - startValue), -FAR_OUTSIDE_PX, FAR_OUTSIDE_PX);
}

function ticksOfPlotAxis({ axisLabel, min: minValue, max: maxValue, isLogarithmic }: PlotAxis, maxCount: number): ReturnType<typeof ticksOfAxis> {
  if (!isLogarithmic) return ticksOfAxis(axisLabel, minValue, maxValue, maxCount - 1);
  const [firstExponent, lastExponent] = [Math.ceil(Math.log10(minValue) - 1e-9), Math.floor(Math.log10(maxValue) + 1e-9)];
  const exponentStep = Math.max(1, Math.ceil((lastExponent - firstExponent + 1) / maxCount));
  const exponents = Array.from({ length: Math.floor((lastExponent - firstExponent) / exponentStep) + 1 }, (_, i) => firstExponent + i * exponentStep);
  return { tickValues: exponents.map((exponent) => 10 ** exponent), axisName: axisLabel, formatLabel: (tickValue) => formatPowerOfTen(Math.round(Math.log10(tickValue))) };
}

function curvePathDataOf({ x, y }: PlotCurve, toPixelX: (axisValue: number) => number, toPixelY: (axisValue: number) => number) {
  const pathPoints = Array.from(x, (axisValue, i) => (Number.isNaN(axisValue + y[i]) ? '' : `${toPixelX(axisValue).toFixed(2)},${toPixelY(y[i]).toFixed(2)}`));
  return pathPoints.map((pathPoint, i) => pathPoint && `${pathPoints[i - 1] ? 'L' : 'M'}${pathPoint}`).join('');
}

function bandPathDataOf({ x, y, errors = [] }: PlotCurve, toPixelX: (axisValue: number) => number, toPixelY: (axisValue: number) => number) {
  const definedIndices = Array.from(x, (_, i) => i).filter((i) => !Number.isNaN(x[i] + y[i] + errors[i]));
  const bandEdgeOf = (bandSide: number) => definedIndices.map((i) => `${toPixelX(x[i]).toFixed(2)},${toPixelY(y[i] + bandSide * errors[i]).toFixed(2)}`);
  return definedIndices.length > 0 ? `M${[...bandEdgeOf(1), ...bandEdgeOf(-1).reverse()].join('L')}Z` : '';
}

/** Returns the line and text of a vertical mark. Each mark's text is in its own row, so that neighbouring texts do not touch. */
function markSvg({ text: markText }: VerticalMark, labelRow: number, markX: number) {
  // The text is on the side of the line that has more space.
  const [labelOffset, textAnchor] = 2 * markX > PLOT_LEFT + PLOT_RIGHT ? [-5, 'end'] : [5, 'start'];
  return svg`<line stroke="var(--accent)" stroke-dasharray="2 3" x1=${markX} x2=${markX} y1=${PLOT_TOP} y2=${PLOT_BOTTOM} />
    <text class="marked" x=${markX + labelOffset} y=${PLOT_TOP + 13 + 16 * labelRow} text-anchor=${textAnchor}>${markText}</text>`;
}
