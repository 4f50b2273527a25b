/** Chart in SVG: curves with bands, points with error bars, and marks, over linear or logarithmic axes. A slider over the chart may set an x. */

import { ticks } from 'd3-array';
import { css, html, nothing, svg, unsafeCSS } from 'lit';
import { formatMarkup } from './controls.ts';
import { clamp, formatPowerOfTen, formatTick } from './format.ts';
import { sliderTrackHtml } from './slider.ts';
import { swatchHtml } from './theme.ts';

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

  /* Invisible slider over the plot area, longer by half a thumb at both ends. The chart shows its value. */
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

interface Axis {
  name: string;
  min: number;
  /** Largest value on the axis, greater than `min`. */
  max: number;
  /** True for a logarithmic axis, on which `min` and `max` are above 0. */
  isLogarithmic?: boolean;
}

export type ColourRole = Exclude<keyof import('./theme.ts').Palette, 'paper' | 'rule'>;

export interface Curve {
  /** Name in the legend; *stars* make italics. */
  name: string;
  role: ColourRole;
  /** Dash pattern, which distinguishes the curve without colours. */
  dash?: number[];
  x: ArrayLike<number>;
  /** Values along y. A NaN leaves a gap in the curve. */
  y: ArrayLike<number>;
  errors?: ArrayLike<number>;
  /** True if only the band is drawn. */
  isBandOnly?: boolean;
  /** True if this curve is highlighted, false if another curve is, undefined if none is. */
  isHighlighted?: boolean;
}

interface DataPoint {
  role: ColourRole;
  x: number;
  y: number;
  error: number;
}

/** Vertical line across the plot, with a text. */
interface VerticalMark {
  x: number;
  text: string;
}

export interface PlotOptions {
  /** Description for screen readers, a sentence. */
  label: string;
  x: Axis;
  y: Axis;
  curves: Curve[];
  points?: DataPoint[];
  marks?: VerticalMark[];
  /** Slider that covers the plot and sets a value on the x axis. */
  slider?: Omit<Parameters<typeof sliderTrackHtml>[0], 'min' | 'max'>;
  /** Legend that replaces the default one. */
  legend?: unknown;
}

export function plotHtml({ label, x, y, curves, points = [], marks = [], slider, legend = curveLegendHtml(curves) }: PlotOptions) {
  const [toPixelX, toPixelY] = [createPixelScale(x, PLOT_LEFT, PLOT_RIGHT), createPixelScale(y, PLOT_BOTTOM, PLOT_TOP)];
  return html`<div class="plotted" dir="ltr">
    <svg class="plot" viewBox="0 0 ${CHART_WIDTH} ${CHART_HEIGHT}" role="img" aria-label=${label} part="chart">
      ${axisLabelsOf(x, MAX_LABEL_COUNTS.x).map(([value, text]) => gridLineSvg(toPixelX(value), toPixelX(value), PLOT_TOP, PLOT_BOTTOM, { x: toPixelX(value), y: PLOT_BOTTOM + 18, textAnchor: 'middle', text }))}
      ${axisLabelsOf(y, MAX_LABEL_COUNTS.y).map(([value, text]) => gridLineSvg(PLOT_LEFT, PLOT_RIGHT, toPixelY(value), toPixelY(value), { x: PLOT_LEFT - 6, y: toPixelY(value) + 4, textAnchor: 'end', text }))}
      <text font-style="italic" x=${PLOT_RIGHT} y=${PLOT_BOTTOM + 30} text-anchor="end">${x.name}</text>
      <text font-style="italic" x="0" y="12">${y.name}</text>
      <svg x=${PLOT_LEFT} y=${PLOT_TOP} width=${PLOT_RIGHT - PLOT_LEFT} height=${PLOT_BOTTOM - PLOT_TOP} viewBox="${PLOT_LEFT} ${PLOT_TOP} ${PLOT_RIGHT - PLOT_LEFT} ${PLOT_BOTTOM - PLOT_TOP}">
        ${curves.map((curve) => curve.errors && svg`<path class="band ${highlightClassOf(curve)}" opacity="0.22" fill="var(--${curve.role})" d=${bandPathDataOf(curve, toPixelX, toPixelY)} />`)}
        ${curves.map((curve) => !curve.isBandOnly && svg`<path class="curve ${highlightClassOf(curve)}" fill="none" stroke-width="1.9" stroke="var(--${curve.role})" stroke-dasharray=${curve.dash?.join(' ') ?? nothing} d=${curvePathDataOf(curve, toPixelX, toPixelY)} />`)}
        ${marks.map((verticalMark, labelRow) => markSvg(verticalMark, labelRow, toPixelX(verticalMark.x)))}
        ${points.filter(({ y: value, error }) => !Number.isNaN(value + error)).map(
          ({ role, x: pointX, y: value, error }) => svg`<path
            stroke="var(--${role})"
            stroke-width="1.9"
            d="M${toPixelX(pointX) - ERROR_BAR_CAP},${toPixelY(value - error)}h${2 * ERROR_BAR_CAP}m${-ERROR_BAR_CAP},0V${toPixelY(value + error)}m${-ERROR_BAR_CAP},0h${2 * ERROR_BAR_CAP}"
          /><circle cx=${toPixelX(pointX)} cy=${toPixelY(value)} r="3" fill="var(--${role})" />`,
        )}
      </svg>
      ${slider ? svg`<rect class="grip" fill="var(--accent)" stroke="var(--paper)" stroke-width="3" paint-order="stroke" rx="4" width=${GRIP_SIZE.width} height=${GRIP_SIZE.height} x=${toPixelX(slider.value) - GRIP_SIZE.width / 2} y=${(PLOT_TOP + PLOT_BOTTOM - GRIP_SIZE.height) / 2} />` : nothing}
    </svg>
    ${slider ? sliderTrackHtml({ ...slider, min: x.min, max: x.max }) : nothing}
    </div>
    ${legend}
  `;
}

