/** Chart in SVG: curves with bands, points with error bars, and marks, over linear or logarithmic axes. A slider over the chart may set an x. */

import { ticks } from 'd3-array';
import { css, html, nothing, svg, unsafeCSS } from 'lit';
import { formatMarkup } from './controls.ts';
import { clamp, formatPowerOfTen, tick } from './format.ts';
import { track } from './slider.ts';

const CHART_WIDTH = 380;
const CHART_HEIGHT = 250;
const PLOT_LEFT = 46;
const PLOT_RIGHT = CHART_WIDTH - 12;
const PLOT_TOP = 22;
const PLOT_BOTTOM = CHART_HEIGHT - 34;

/** Maximum number of labels along an axis. More labels would touch each other. */
const MAX_LABELS = { x: 6, y: 7 };

/** Coordinate outside every plot, and within the range of SVG paths. */
const FAR_OUTSIDE = 10_000;

const ERROR_BAR_CAP = 4;

export const plotStyles = css`
  .plot {
    display: block;
    width: 100%;
  }

  .plotted {
    position: relative;
    max-width: 26em;
  }

  /* Plot area. A slider's thumb is half a thumb away from its ends. It looks like a grip on a line, because a dot would look like data. */
  .plotted input {
    position: absolute;
    top: ${unsafeCSS((100 * PLOT_TOP) / CHART_HEIGHT)}%;
    left: calc(${unsafeCSS((100 * PLOT_LEFT) / CHART_WIDTH)}% - 0.275em);
    width: calc(${unsafeCSS((100 * (PLOT_RIGHT - PLOT_LEFT)) / CHART_WIDTH)}% + 0.55em);
    height: ${unsafeCSS((100 * (PLOT_BOTTOM - PLOT_TOP)) / CHART_HEIGHT)}%;
    --thumb: var(--prior);
    --thumb-width: 0.55em;
    --thumb-height: 1.9em;
    --track: none;
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

  .plot-key {
    list-style: none;
  }

  .plot-key svg {
    width: 2.4em;
    height: 0.7em;
    margin-inline-end: 0.4em;
  }
`;

interface Axis {
  name: string;
  from: number;
  /** End of the axis, greater than `from`. */
  to: number;
  /** True for a logarithmic axis, whose ends are both above 0. */
  logarithmic?: boolean;
}

export type Role = Exclude<keyof import('./theme.ts').Palette, 'paper' | 'rule'>;

export interface Curve {
  /** Name in the legend; *stars* make italics. */
  name: string;
  role: Role;
  /** Dash pattern, which distinguishes the curve without colours. */
  dash?: string;
  x: ArrayLike<number>;
  /** Values; NaN leaves a gap, and nothing is drawn outside the axes. */
  y: ArrayLike<number>;
  error?: ArrayLike<number>;
  /** True if only the band is drawn. */
  area?: boolean;
  /** True if it is highlighted, false if another curve is. */
  lit?: boolean;
}

export interface Point {
  role: Role;
  x: number;
  y: number;
  error: number;
}

/** Vertical line across the plot, with a text. */
interface Mark {
  x: number;
  text: string;
}

export interface Plot {
  /** Description for screen readers, a sentence. */
  label: string;
  x: Axis;
  y: Axis;
  curves: Curve[];
  points?: Point[];
  marks?: Mark[];
  /** Slider over the whole x axis. */
  slider?: Omit<Parameters<typeof track>[0], 'min' | 'max'>;
  /** Legend that replaces the default one. */
  legend?: unknown;
}

export function plot({ label, x, y, curves, points = [], marks = [], slider, legend = curveLegend(curves) }: Plot) {
  const [toX, toY] = [pixelScale(x, PLOT_LEFT, PLOT_RIGHT), pixelScale(y, PLOT_BOTTOM, PLOT_TOP)];
  return html`<div class="plotted" dir="ltr">
    <svg class="plot" viewBox="0 0 ${CHART_WIDTH} ${CHART_HEIGHT}" role="img" aria-label=${label} part="chart">
      ${axisLabels(x, MAX_LABELS.x).map(([value, text]) => gridLine(toX(value), toX(value), PLOT_TOP, PLOT_BOTTOM, { x: toX(value), y: PLOT_BOTTOM + 18, anchor: 'middle', text }))}
      ${axisLabels(y, MAX_LABELS.y).map(([value, text]) => gridLine(PLOT_LEFT, PLOT_RIGHT, toY(value), toY(value), { x: PLOT_LEFT - 6, y: toY(value) + 4, anchor: 'end', text }))}
      <text font-style="italic" x=${PLOT_RIGHT} y=${PLOT_BOTTOM + 30} text-anchor="end">${x.name}</text>
      <text font-style="italic" x="0" y="12">${y.name}</text>
      <svg x=${PLOT_LEFT} y=${PLOT_TOP} width=${PLOT_RIGHT - PLOT_LEFT} height=${PLOT_BOTTOM - PLOT_TOP} viewBox="${PLOT_LEFT} ${PLOT_TOP} ${PLOT_RIGHT - PLOT_LEFT} ${PLOT_BOTTOM - PLOT_TOP}">
        ${curves.map((curve) => curve.error && svg`<path class="band ${highlightClass(curve)}" opacity="0.22" fill="var(--${curve.role})" d=${bandPath(curve, toX, toY)} />`)}
        ${curves.map((curve) => !curve.area && svg`<path class="curve ${highlightClass(curve)}" fill="none" stroke-width="1.9" stroke="var(--${curve.role})" stroke-dasharray=${curve.dash ?? nothing} d=${curvePath(curve, toX, toY)} />`)}
        ${marks.map((mark, row) => markSvg(mark, row, toX(mark.x)))}
        ${points.filter(({ y: value, error }) => !Number.isNaN(value + error)).map(
          ({ role, x: pointX, y: value, error }) => svg`<path
            stroke="var(--${role})"
            stroke-width="1.9"
            d="M${toX(pointX) - ERROR_BAR_CAP},${toY(value - error)}h${2 * ERROR_BAR_CAP}m${-ERROR_BAR_CAP},0V${toY(value + error)}m${-ERROR_BAR_CAP},0h${2 * ERROR_BAR_CAP}"
          /><circle cx=${toX(pointX)} cy=${toY(value)} r="3" fill="var(--${role})" />`,
        )}
      </svg>
    </svg>
    ${slider ? track({ ...slider, min: x.from, max: x.to }) : nothing}
    </div>
    ${legend}
  `;
}

