/** <odometry-decomposer>: what odometry read as rotate, drive, rotate, and what localizers make of its noise. */

import { html } from 'lit';
import { Cloud, shownOf } from '../../figure/cloud.js';
import { canvas, disclosures } from '../../figure/controls.js';
import { FigureElement } from '../../figure/figure.js';
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
import { readouts, spreads } from './readouts.js';
import { attributes, declared, looks, own, vocabulary } from './settings.js';
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
    return { ...reading, marked: isMarked ? reading.poses.subarray(3 * index) : undefined };
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
          <div class="stage" part="picture">
            ${canvas(this, this.#legs, legsText(reading))} ${this.#handles.map((handle) => handle.render())}
          </div>
          <div class="stage beside">${canvas(this, this.#world, worldText(reading))}</div>
          ${this.stage.later(() => html`
          <p class="caption said" part="caption">${captionOf(reading)}</p>
          <p class="caption drifting">${rich(say.worldCaption(fixed(apart(reading), 2)))}</p>`)}
        </div>
        ${this.stage.later(() => html`
        <div class="plays">${playable(this, 'phase', say.way)} ${playable(this, 'drift', say.drift)}</div>
        ${presetButtons(this)} ${rulesTable(this)}
        ${disclosures(this, {
          controls: () => noiseControls(this),
          numbers: () => html`${readouts(reading)} ${this.machine && spreads(this.machine, reading)}`,
        })}`)}
      </section>
    `;
  }
}

define('odometry-decomposer', OdometryDecomposerElement);
