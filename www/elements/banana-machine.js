/**
 * <banana-machine>: one command, thousands of outcomes, and the coordinates in which they are close
 * to an ordinary Gaussian.
 *
 * @module
 */

import { html, nothing } from 'lit';
import { words } from '../messages/registry.js';
import { skewChart } from '../ui/chart.js';
import { rich, toggle } from '../ui/controls.js';
import { DASHES } from '../ui/draw.js';
import { fixed } from '../ui/format.js';
import { theme } from '../ui/theme.js';
import { commandControls, noiseControls } from './banana-controls.js';
import { ArcHandle } from './banana-handle.js';
import { PlanePicture, TwistPicture } from './banana-pictures.js';
import { markedRobot, readoutStyles, readouts, twistTable, workedExample } from './banana-readouts.js';
import { bananaStyles } from './banana-styles.js';
import {
  COMMAND_SLIDERS,
  SAMPLE_COUNTS,
  announcementOf,
  captionOf,
  longestNote,
  noteOn,
  planeText,
  skewText,
  twistCaption,
  twistText,
} from './banana-words.js';
import { CloudElement } from './cloud.js';

/**
 * @typedef {import('../types.d.ts').BananaMachine} BananaMachine
 * @typedef {import('../types.d.ts').Motion} Motion
 * @typedef {import('../types.d.ts').Settings} Settings
 * @typedef {keyof typeof DASHES} Overlay
 */

/** How near to a sample the pointer must be to mark it, CSS pixels. */
const REACH = 14;

/**
 * Points of the chart's curve. Fewer would draw the fall of the skew across ω = 0 as a kinked line;
 * more than a pixel each would be wasted.
 */
const CURVE_POINTS = 241;

const OVERLAYS = /** @type {Overlay[]} */ (Object.keys(DASHES));
const [V_RANGE, OMEGA_RANGE] = COMMAND_SLIDERS;

/** @extends {CloudElement<BananaMachine, Settings>} */
export class BananaMachineElement extends CloudElement {
  static styles = [theme, readoutStyles, ...bananaStyles];