const gridLine = (x1: number, x2: number, y1: number, y2: number, { x, y, anchor, text }: { x: number, y: number, anchor: string, text: string }) => svg`
  <line stroke="var(--rule)" x1=${x1} x2=${x2} y1=${y1} y2=${y2} />
  <text class="notranslate" translate="no" x=${x} y=${y} text-anchor=${anchor}>${text}</text>`;

const highlightClass = ({ lit }: Curve) => (lit === undefined ? '' : lit ? 'lit' : 'unlit');

function curveLegend(curves: Curve[]) {
  return html`<ul class="plot-key" part="legend">
    ${curves.map(
      ({ name, role, dash, area }) => html`<li>
        <svg viewBox="0 0 36 10" aria-hidden="true">
          ${area ? svg`<path opacity="0.22" fill="var(--${role})" d="M1 1H35V9H1Z" />` : svg`<path stroke="var(--${role})" stroke-width="1.9" stroke-dasharray=${dash ?? nothing} d="M1 5H35" />`}
        </svg>${formatMarkup(name)}
      </li>`,
    )}
  </ul>`;
}

/** Returns a function that converts values to pixels. It returns NaN only for NaN. On a logarithmic axis, values of 0 or less are far below the axis. */
function pixelScale({ from, to, logarithmic }: Axis, first: number, last: number): (value: number) => number {
  const toLinear = logarithmic ? (value: number) => Math.log10(Math.max(value, 0)) : Number;
  const [startValue, endValue] = [toLinear(from), toLinear(to)];
  return (value) => clamp(first + ((toLinear(value) - startValue) * (last - first)) / (endValue - startValue), -FAR_OUTSIDE, FAR_OUTSIDE);
}

function axisLabels({ from, to, logarithmic }: Axis, maxCount: number): [value: number, text: string][] {
  if (!logarithmic) return ticks(from, to, maxCount - 1).map((value, _, values) => [value, tick(value, values.length > 1 ? values[1] - values[0] : 1)]);
  const [first, last] = [Math.ceil(Math.log10(from) - 1e-9), Math.floor(Math.log10(to) + 1e-9)];
  const exponentStep = Math.max(1, Math.ceil((last - first + 1) / maxCount));
  const exponents = Array.from({ length: Math.floor((last - first) / exponentStep) + 1 }, (_, i) => first + i * exponentStep);
  return exponents.map((exponent) => [10 ** exponent, formatPowerOfTen(exponent)]);
}

function curvePath({ x, y }: Curve, toX: (value: number) => number, toY: (value: number) => number) {
  const points = Array.from(x, (value, i) => (Number.isNaN(value + y[i]) ? '' : `${toX(value).toFixed(2)},${toY(y[i]).toFixed(2)}`));
  return points.map((point, i) => point && `${points[i - 1] ? 'L' : 'M'}${point}`).join('');
}

function bandPath({ x, y, error = [] }: Curve, toX: (value: number) => number, toY: (value: number) => number) {
  const definedIndices = Array.from(x, (_, i) => i).filter((i) => !Number.isNaN(x[i] + y[i] + error[i]));
  const bandEdge = (side: number) => definedIndices.map((i) => `${toX(x[i]).toFixed(2)},${toY(y[i] + side * error[i]).toFixed(2)}`);
  return definedIndices.length > 0 ? `M${[...bandEdge(1), ...bandEdge(-1).reverse()].join('L')}Z` : '';
}

/** Returns a mark. Its text is in a row of its own, so that neighbouring texts do not touch. */
function markSvg({ text }: Mark, row: number, markX: number) {
  // Text next to the line, on the side that has space.
  const [labelOffset, anchor] = 2 * markX > PLOT_LEFT + PLOT_RIGHT ? [-5, 'end'] : [5, 'start'];
  return svg`<line stroke="var(--accent)" stroke-dasharray="2 3" x1=${markX} x2=${markX} y1=${PLOT_TOP} y2=${PLOT_BOTTOM} />
    <text class="marked" x=${markX + labelOffset} y=${PLOT_TOP + 13 + 16 * row} text-anchor=${anchor}>${text}</text>`;
}
