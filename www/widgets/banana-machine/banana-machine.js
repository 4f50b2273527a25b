/**
 * <banana-machine>: one command, thousands of outcomes, and the coordinates in which they are close
 * to an ordinary Gaussian.
 *
 * @module
 */

import { html, nothing } from 'lit';
import { speak, words } from '../../messages/registry.js';
import { chart } from '../../ui/chart.js';
import { clamp } from '../../ui/clamp.js';
import { rich } from '../../ui/controls.js';
import { fixed } from '../../ui/format.js';
import { theme } from '../../ui/theme.js';
import { commandControls, noiseControls, overlayToggles } from './controls.js';
import { figuresOf } from './figures.js';
import { ArcHandle } from './handle.js';
import { PlanePicture, TwistPicture } from './pictures.js';
import { markedRobot, readouts, twistTable, workedExample } from './readouts.js';
import { bananaStyles } from './styles.js';
import {
  announcementOf,
  captionOf,
  longestNote,
  planeText,
  skewText,
  twistCaption,
  twistText,
} from './words.js';
import {
  ALPHAS,
  ATTRIBUTES,
  COMMAND_SLIDERS,
  OPENING_OVERLAYS,
  OVERLAYS,
  SAMPLE_COUNTS,
  machineIn,
  openingOf,
} from './settings.js';
import { CloudElement } from '../../figure/cloud.js';
import { define } from '../../figure/settings.js';
import { reserve } from '../../figure/page/reserve.js';
import { schemeStyles } from '../../figure/page/scheme.js';
import { object, subset, whole } from '../../figure/checks.js';

/**
 * @typedef {import('../../types.d.ts').BananaMachine} BananaMachine
 * @typedef {import('../../types.d.ts').Motion} Motion
 * @typedef {import('../../types.d.ts').Settings} Settings
 * @typedef {import('../../types.d.ts').ModelName} ModelName
 * @typedef {import('../../types.d.ts').OverlayName} Overlay
 * @typedef {import('../../figure/state.js').State} State
 */

/**
 * Points of the chart's curve. Fewer would draw the fall of the skew across ω = 0 as a kinked line;
 * more than a pixel each would be wasted.
 */
const CURVE_POINTS = 241;

const ROOM = reserve([[0, 240], [31, 214], [47, 172], [57, 105]]);

const { v: V_RANGE, omega: OMEGA_RANGE } = COMMAND_SLIDERS;

