/** Chart in SVG: curves with bands, points with error bars, and marks, over linear or logarithmic axes. A slider may lie over it, which sets an x. */

import { ticks } from 'd3-array';
import { css, html, nothing, svg, unsafeCSS } from 'lit';
import { clamp } from './clamp.ts';
import { rich } from './controls.ts';
import { powerOfTen, tick } from './format.ts';
import { track } from './slider.ts';

const WIDTH = 380;
const HEIGHT = 250;
const LEFT = 46;
const RIGHT = WIDTH - 12;
const TOP = 22;
const BOTTOM = HEIGHT - 34;

/** Maximum number of labels along an axis: more of them touch. */
const MOST_LABELS = { x: 6, y: 7 };

/** Coordinate outside every plot, and within the range of SVG paths. */
const FAR = 10_000;

/** Half the width of the ends of an error bar. */
const SERIF = 4;

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
    top: ${unsafeCSS((100 * TOP) / HEIGHT)}%;
    left: calc(${unsafeCSS((100 * LEFT) / WIDTH)}% - 0.275em);
    width: calc(${unsafeCSS((100 * (RIGHT - LEFT)) / WIDTH)}% + 0.55em);
    height: ${unsafeCSS((100 * (BOTTOM - TOP)) / HEIGHT)}%;
    --thumb: var(--prior);
    --thumb-width: 0.55em;
    --thumb-height: 1.9em;
    --track: none;
  }

  .plot text {
    fill: var(--muted);
    font-size: 13px;
  }

  .plot .name {
    font-style: italic;
  }

  .plot .grid {
    stroke: var(--rule);
  }

  :is(.plot, .plot-key) .band {
    stroke: none;
    opacity: 0.22;
  }

  .plot .mark {
    stroke: var(--accent);
    stroke-dasharray: 2 3;
  }

  .plot .marked {
    fill: var(--accent);
    stroke: var(--paper);
    stroke-width: 3px;
    paint-order: stroke;
  }

  :is(.plot, .plot-key) .curve {
    fill: none;
    stroke-width: 1.9;
  }

  .plot .lit {
    stroke-width: 3.6;
  }

  .plot .band.lit {
    opacity: 0.45;
  }

  .plot .unlit {
    opacity: 0.3;
  }

  .plot .band.unlit {
    opacity: 0.1;
  }

  .plot-key {
    display: flex;
    flex-wrap: wrap;
    gap: 0.1em 1.2em;
    margin: 0.2em 0 0.7em;
    padding: 0;
    list-style: none;
    font-size: 0.92em;
  }

  .plot-key svg {
    width: 2.4em;
    height: 0.7em;
    margin-inline-end: 0.4em;
  }
