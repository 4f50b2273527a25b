/** <odometry-decomposer>: what odometry read as rotate, drive, rotate, and what localizers make of its noise. */

import { html } from 'lit';
import { Cloud, shownOf } from '../../figure/cloud.js';
import { canvas, disclosures, panel } from '../../figure/controls.js';
import { FigureElement } from '../../figure/figure.js';
import { legend } from '../../figure/overlays.js';
import { reserve } from '../../figure/page/room.js';
import { define } from '../../figure/reflection.js';
import { orFree } from '../../figure/runtime.js';
import { words } from '../../messages/registry.js';
import { rich } from '../../ui/controls.js';
import { fixed } from '../../ui/format.js';
import { Player } from '../shared/player.js';
import { PoseHandles } from '../shared/pose-handles.js';
import { presetButtons } from '../shared/presets.js';
import { noiseControls, playable, rulesTable } from './controls.js';
import { LegsPicture, RADIUS, WorldPicture } from './pictures.js';
import { readingOf } from './reading.js';
import { headline, readouts, spreads } from './readouts.js';
import { LINES, attributes, declared, looks, own, vocabulary } from './settings.js';
import { decomposerStyles } from './styles.js';
import { apart, captionOf, legsText, worldText } from './words.js';

/**
 * @import { OdometryDecomposer as Machine } from '../../types.d.ts'
 * @import { Reading } from './reading.js'
 */

/** Where the handles take the poses: left, bottom, right and top, m. */
const FLOOR = [-4, -4, 4, 4];

/**
 * What odometry read as rotate, drive, rotate, and what localizers make of its noise.
 *
 * @attr preset - A reading worth starting from; none where it is another.
 * @attr overlays - Lines and marks that are drawn; in the attribute with spaces between.
 *
 * @csspart chart - The plot of the deviation across the way.
 *
 * @extends {FigureElement<Machine, Reading>}
 */
export class OdometryDecomposerElement extends FigureElement {
  static styles = [...FigureElement.styles, reserve('odometry-decomposer'), ...decomposerStyles];

  static declared = declared;
  static attributes = attributes;
  static own = own;
  static looks = looks;
  static vocabulary = vocabulary;

  cloud = new Cloud(this);
  /** @type {Player<'phase' | 'drift'>} */
  player = new Player(this, { phase: this.#played('phase', 4000), drift: this.#played('drift', 8000) });
  #legs = new LegsPicture();
  #world = new WorldPicture();
  pictures = [this.#legs, this.#world];
  /** The later one on top, where both poses are at one place. @type {PoseHandles[]} */
  #handles = /** @type {const} */ (['from', 'to']).map(
    (setting) =>
      new PoseHandles(this, setting, {
        view: () => this.#legs.view,
        bounds: () => FLOOR,
        say: () => ({ ...words.decomposer.handles[setting], ends: words.decomposer.handles.ends }),
      }),
  );

  /** @type {FigureElement<Machine, Reading>['createMachine']} */
  createMachine = (motion, state) => {
    const machine = new motion.OdometryDecomposer();
    if (!state) return machine;
    return orFree(machine, () => {
      machine.configure(this.settings.declared(state));
      const shown = shownOf(machine, state.shown);
      machine.restart();
      machine.grow(shown);
    });
  };

  /** @param {Machine} machine */
  read(machine) {
    this.cloud.unmark();
    return readingOf(machine);
  }

  /** In a state that came, or came back, nothing is played. */
  machineChanged() {
    this.player.stop();
  }

  get scene() {
    const reading = this.fresh;
    const { index, isMarked } = this.cloud;
    return { ...reading, overlays: this.state.own.overlays, marked: isMarked ? reading.poses.subarray(3 * index) : undefined };
  }

  /**
   * A setting, to be played from one end of its slider to the other.
   *
   * @param {keyof typeof looks} key
   * @param {number} duration milliseconds
   */
  #played(key, duration) {
    const { min, max } = looks[key];
    return {
      from: min,
      to: max,
      duration,
      at: () => this.settings.wanted[key],
      put: (/** @type {number} */ value) => this.settings.want({ [key]: value }),
    };
  }

  get takeaway() {
    const { config, poses } = this.fresh;
    return {
      title: this.lettering.name,
      description: legsText(this.reading),
      settings: { element: this.localName, ...config },
      columns: ['x_m', 'y_m', 'theta_rad'],
      row: (/** @type {number} */ i) => [...poses.subarray(3 * i, 3 * i + 3)],
      count: poses.length / 3,
    };
  }

  announcement = captionOf;

  /** @param {Reading} scene */
  placeHandles({ config: { from, to } }) {
    const [before, after] = this.#handles;
    before.place(from, RADIUS);
    after.place(to, RADIUS);
  }

  /** @param {Reading} reading */
  content(reading) {
    const say = words.decomposer;
    return html`
      <section class="machine" aria-label=${this.lettering.name}>
        <div class="views">
          ${panel(say.legsTitle, html`<div class="stage" part="picture">
            ${canvas(this, this.#legs, legsText(reading))} ${this.#handles.map((handle) => handle.render())}
          </div>`, 'legs')}
          ${panel(say.worldTitle, html`<div class="stage">${canvas(this, this.#world, worldText(reading))}</div>`, 'world')}
          ${this.stage.later(() => html`
          <div class="said">${headline(reading)} <p class="caption" part="caption">${captionOf(reading)}</p></div>
          <p class="caption drifting">${rich(say.worldCaption(fixed(apart(reading), 2)))}</p>`)}
        </div>
        ${this.stage.later(() => html`
        ${legend(this, LINES)} ${presetButtons(this)} ${rulesTable(this)}
        <div class="plays" part="controls">${playable(this, 'phase', say.path)} ${playable(this, 'drift', say.drift)}</div>
        ${disclosures(this, {
          controls: () => noiseControls(this),
          numbers: () => html`${readouts(reading)} ${this.machine && spreads(this.machine, reading)}`,
        })}`)}
      </section>
    `;
  }
}

define('odometry-decomposer', OdometryDecomposerElement);