/**
 * One command, thousands of outcomes, and the coordinates in which they are close to an ordinary Gaussian.
 *
 * Attributes and properties say what the figure shows, whoever has changed it. What is out of range is
 * refused with a TypeError or RangeError that names the field, the value and what is allowed: a property
 * throws it, an attribute reports it by `error`, and the last good value stays.
 *
 * @attr {"straight" | "gentle" | "hard" | "pivot"} preset - A command worth starting from; none where the command is another.
 * @attr {"velocity" | "odometry"} model - Whose noise it is.
 * @attr {"normal" | "triangular"} noise - Distribution of the noise.
 * @attr {number} v - Commanded speed, m/s.
 * @attr {number} omega - Commanded turn rate, rad/s, positive to the left.
 * @attr {number} dt - Duration of the command, s.
 * @attr {number} alpha1 - Noise parameter of the present model.
 * @attr {number} alpha2 - Noise parameter of the present model.
 * @attr {number} alpha3 - Noise parameter of the present model.
 * @attr {number} alpha4 - Noise parameter of the present model.
 * @attr {number} alpha5 - Noise parameter of the velocity model.
 * @attr {number} alpha6 - Noise parameter of the velocity model.
 * @attr {number} isolate - Index, from 1, of the only noise parameter in effect; none for all of them.
 * @attr {number} samples - Robots in the whole cloud, 1 to 10 000 000.
 * @attr {number} seed - The same seed is the same robots.
 * @attr {string} overlays - Which of command, ellipse, linearized, exponential are drawn, with spaces between.
 * @attr {"auto" | "light" | "dark"} theme - Auto, the default, is as the surroundings are.
 * @attr {boolean} share - Keeps the state in the fragment of the page's address, and opens in the state that it carries.
 *
 * @fires load - The figure is ready.
 * @fires {ErrorEvent} error - Something was refused, or the core failed and was started again, or the figure cannot run.
 * @fires input - The reader has changed something, and may go on.
 * @fires change - What the reader changed has come to rest.
 * @fires {CustomEvent<Stats>} stats - There are fresh statistics; the detail has them.
 *
 * @csspart picture - A canvas with what stands on it.
 * @csspart caption - The sentences below a picture.
 * @csspart legend - What the lines and dots are, and which are shown.
 * @csspart controls - All controls.
 * @csspart slider - A slider with its name, value and effect.
 * @csspart button - A button.
 * @csspart figures - Readouts, chart and table.
 * @csspart readouts - The figures about the cloud.
 * @csspart table - A table of figures.
 * @csspart chart - The chart of the skew.
 * @csspart exports - Pictures and data to take along.
 * @csspart copies - The page's address and HTML to copy.
 *
 * @cssprop --motion-paper - Background.
 * @cssprop --motion-ink - Text.
 * @cssprop --motion-muted - Text of less weight.
 * @cssprop --motion-rule - Hairlines.
 * @cssprop --motion-prior - The commanded motion.
 * @cssprop --motion-prediction - What the model predicts: lines and text.
 * @cssprop --motion-cloud - The samples.
 * @cssprop --motion-truth - What is so, apart from any model.
 * @cssprop --motion-posterior - What exponential coordinates, or the map, make of it.
 * @cssprop --motion-accent - Annotations.
 * @cssprop --motion-font - Families of type.
 *
 * @extends {CloudElement<BananaMachine, Settings>}
 */
export class BananaMachineElement extends CloudElement {
  static styles = [theme, schemeStyles, ROOM, ...bananaStyles];

  static attributes = ATTRIBUTES;
  static settings = ['command', 'alphas'];

