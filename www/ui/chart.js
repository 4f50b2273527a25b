/**
 * A line chart in SVG whose marker can be moved along x, by pointer and by keyboard.
 *
 * @module
 */

import { ticks } from 'd3-array';
import { css, html, nothing, svg } from 'lit';
import { finger } from './finger.js';
import { fixed, tick } from './format.js';

const WIDTH = 380;
const HEIGHT = 250;
const INSET = { left: 40, right: 10, top: 22, bottom: 34 };
const BOTTOM = HEIGHT - INSET.bottom;

/** Half-heights that the y axis may have, so that it holds still while a slider is dragged. */
const HALF_HEIGHTS = [0.25, 0.5, 1, 2, 4, 8];

export const chartStyles = css`
  .chart {
    display: block;
    width: 100%;
    max-width: 34rem;
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
 * @param {object} chart
 * @param {string} chart.label what a screen reader says of the chart
 * @param {string} chart.axis the name of its y axis
 * @param {string} chart.marker the name of the marker
 * @param {Float64Array} chart.curve values at even steps from `min` to `max`; NaN leaves a gap
 * @param {number} chart.min
 * @param {number} chart.max
 * @param {number} chart.step of the keyboard
 * @param {number} chart.x where the marker is
 * @param {number} chart.y NaN when there is none: the marker waits on the x axis then
 * @param {{ value: number, error: number }} chart.measured NaN when there is none
 * @param {string} chart.valueText
 * @param {(to: (x: number) => number) => void} chart.move given what makes the next x of the present one
 * @param {() => void} chart.commit
 */
export function skewChart(chart) {
  const { min, max, curve } = chart;
  const steps = Math.max(1, curve.length - 1);
  const points = Array.from(
    curve,
    (value, i) => /** @type {[number, number]} */ ([min + (i * (max - min)) / steps, value]),
  );
  const peak = points.reduce((most, [, value]) => Math.max(most, Math.abs(value) || 0), 0.1);
  const half = HALF_HEIGHTS.find((candidate) => candidate >= peak) ?? peak;
  const [perX, perY] = [(WIDTH - INSET.right - INSET.left) / (max - min), (INSET.top - BOTTOM) / (2 * half)];
  const x = (/** @type {number} */ value) => INSET.left + (value - min) * perX;
  const y = (/** @type {number} */ value) => BOTTOM + (value + half) * perY;
  // After a gap the line starts anew.
  const path = points.map(([at, value], i) => {
    if (Number.isNaN(value)) return '';
    return `${i > 0 && !Number.isNaN(curve[i - 1]) ? 'L' : 'M'}${x(at)},${y(value)}`;
  });
  const inRange = (/** @type {number} */ value) => Math.min(max, Math.max(min, value));
  const onStep = (/** @type {number} */ value) => inRange(Math.round(value / chart.step) * chart.step);
  const at = inRange(chart.x);
  const undefinedHere = Number.isNaN(chart.y);

  /** @param {PointerEvent} event */
  const follow = (event) => {
    const box = /** @type {Element} */ (event.currentTarget).getBoundingClientRect();
    const pixel = ((event.clientX - box.left) / box.width) * WIDTH;
    chart.move(() => onStep(min + (pixel - INSET.left) / perX));
  };
  /** @param {PointerEvent} event */
  const down = (event) => {
    if (event.button !== 0) return;
    finger.comes(event);
    if (finger.waits) return;
    /** @type {Element} */ (event.currentTarget).setPointerCapture(event.pointerId);
    follow(event);
  };
  /** @param {PointerEvent} event */
  const move = (event) => {
    finger.moves(event);
    if (event.buttons & 1 && !finger.waits) follow(event);
  };
  /** @param {PointerEvent} event */
  const up = (event) => {
    if (finger.goes()) follow(event);
    chart.commit();
  };
  /** @param {KeyboardEvent} event */
  const key = (event) => {
    const steps = /** @type {Record<string, number>} */ ({
      ArrowRight: 1,
      ArrowUp: 1,
      ArrowLeft: -1,
      ArrowDown: -1,
      PageUp: 10,
      PageDown: -10,
      Home: -Infinity,
      End: Infinity,
    })[event.key];
    if (steps === undefined) return;
    event.preventDefault();
    chart.move((now) => onStep(now + steps * chart.step));
    chart.commit();
  };

  return html`
    <svg
      class="chart"
      viewBox="0 0 ${WIDTH} ${HEIGHT}"
      role="group"
      aria-label=${chart.label}
      part="chart"
      @pointerdown=${down}
      @pointermove=${move}
      @pointerup=${up}
      @pointercancel=${finger.goes}
    >
      <g aria-hidden="true">
        ${ticks(min, max, 5).map(
          (value) => svg`
            <line class="axis" x1=${x(value)} x2=${x(value)} y1=${BOTTOM} y2=${BOTTOM + 4} />
            <text x=${x(value)} y=${BOTTOM + 18} text-anchor="middle">${tick(value, 1)}</text>`,
        )}
        ${ticks(-half, half, 5).map(
          (value) => svg`
            <line class="axis" x1=${INSET.left} x2=${WIDTH - INSET.right} y1=${y(value)} y2=${y(value)} opacity="0.5" />
            <text x=${INSET.left - 6} y=${y(value) + 4} text-anchor="end">${fixed(value, half < 1 ? 2 : 1)}</text>`,
        )}
        <line class="axis" x1=${INSET.left} x2=${WIDTH - INSET.right} y1=${BOTTOM} y2=${BOTTOM} />
        <text class="name" x=${WIDTH - INSET.right} y=${BOTTOM + 31} text-anchor="end">ω (rad/s)</text>
        <text class="name" x="0" y="12">${chart.axis}</text>
        <line class="zero" x1=${INSET.left} x2=${WIDTH - INSET.right} y1=${y(0)} y2=${y(0)} />
        <path class="curve" d=${path.join('')} />
        <line class="now" x1=${x(at)} x2=${x(at)} y1=${INSET.top} y2=${BOTTOM} />
      </g>
      <g
        class="chart-marker"
        role="slider"
        tabindex="0"
        aria-label=${chart.marker}
        aria-valuemin=${min}
        aria-valuemax=${max}
        aria-valuenow=${at}
        aria-valuetext=${chart.valueText}
        @keydown=${key}
      >
        <circle class=${undefinedHere ? 'nowhere' : nothing} cx=${x(at)} cy=${undefinedHere ? BOTTOM : y(chart.y)} r="6" />
      </g>
      ${Number.isNaN(chart.measured.value) ? nothing : measuredBar(x(at), chart.measured, y)}
    </svg>
  `;
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
  const onAxis = (/** @type {number} */ pixel) => Math.min(BOTTOM, Math.max(INSET.top, pixel));
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