const gridLineSvg = (x1: number, x2: number, y1: number, y2: number, { x, y, textAnchor, text }: { x: number, y: number, textAnchor: string, text: string }) => svg`
  <line stroke="var(--rule)" x1=${x1} x2=${x2} y1=${y1} y2=${y2} />
  <text class="notranslate" translate="no" x=${x} y=${y} text-anchor=${textAnchor}>${text}</text>`;

const highlightClassOf = ({ isHighlighted }: Curve) => (isHighlighted === undefined ? '' : isHighlighted ? 'lit' : 'unlit');

function curveLegendHtml(curves: Curve[]) {
  return html`<ul class="plot-key" part="legend">
    ${curves.map(({ name, isBandOnly, ...style }) => html`<li>${swatchHtml({ ...style, shape: isBandOnly ? 'area' : 'line' })} ${formatMarkup(name)}</li>`)}
  </ul>`;
}

/** Returns a function that converts a value on an axis to a pixel, and NaN to NaN. On a logarithmic axis, values of 0 or less are far below the axis. */
function createPixelScale({ min, max, isLogarithmic }: Axis, firstPixel: number, lastPixel: number): (value: number) => number {
  const toLinear = isLogarithmic ? (value: number) => Math.log10(Math.max(value, 0)) : Number;
  const [startValue, endValue] = [toLinear(min), toLinear(max)];
  return (value) => clamp(firstPixel + ((toLinear(value) - startValue) * (lastPixel - firstPixel)) / (endValue - startValue), -FAR_OUTSIDE_PX, FAR_OUTSIDE_PX);
}

function axisLabelsOf({ min, max, isLogarithmic }: Axis, maxCount: number): [value: number, text: string][] {
  if (!isLogarithmic) return ticks(min, max, maxCount - 1).map((value, _, values) => [value, formatTick(value, values.length > 1 ? values[1] - values[0] : 1)]);
  const [firstExponent, lastExponent] = [Math.ceil(Math.log10(min) - 1e-9), Math.floor(Math.log10(max) + 1e-9)];
  const exponentStep = Math.max(1, Math.ceil((lastExponent - firstExponent + 1) / maxCount));
  const exponents = Array.from({ length: Math.floor((lastExponent - firstExponent) / exponentStep) + 1 }, (_, i) => firstExponent + i * exponentStep);
  return exponents.map((exponent) => [10 ** exponent, formatPowerOfTen(exponent)]);
}

function curvePathDataOf({ x, y }: Curve, toPixelX: (value: number) => number, toPixelY: (value: number) => number) {
  const points = Array.from(x, (value, i) => (Number.isNaN(value + y[i]) ? '' : `${toPixelX(value).toFixed(2)},${toPixelY(y[i]).toFixed(2)}`));
  return points.map((pathPoint, i) => pathPoint && `${points[i - 1] ? 'L' : 'M'}${pathPoint}`).join('');
}

function bandPathDataOf({ x, y, errors = [] }: Curve, toPixelX: (value: number) => number, toPixelY: (value: number) => number) {
  const definedIndices = Array.from(x, (_, i) => i).filter((i) => !Number.isNaN(x[i] + y[i] + errors[i]));
  const bandEdgeOf = (bandSide: number) => definedIndices.map((i) => `${toPixelX(x[i]).toFixed(2)},${toPixelY(y[i] + bandSide * errors[i]).toFixed(2)}`);
  return definedIndices.length > 0 ? `M${[...bandEdgeOf(1), ...bandEdgeOf(-1).reverse()].join('L')}Z` : '';
}

/** Returns the line and text of a vertical mark. Each mark's text is in its own row, so that neighbouring texts do not touch. */
function markSvg({ text }: VerticalMark, labelRow: number, markX: number) {
  // The text is on the side of the line that has more space.
  const [labelOffset, textAnchor] = 2 * markX > PLOT_LEFT + PLOT_RIGHT ? [-5, 'end'] : [5, 'start'];
  return svg`<line stroke="var(--accent)" stroke-dasharray="2 3" x1=${markX} x2=${markX} y1=${PLOT_TOP} y2=${PLOT_BOTTOM} />
    <text class="marked" x=${markX + labelOffset} y=${PLOT_TOP + 13 + 16 * labelRow} text-anchor=${textAnchor}>${text}</text>`;
}