`;

interface Axis {
  /** Name with its unit. */
  name: string;
  from: number;
  /** End of the axis, greater than `from`. */
  to: number;
  /** True for a logarithmic axis, whose ends are both above 0. */
  logarithmic?: boolean;
}

export type Role = Exclude<keyof import('./theme.ts').Palette, 'paper' | 'rule'>;

export interface Curve {
  /** Name in the key; *stars* make italics. */
  name: string;
  role: Role;
  /** Dash pattern, which distinguishes the curve without colours. */
  dash?: string;
  x: ArrayLike<number>;
  /** Values; NaN leaves a gap, and nothing is drawn outside the axes. */
  y: ArrayLike<number>;
  /** Half the height of a band around the curve. */
  error?: ArrayLike<number>;
  /** True if there is only the band. */
  area?: boolean;
  /** True if it is highlighted, false if another curve is. */
  lit?: boolean;
}

export interface Point {
  role: Role;
  x: number;
  /** Value; NaN if there is none. */
  y: number;
  error: number;
}

/** Line across the plot, at an x or at a y. */
interface Mark {
  x?: number;
  y?: number;
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
  /** Legend that replaces the key. */
  legend?: unknown;
}

export function plot({ label, x, y, curves, points = [], marks = [], slider, legend = keyOf(curves) }: Plot) {
  const [toX, toY] = [placing(x, LEFT, RIGHT), placing(y, BOTTOM, TOP)];
  return html`<div class="plotted" dir="ltr">
    <svg class="plot" viewBox="0 0 ${WIDTH} ${HEIGHT}" role="img" aria-label=${label} part="chart">
      ${labelsOf(x, MOST_LABELS.x).map(([value, text]) => gridLine(toX(value), toX(value), TOP, BOTTOM, { x: toX(value), y: BOTTOM + 18, anchor: 'middle', text }))}
      ${labelsOf(y, MOST_LABELS.y).map(([value, text]) => gridLine(LEFT, RIGHT, toY(value), toY(value), { x: LEFT - 6, y: toY(value) + 4, anchor: 'end', text }))}
      <text class="name" x=${RIGHT} y=${BOTTOM + 30} text-anchor="end">${x.name}</text>
      <text class="name" x="0" y="12">${y.name}</text>
      <svg x=${LEFT} y=${TOP} width=${RIGHT - LEFT} height=${BOTTOM - TOP} viewBox="${LEFT} ${TOP} ${RIGHT - LEFT} ${BOTTOM - TOP}">
        ${curves.map((curve) => curve.error && svg`<path class="band ${litOf(curve)}" fill="var(--${curve.role})" d=${band(curve, toX, toY)} />`)}
        ${curves.map((curve) => !curve.area && svg`<path class="curve ${litOf(curve)}" stroke="var(--${curve.role})" stroke-dasharray=${curve.dash ?? nothing} d=${line(curve, toX, toY)} />`)}
        ${marks.map((mark, row) => markOf(mark, row, toX, toY))}
        ${points.filter(({ y: value, error }) => !Number.isNaN(value + error)).map(
          ({ role, x: at, y: value, error }) => svg`<path
            class="curve"
            stroke="var(--${role})"
            d="M${toX(at) - SERIF},${toY(value - error)}h${2 * SERIF}m${-SERIF},0V${toY(value + error)}m${-SERIF},0h${2 * SERIF}"
          /><circle cx=${toX(at)} cy=${toY(value)} r="3" fill="var(--${role})" />`,
        )}
      </svg>
    </svg>
    ${slider ? track({ ...slider, min: x.from, max: x.to }) : nothing}
    </div>
    ${legend}
  `;
}

/** Returns a line of the grid with its label. */
const gridLine = (x1: number, x2: number, y1: number, y2: number, { x, y, anchor, text }: { x: number, y: number, anchor: string, text: string }) => svg`
  <line class="grid" x1=${x1} x2=${x2} y1=${y1} y2=${y2} />
  <text class="notranslate" translate="no" x=${x} y=${y} text-anchor=${anchor}>${text}</text>`;

/** Returns the class of a curve by its highlight. */
const litOf = ({ lit }: Curve) => (lit === undefined ? '' : lit ? 'lit' : 'unlit');

function keyOf(curves: Curve[]) {
  return html`<ul class="plot-key" part="legend">
    ${curves.map(
      ({ name, role, dash, area }) => html`<li>
        <svg viewBox="0 0 36 10" aria-hidden="true">
          <path class=${area ? 'band' : 'curve'} fill="var(--${role})" stroke="var(--${role})" stroke-dasharray=${dash ?? nothing} d=${area ? 'M1 1H35V9H1Z' : 'M1 5H35'} />
        </svg>${rich(name)}
      </li>`,
    )}
  </ul>`;
}

/** Returns a function that turns values into pixels; NaN only for NaN. Values that a logarithmic axis does not have are far below it. */
function placing({ from, to, logarithmic }: Axis, first: number, last: number): (value: number) => number {
  const scale = logarithmic ? (value: number) => Math.log10(Math.max(value, 0)) : Number;
  const [start, end] = [scale(from), scale(to)];
  return (value) => clamp(first + ((scale(value) - start) * (last - first)) / (end - start), -FAR, FAR);
}

function labelsOf({ from, to, logarithmic }: Axis, most: number): [value: number, text: string][] {
  if (!logarithmic) return ticks(from, to, most - 1).map((value, _, all) => [value, tick(value, all.length > 1 ? all[1] - all[0] : 1)]);
  const [first, last] = [Math.ceil(Math.log10(from) - 1e-9), Math.floor(Math.log10(to) + 1e-9)];
  const step = Math.max(1, Math.ceil((last - first + 1) / most));
  const exponents = Array.from({ length: Math.floor((last - first) / step) + 1 }, (_, i) => first + i * step);
  return exponents.map((exponent) => [10 ** exponent, powerOfTen(exponent)]);
}

/** Returns a curve as a path, with gaps. */
function line({ x, y }: Curve, toX: (value: number) => number, toY: (value: number) => number) {
  const points = Array.from(x, (value, i) => (Number.isNaN(value + y[i]) ? '' : `${toX(value).toFixed(2)},${toY(y[i]).toFixed(2)}`));
  return points.map((point, i) => point && `${points[i - 1] ? 'L' : 'M'}${point}`).join('');
}

/** Returns the outline of a curve's band as a path. */
function band({ x, y, error = [] }: Curve, toX: (value: number) => number, toY: (value: number) => number) {
  const defined = Array.from(x, (_, i) => i).filter((i) => !Number.isNaN(x[i] + y[i] + error[i]));
  const edge = (side: number) => defined.map((i) => `${toX(x[i]).toFixed(2)},${toY(y[i] + side * error[i]).toFixed(2)}`);
  return defined.length > 0 ? `M${[...edge(1), ...edge(-1).reverse()].join('L')}Z` : '';
}

/** Returns a mark with its text in a row, so that neighbours do not touch. */
function markOf({ x, y, text }: Mark, row: number, toX: (value: number) => number, toY: (value: number) => number) {
  if (x !== undefined) {
    const at = toX(x);
    // Text next to the line, on the side that has space.
    const [shift, anchor] = 2 * at > LEFT + RIGHT ? [-5, 'end'] : [5, 'start'];
    return svg`<line class="mark" x1=${at} x2=${at} y1=${TOP} y2=${BOTTOM} />
      <text class="marked" x=${at + shift} y=${TOP + 13 + 16 * row} text-anchor=${anchor}>${text}</text>`;
  }
  const at = toY(y ?? NaN);
  return svg`<line class="mark" x1=${LEFT} x2=${RIGHT} y1=${at} y2=${at} />
    <text class="marked" x=${RIGHT - 4} y=${at - 5} text-anchor="end">${text}</text>`;
}