  /** The α that Isolate leaves, from 0; remembered while Isolate is off. */
  #chosen = 3;
  /** The α's of either model: the machine tells those of the present one. @type {Partial<Record<ModelName, number[]>>} */
  #alphas = {};
  /** Those that are shown. @type {readonly Overlay[]} */
  #overlays = OPENING_OVERLAYS;
  /** What the machine said when it was last asked. @type {ReturnType<typeof figuresOf> | undefined} */
  #figures;
  /** @type {Float64Array | undefined} skew against ω, which only a change of settings alters */
  #curve;
  #curveHolds = false;
  #plane = new PlanePicture();
  #twist = new TwistPicture();
  #handle = new ArcHandle({
    view: () => this.#plane.view,
    end: () => this.attempt(() => this.#fresh().end) ?? [0, 0],
    reach: (x, y) => this.#reach(x, y),
    commit: () => this.commit(),
  });

  #actions = {
    change: (/** @type {import('./controls.js').Change} */ change) => this.change(change),
    commit: () => this.commit(),
    isolate: (/** @type {number} */ index) => {
      this.#chosen = index;
      this.change({ isolate: index + 1 });
      this.commit();
    },
  };

  /**
   * @param {Motion} motion
   * @param {State} [state]
   */
  build(motion, state) {
    const machine = machineIn(motion, state);
    if (!state) this.#alphas = { odometry: this.opening(motion, { ...machine.config, model: 'odometry' }).alphas };
    return machine;
  }

  /**
   * @param {Motion} motion
   * @param {Settings} config
   */
  opening(motion, config) {
    return openingOf(motion, config);
  }

  machineReady() {
    this.#curveHolds = false;
    super.machineReady();
  }

  snapshot() {
    const { model, noise, command, alphas, isolate } = /** @type {BananaMachine} */ (this.machine).config;
    return {
      ...super.snapshot(),
      model,
      noise,
      command,
      alphas: { ...this.#alphas, [model]: alphas },
      isolate,
      isolateChoice: this.#chosen + 1,
      overlays: [...this.#overlays],
    };
  }

  /**
   * @param {State} present
   * @param {State} given
   */
  completed(present, given) {
    const { alphas = {} } = given;
    const whole = super.completed(present, given);
    return {
      ...whole,
      alphas: { ...present.alphas, ...object('state.alphas', alphas, Object.keys(ALPHAS)) },
    };
  }

  /**
   * @param {State} state
   * @param {BananaMachine} machine
   */
  checked(state, machine) {
    const { isolateChoice, overlays } = super.checked(state, machine);
    whole('state.isolateChoice', isolateChoice, 1, ALPHAS.velocity);
    return { ...state, overlays: subset('state.overlays', overlays, OVERLAYS) };
  }

  /** @param {State} state */
  adopt(state) {
    super.adopt(state);
    this.#alphas = state.alphas;
    this.#chosen = state.isolateChoice - 1;
    this.#overlays = state.overlays;
  }

  get usual() {
    return { overlays: OPENING_OVERLAYS };
  }

  /** Which overlays are drawn: some of "command", "ellipse", "linearized" and "exponential". */
  get overlays() {
    return [...this.#overlays];
  }

  set overlays(overlays) {
    this.#overlays = /** @type {Overlay[]} */ (subset('overlays', overlays, OVERLAYS));
    this.retell();
  }

  /** ξ along, lateral (m), heading (rad) of each robot shown; a copy. */
  get twists() {
    return this.ask((machine) => machine.twists);
  }

  /** @param {number} elapsed milliseconds */
  draw(elapsed) {
    const { machine, palette } = this;
    if (!machine || !palette) return;
    if (!this.settle()) {
      this.wake();
      return;
    }
    if (this.playing && !this.growOn()) {
      this.wake();
      return;
    }
    const scene = this.#scene(machine);
    let moving = false;
    for (const picture of [this.#plane, this.#twist]) {
      const motion = { elapsed, still: this.#handle.held, atOnce: this.calm };
      moving = picture.draw(this.#canvas(picture.name), scene, palette, motion) || moving;
    }
    this.#handle.place(this.renderRoot, scene.end);
    this.requestUpdate();
    if (moving || this.playing) this.wake();
  }

  /** @param {BananaMachine} machine */
  #scene(machine) {
    const figures = this.#fresh();
    const marked = this.#inspection();
    const overlays = /** @type {Record<Overlay, boolean>} */ (
      Object.fromEntries(OVERLAYS.map((name) => [name, this.#overlays.includes(name)]))
    );
    return { ...figures, machine, overlays, marked };
  }

  /** @returns {import('../../figure/takeaway/export.js').Figure} */
  figure() {
    const { machine } = this;
    if (!machine) return super.figure();
    speak(this);
    const palette = this.palette ?? this.look();
    const scene = this.#scene(machine);
    const { poses } = machine;
    return {
      canvas: this.#canvas('plane'),
      palette,
      paint: (surface) => {
        this.#plane.draw(surface, scene, palette, { atOnce: true });
      },
      settings: { element: this.localName, ...scene.config },
      title: words.banana.title,
      columns: ['x_m', 'y_m', 'theta_rad'],
      row: (i) => [...poses.subarray(3 * i, 3 * i + 3)],
      count: machine.shown,
    };
  }

  configured() {
    this.#curveHolds = false;
    const { model, alphas } = /** @type {BananaMachine} */ (this.machine).config;
    this.#alphas = { ...this.#alphas, [model]: alphas };
  }

  /** The figures, with every change so far in effect. */
  #fresh() {
    this.configure();
    if (this.stale) this.read();
    return /** @type {ReturnType<typeof figuresOf>} */ (this.#figures);
  }

  read() {
    if (!this.machine) return;
    if (this.markedIndex >= this.machine.shown) this.mark(-1);
    if (!this.#curveHolds) this.#curve = this.machine.skewCurve(OMEGA_RANGE.min, OMEGA_RANGE.max, CURVE_POINTS);
    this.#curveHolds = true;
    this.#figures = figuresOf(this.machine);
    this.stale = false;
    const { config, stats, note } = this.#figures;
    this.announce(() => announcementOf(config, stats, note));
    this.refreshed();
  }

  /** The marked robot, if it is among those shown. */
  #inspection() {
    const { machine } = this;
    return machine && this.markedIndex >= 0 && this.markedIndex < machine.shown ? machine.inspect(this.markedIndex) : undefined;
  }

  /**
   * Sets the command to the arc that ends at a point, as far as the sliders go: of the many that do,
   * the one nearest to the present one, so that nothing leaps.
   *
   * @param {number} x metres
   * @param {number} y
   */
  #reach(x, y) {
    this.attempt(() => {
      if (!this.motion || !this.machine) return;
      const { command } = this.wanted();
      const { v, omega } = this.motion.commandReaching(x, y, command);
      this.change({ 
        command: {
          ...command,
          v: clamp(v, V_RANGE.min, V_RANGE.max),
          omega: clamp(omega, OMEGA_RANGE.min, OMEGA_RANGE.max),
        },
      });
    });
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
    this.attempt(() => {
      // A finger that moves scrolls the page; one that taps comes as a click.
      if (!this.machine || this.#handle.held || (event.pointerType === 'touch' && event.type !== 'click')) return;
      const index = picture.nearest(this.machine, event.offsetX, event.offsetY);
      if (index >= 0 || event.type === 'click') this.mark(index);
    });
  }

  /** @param {readonly Overlay[]} overlays that the reader wants */
  #overlay(overlays) {
    this.#overlays = overlays;
    this.touch();
    this.rest();
  }

  renderWidget() {
    const { machine, motion } = this;
    if (!machine || !motion || !this.#figures || !this.#curve) return nothing;
    const { config, shown, stats, table, note, exactSkew } = this.#figures;
    const say = words.banana;
    const overlays = this.#overlays.map((name) => say.overlays[name]);
    return html`
      <section class="machine" aria-label=${say.title}>
        <div class="floor">
          <div class="stage" part="picture">
            <canvas
              class="plane"
              role="img"
              aria-label=${planeText(config, stats, note, overlays)}
              @pointermove=${(/** @type {PointerEvent} */ event) => this.#point(this.#plane, event)}
              @click=${(/** @type {PointerEvent} */ event) => this.#point(this.#plane, event)}
            ></canvas>
            ${this.#handle.render(config.command)}
            <p part="caption" class="caption roomy ${note && 'note'}" data-room=${longestNote()}>
              <span>${note || captionOf(stats)}</span>
            </p>
          </div>
          ${overlayToggles(this.#overlays, (overlays) => this.#overlay(overlays))} ${readouts(stats, config.samples)}
          ${markedRobot({
            index: this.markedIndex,
            shown,
            inspection: this.#inspection(),
            mark: (index) => this.mark(index),
          })}
          ${this.cloudControls(say, SAMPLE_COUNTS)}
        </div>
        <div class="controls" part="controls">
          ${commandControls(config, motion.BananaMachine.presets, this.#actions)}
          ${noiseControls(config, Math.min(this.#chosen, config.alphas.length - 1), this.#actions)}
        </div>
        <div class="figures" part="figures">
          <figure>
            <canvas
              class="twist"
              role="img"
              aria-label=${twistText(stats)}
              @pointermove=${(/** @type {PointerEvent} */ event) => this.#point(this.#twist, event)}
              @click=${(/** @type {PointerEvent} */ event) => this.#point(this.#twist, event)}
            ></canvas>
            <figcaption>${twistCaption(config, note)}</figcaption>
            ${twistTable(table, stats)}
          </figure>
          <figure>
            ${chart({
              ...OMEGA_RANGE,
              label: say.chart,
              axes: { x: 'ω (rad/s)', y: say.chartAxis },
              curve: this.#curve,
              marker: {
                name: say.chartMarker,
                text: say.chartText(fixed(config.command.omega, 2), skewText(exactSkew)),
                x: config.command.omega,
                y: exactSkew,
              },
              measured: { value: stats.crossTrackSkew, error: stats.crossTrackSkewError },
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
}

define('banana-machine', BananaMachineElement);
