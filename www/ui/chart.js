/** A line chart in SVG whose marker can be moved along x, by pointer and by keyboard. */

import { ticks } from 'd3-array';
import { css, html, nothing, svg } from 'lit';
import { clamp } from './clamp.js';
import { finger } from './finger.js';
import { fixed, tick } from './format.js';

const WIDTH = 380;
const HEIGHT = 250;
const LEFT = 40;
const RIGHT = WIDTH - 10;
const TOP = 22;
const BOTTOM = HEIGHT - 34;

/** Half-heights that the y axis may have, so that it holds still while a slider is dragged. */
const HALF_HEIGHTS = [0.25, 0.5, 1, 2, 4, 8];

/** A curve that stays below is flat to the eye, and is not stretched. */
const MIN_PEAK = 0.1;

/** How many steps a key moves the marker by. */
const KEY_STEPS = new Map(
  Object.entries({ ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 10, PageDown: -10, Home: -Infinity, End: Infinity }),
);

export const chartStyles = css`
  .chart {
    display: block;
    width: 100%;
    max-width: 34em;
    cursor: crosshair;
    touch-action: pan-y;
  }

  .chart text {
    fill: var(--muted);
    font-size: 13px;
  }

  .chart .name {
    font-style: italic;
  }

  .chart .axis {
    stroke: var(--rule);
  }

  .chart .zero {
    stroke: var(--prediction);
    stroke-width: 1.5;
    stroke-dasharray: 7 4;
  }

  .chart .curve {
    fill: none;
    stroke: var(--ink);
    stroke-width: 1.75;
  }

  .chart .measured {
    fill: none;
    stroke: var(--prediction);
    stroke-width: 2;
    pointer-events: none;
  }

  .chart .now {
    stroke: var(--prior);
    stroke-dasharray: 2 3;
  }

  .chart-marker circle {
    fill: var(--paper);
    stroke: var(--prior);
    stroke-width: 2.5;
  }

  .chart-marker .nowhere {
    stroke: var(--muted);
    stroke-dasharray: 2 2;
  }
`;

/**
 * @typedef {object} Chart
 * @property {string} label what a screen reader says of the chart
 * @property {{ x: string, y: string }} axes their names, with units
 * @property {Float64Array} curve values about 0 at even steps of x from `min` to `max`; NaN leaves a gap
 * @property {number} min
 * @property {number} max
 * @property {number} step of the keyboard
 * @property {{ name: string, text: string, x: number, y: number }} marker its value in words; y is NaN where there
 *   is none, and the marker waits on the x axis then
 * @property {{ value: number, error: number }} measured at the marker's x; NaN where there is none
 * @property {{ x: number, text: string }} [remark] beside the zero line, from there on to the right
 * @property {(to: (x: number) => number) => void} move given what makes the next x of the present one
 * @property {() => void} commit
 */

/** @param {Chart} chart */
export function chart(chart) {
  const { curve, min, max, step, marker, measured, move, commit } = chart;
  const scale = scaleOf(chart);
  const { x, y } = scale;
  const at = clamp(marker.x, min, max);
  const nowhere = Number.isNaN(marker.y);
  // After a gap the line starts anew.
  const path = Array.from(curve, (value, i) => {
    if (Number.isNaN(value)) return '';
    return `${i > 0 && !Number.isNaN(curve[i - 1]) ? 'L' : 'M'}${x(scale.at(i))},${y(value)}`;
  });
  const onStep = (/** @type {number} */ value) => clamp(Math.round(value / step) * step, min, max);
  const pointer = follower((pixel) => move(() => onStep(scale.under(pixel))), commit);
  const key = (/** @type {KeyboardEvent} */ event) => {
    const steps = KEY_STEPS.get(event.key);
    if (steps === undefined) return;
    event.preventDefault();
    move((now) => onStep(now + steps * step));
    commit();
  };
  return html`
    <svg
      class="chart"
      viewBox="0 0 ${WIDTH} ${HEIGHT}"
      role="group"
      aria-label=${chart.label}
      part="chart"
      @pointerdown=${pointer.down}
      @pointermove=${pointer.move}
      @pointerup=${pointer.up}
      @pointercancel=${finger.goes}
    >
      <g aria-hidden="true">
        ${axes(chart, scale)}
        <path class="curve" d=${path.join('')} />
        <line class="now" x1=${x(at)} x2=${x(at)} y1=${TOP} y2=${BOTTOM} />
      </g>
      <g
        class="chart-marker"
        role="slider"
        tabindex="0"
        aria-label=${marker.name}
        aria-valuemin=${min}
        aria-valuemax=${max}
        aria-valuenow=${at}
        aria-valuetext=${marker.text}
        @keydown=${key}
      >
        <circle class=${nowhere ? 'nowhere' : nothing} cx=${x(at)} cy=${nowhere ? BOTTOM : y(marker.y)} r="6" />
      </g>
      ${Number.isNaN(measured.value) ? nothing : measuredBar(x(at), measured, y)}
    </svg>
  `;
}