  /** The α that Isolate leaves, from 0; remembered while Isolate is off. */
  #chosen = 3;
  /** The robot that is marked in both views; −1 for none. */
  #marked = -1;
  /** @type {Record<Overlay, boolean>} */
  #overlays = { command: true, ellipse: true, linearized: false, exponential: true };
  /** What the machine said when it was last asked. @type {ReturnType<typeof read> | undefined} */
  #figures;
  /** @type {Float64Array | undefined} skew against ω, which only a change of settings alters */
  #curve;
  #plane = new PlanePicture();
  #twist = new TwistPicture();
  #handle = new ArcHandle({
    view: () => this.#plane.view,
    end: () => this.#fresh().end,
    reach: (x, y) => this.#reach(x, y),
    commit: () => this.commit(),
  });

  #actions = {
    change: (/** @type {import('./banana-controls.js').Change} */ change) => this.change(change),
    commit: () => this.commit(),
    isolate: (/** @type {number} */ index) => {
      this.#chosen = index;
      this.change({ isolate: index + 1 });
      this.commit();
    },
  };

  /**
   * @param {Motion} motion
   * @param {Partial<Settings>} [settings]
   */
  createMachine(motion, settings) {
    return new motion.BananaMachine(settings);
  }

  machineReady() {
    this.#curve = undefined;
    this.begin();
  }

  /** @param {number} elapsed milliseconds */
  draw(elapsed) {
    const { machine, palette } = this;
    if (!machine || !palette) return;
    this.configure();
    if (this.playing) this.growOn();
    const figures = this.#fresh();
    const marked = this.#inspection();
    const scene = { ...figures, machine, overlays: this.#overlays, marked };
    let moving = false;
    for (const picture of [this.#plane, this.#twist]) {
      const canvas = this.#canvas(picture.name);
      picture.prepare(canvas);
      if (!this.#handle.held) picture.fit(scene);
      moving = picture.view.ease(elapsed, this.calm) || moving;
      picture.draw(canvas, scene, palette);
    }
    this.#handle.place(this.renderRoot, figures.end);
    this.requestUpdate();
    if (moving || this.playing) this.wake();
  }

  configured() {
    this.#curve = undefined;
  }

  /** The figures, with every change so far in effect. */
  #fresh() {
    this.configure();
    if (this.stale) this.read();
    return /** @type {ReturnType<typeof read>} */ (this.#figures);
  }

  read() {
    if (!this.machine) return;
    if (this.#marked >= this.machine.shown) this.#marked = -1;
    this.#curve ??= this.machine.skewCurve(OMEGA_RANGE.min, OMEGA_RANGE.max, CURVE_POINTS);
    this.#figures = read(this.machine);
    this.stale = false;
    const { config, stats, note } = this.#figures;
    this.announce(() => announcementOf(config, stats, note));
  }

  /** @param {number} index −1 for none */
  #mark(index) {
    if (index === this.#marked) return;
    this.#marked = index;
    this.wake();
  }

  /** The marked robot, if it is among those shown. */
  #inspection() {
    const { machine } = this;
    return machine && this.#marked >= 0 && this.#marked < machine.shown ? machine.inspect(this.#marked) : undefined;
  }

  /**
   * Sets the command to the arc that ends at a point, as far as the sliders go: of the many that do,
   * the one nearest to the present one, so that nothing leaps.
   *
   * @param {number} x metres
   * @param {number} y
   */
  #reach(x, y) {
    if (!this.motion || !this.machine) return;
    const { command } = this.wanted();
    const { v, omega } = this.motion.commandReaching(x, y, command);
    this.change({ command: { ...command, v: clamp(v, V_RANGE), omega: clamp(omega, OMEGA_RANGE) } });
  }

  /** @param {'plane' | 'twist'} name */
  #canvas(name) {
    return /** @type {HTMLCanvasElement} */ (this.renderRoot.querySelector(`canvas.${name}`));
  }

  /**
   * @param {PlanePicture | TwistPicture} picture
   * @param {PointerEvent} event
   */
  #point(picture, event) {
    if (!this.machine || this.#handle.held) return;
    const index = picture.nearest(this.machine, event.offsetX, event.offsetY, REACH);
    if (index >= 0 || event.type === 'pointerdown') this.#mark(index);
  }

  renderWidget() {
    const { machine, motion } = this;
    if (!machine || !motion || !this.#figures || !this.#curve) return nothing;
    const { config, shown, stats, table, note, exactSkew } = this.#figures;
    const say = words.banana;
    const overlays = OVERLAYS.filter((name) => this.#overlays[name]).map((name) => say.overlays[name]);
    return html`
      <section class="machine" aria-label=${say.title}>
        <div class="floor">
          <div class="stage">
            <canvas
              class="plane"
              role="img"
              aria-label=${planeText(config, stats, note, overlays)}
              @pointermove=${(/** @type {PointerEvent} */ event) => this.#point(this.#plane, event)}
              @pointerdown=${(/** @type {PointerEvent} */ event) => this.#point(this.#plane, event)}
            ></canvas>
            ${this.#handle.render(config.command)}
            <p class="caption roomy ${note && 'note'}" data-room=${longestNote()}>
              <span>${note || captionOf(stats)}</span>
            </p>
          </div>
          ${this.#legend()} ${readouts(stats, config.samples)}
          ${markedRobot({
            index: this.#marked,
            shown,
            inspection: this.#inspection(),
            mark: (index) => this.#mark(index),
          })}
          ${this.cloudControls(say.cloud, SAMPLE_COUNTS)}
        </div>
        <div class="controls">
          ${commandControls(config, motion.BananaMachine.presets, this.#actions)}
          ${noiseControls(config, Math.min(this.#chosen, config.alphas.length - 1), this.#actions)}
        </div>
        <div class="figures">
          <figure>
            <canvas
              class="twist"
              role="img"
              aria-label=${twistText(stats)}
              @pointermove=${(/** @type {PointerEvent} */ event) => this.#point(this.#twist, event)}
              @pointerdown=${(/** @type {PointerEvent} */ event) => this.#point(this.#twist, event)}
            ></canvas>
            <figcaption>${twistCaption(config, note)}</figcaption>
            ${twistTable(table, stats)}
          </figure>
          <figure>
            ${skewChart({
              label: say.chart,
              axis: say.chartAxis,
              marker: say.chartMarker,
              curve: this.#curve,
              min: OMEGA_RANGE.min,
              max: OMEGA_RANGE.max,
              step: OMEGA_RANGE.step,
              x: config.command.omega,
              y: exactSkew,
              measured: { value: stats.crossTrackSkew, error: stats.crossTrackSkewError },
              valueText: say.chartText(fixed(config.command.omega, 2), skewText(exactSkew)),
              move: (to) => this.change(({ command }) => ({ command: { ...command, omega: to(command.omega) } })),
              commit: () => this.commit(),
            })}
            <figcaption>${rich(say.chartCaption)}</figcaption>
          </figure>
          ${workedExample(table, stats)}
        </div>
        <p class="visually-hidden" role="status">${this.announcement}</p>
      </section>
    `;
  }

  #legend() {
    return html`<div class="legend" role="group" aria-label=${words.banana.overlaysLabel}>
      ${OVERLAYS.map((name) =>
        toggle({
          label: html`<svg class="swatch ${name}" viewBox="0 0 30 8" aria-hidden="true">
              <line x1="1" x2="29" y1="4" y2="4" stroke-dasharray=${DASHES[name].join(' ')} />
            </svg>
            <span>${words.banana.overlays[name]}</span>`,
          checked: this.#overlays[name],
          change: (checked) => {
            this.#overlays[name] = checked;
            this.wake();
          },
        }),
      )}
    </div>`;
  }
}

/**
 * Everything that the pictures and figures need of the machine, asked once a change.
 *
 * @param {BananaMachine} machine
 */
function read(machine) {
  const { config, shown, stats, contours, table, chartHolds } = machine;
  return {
    config,
    shown,
    stats,
    contours,
    table,
    note: noteOn(config, table, stats, chartHolds),
    exactSkew: table.exact.crossTrackSkew,
    /** The end of the commanded arc, metres. */
    end: /** @type {[number, number]} */ ([...contours.command.slice(-2)]),
  };
}

/**
 * @param {number} value
 * @param {{ min: number, max: number }} range
 */
function clamp(value, { min, max }) {
  return Math.min(max, Math.max(min, value));
}

// A page may carry the script twice.
if (!customElements.get('banana-machine')) {
  customElements.define('banana-machine', BananaMachineElement);
}