/** Turns values into pixels and back, with 0 halfway up. @param {Chart} chart */
function scaleOf({ curve, min, max }) {
  const peak = curve.reduce((most, value) => Math.max(most, Math.abs(value) || 0), MIN_PEAK);
  const half = HALF_HEIGHTS.find((candidate) => candidate >= peak) ?? peak;
  const [perX, perY] = [(RIGHT - LEFT) / (max - min), (TOP - BOTTOM) / (2 * half)];
  return {
    half,
    at: (/** @type {number} */ index) => min + (index * (max - min)) / Math.max(1, curve.length - 1),
    x: (/** @type {number} */ value) => LEFT + (value - min) * perX,
    y: (/** @type {number} */ value) => BOTTOM + (value + half) * perY,
    under: (/** @type {number} */ pixel) => min + (pixel - LEFT) / perX,
  };
}

/**
 * @param {Chart} chart
 * @param {ReturnType<typeof scaleOf>} scale
 */
function axes({ axes: names, min, max, remark }, { half, x, y }) {
  return svg`
    ${ticks(min, max, 5).map(
      (value) => svg`
        <line class="axis" x1=${x(value)} x2=${x(value)} y1=${BOTTOM} y2=${BOTTOM + 4} />
        <text x=${x(value)} y=${BOTTOM + 18} text-anchor="middle">${tick(value, 1)}</text>`,
    )}
    ${ticks(-half, half, 5).map(
      (value) => svg`
        <line class="axis" x1=${LEFT} x2=${RIGHT} y1=${y(value)} y2=${y(value)} opacity="0.5" />
        <text x=${LEFT - 6} y=${y(value) + 4} text-anchor="end">${fixed(value, half < 1 ? 2 : 1)}</text>`,
    )}
    <line class="axis" x1=${LEFT} x2=${RIGHT} y1=${BOTTOM} y2=${BOTTOM} />
    <text class="name" x=${RIGHT} y=${BOTTOM + 31} text-anchor="end">${names.x}</text>
    <text class="name" x="0" y="12">${names.y}</text>
    <line class="zero" x1=${LEFT} x2=${RIGHT} y1=${y(0)} y2=${y(0)} />
    ${remark ? svg`<text x=${x(remark.x) + 8} y=${y(0) - 9}>${remark.text}</text>` : nothing}`;
}

/**
 * What follows a pointer across the chart.
 *
 * @param {(pixel: number) => void} moved
 * @param {() => void} commit
 */
function follower(moved, commit) {
  const follow = (/** @type {PointerEvent} */ event) => {
    const box = /** @type {Element} */ (event.currentTarget).getBoundingClientRect();
    moved(((event.clientX - box.left) / box.width) * WIDTH);
  };
  return {
    down: (/** @type {PointerEvent} */ event) => {
      if (event.button !== 0) return;
      finger.comes(event);
      if (finger.waits) return;
      /** @type {Element} */ (event.currentTarget).setPointerCapture(event.pointerId);
      follow(event);
    },
    move: (/** @type {PointerEvent} */ event) => {
      finger.moves(event);
      if (event.buttons & 1 && !finger.waits) follow(event);
    },
    up: (/** @type {PointerEvent} */ event) => {
      if (finger.goes()) follow(event);
      commit();
    },
  };
}

/**
 * The measured value and one standard error either way, as far as the axis goes: an arrow says that
 * it goes on.
 *
 * @param {number} x pixels
 * @param {{ value: number, error: number }} measured
 * @param {(value: number) => number} y
 */
function measuredBar(x, { value, error }, y) {
  const onAxis = (/** @type {number} */ pixel) => clamp(pixel, TOP, BOTTOM);
  const end = (/** @type {number} */ pixel) => {
    const shown = onAxis(pixel);
    if (shown === pixel) return `M${x - 10},${pixel}h20`;
    const back = shown === BOTTOM ? -5 : 5;
    return `M${x - 5},${shown + back}L${x},${shown}l5,${back}`;
  };
  const [low, high] = [y(value - error), y(value + error)];
  const bar = `M${x},${onAxis(low)}V${onAxis(high)}`;
  return svg`<path class="measured" aria-hidden="true" d=${end(low) + end(high) + bar} />`;
}
