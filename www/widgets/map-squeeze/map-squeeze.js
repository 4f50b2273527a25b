/** <map-squeeze>: motion conditioned on a map, and what the condition cannot see. */

import { html } from 'lit';
import { Cloud, showOnly } from '../../figure/cloud.js';
import { canvas, cloudControls, takeAlong } from '../../figure/controls.js';
import { FigureElement } from '../../figure/figure.js';
import { reserve } from '../../figure/page/reserve.js';
import { define } from '../../figure/reflection.js';
import { orFree } from '../../figure/runtime.js';
import { words } from '../../messages/registry.js';
import { verdict as bits } from '../../settings.js';
import { fold } from '../../ui/controls.js';
import { judgeControls, motionControls, ownMap, placeControls } from './controls.js';
import { CostMeter } from './cost.js';
import { RobotHandles } from './handles.js';
import { applyMap, mapData } from './maps/data.js';
import { MapOpener } from './maps/open.js';
import { FloorPicture } from './picture.js';
import { readingOf } from './reading.js';
import { costTable, legend, markedDraw, tally } from './readouts.js';
import { PRESETS, SAMPLE_COUNTS, attributes, declared, looks, own, presetNamed, vocabulary } from './settings.js';
import { squeezeStyles } from './styles.js';
import { announcementOf, mapText, pictureText } from './words.js';

/**
 * @import { MapData, MapSqueeze as Machine, Pose } from '../../types.d.ts'
 * @import { OwnMap } from './maps/files.js'
 * @import { Reading } from './reading.js'
 */

/**
 * Motion conditioned on a map, and what the condition cannot see.
 *
 * @attr preset - A place in the apartment to start from; none elsewhere.
 * @attr view - The whole map, or what is near the robot.
 *
 * @extends {FigureElement<Machine, Reading>}
 */
export class MapSqueezeElement extends FigureElement {
  static styles = [...FigureElement.styles, reserve([[0, 175], [26, 152], [33, 141], [47, 120], [57, 87]]), ...squeezeStyles];

  static declared = declared;
  static attributes = attributes;
  static own = own;
  static looks = looks;
  static vocabulary = vocabulary;

  cloud = new Cloud(this, (/** @type {Machine} */ machine) => machine.stats.gaveUp);

  /** Of the map that the robot is in. */
  picture = new FloorPicture({ bounds: new Float64Array(4), walls: new Float64Array() }, null);
  #meter = new CostMeter(this);
  #opener = new MapOpener(this);
  #handles = new RobotHandles(this);

  /** @type {FigureElement<Machine, Reading>['createMachine']} */
  createMachine = (motion, state) => {
    const machine = new motion.MapSqueeze();
    if (!state) return machine;
    return orFree(machine, () => {
      if (state.map !== null) applyMap(machine, state.map);
      machine.configure(this.settingsOf(state));
      showOnly(machine, state.shown);
    });
  };

  machineChanged() {
    const { machine } = this;
    if (!machine) return;
    this.#opener.forgive();
    this.#meter.outdate();
    this.picture = new FloorPicture(machine.plan, machine.grid);
    this.pictures = [this.picture];
  }

  /** @param {Machine} machine */
  read(machine) {
    const reading = readingOf(machine);
    this.#meter.heed(reading.config, !this.cloud.playing && !this.held);
    return reading;
  }

  get scene() {
    const { fresh } = this;
    const { index, isMarked } = this.cloud;
    this.picture.close = this.state.own.view === 'close';
    const marked = isMarked && { pose: fresh.poses.subarray(3 * index), path: this.machine?.path(index) };
    return { ...fresh, marked: marked || undefined };
  }

  get takeaway() {
    const { config, poses, verdicts } = this.fresh;
    return {
      title: this.label,
      settings: { element: this.localName, map: this.map?.name ?? null, ...config },
      columns: ['x_m', 'y_m', 'theta_rad', 'end_free', 'path_free', 'accepted'],
      row: (/** @type {number} */ i) => [
        ...poses.subarray(3 * i, 3 * i + 3),
        ...Object.values(bits).map((bit) => Math.sign(verdicts[i] & bit)),
      ],
      count: verdicts.length,
    };
  }

  announcement = announcementOf;

  get held() {
    return this.#handles.held !== undefined;
  }

  /** @param {Reading} scene */
  placeHandles({ config: { start, clearance } }) {
    this.#handles.place(start, clearance);
  }

  /** The place in the apartment that the robot starts from; null elsewhere. @returns {string | null} */
  get preset() {
    if (!this.machine) return /** @type {string | undefined} */ (this.reflection.wished('preset')) ?? null;
    if (this.map) return null;
    const { x, y, theta } = this.settings.wanted.start;
    return PRESETS.find(({ start }) => start.x === x && start.y === y && start.theta === theta)?.name ?? null;
  }

  set preset(name) {
    this.reflection.whenReady('preset', name, () => {
      const { start } = presetNamed(name);
      this.#leave();
      this.settings.assign({ start });
    });
  }

  /**
   * A map of the reader's own; null for the apartment.
   *
   * @public
   * @returns {MapData | null}
   */
  get map() {
    return this.state.own.map;
  }

  set map(map) {
    this.reflection.whenReady('map', map, () => {
      if (map === null) this.#leave();
      else this.#enter({ name: map?.name ?? '', apply: (machine) => applyMap(machine, map) });
      this.reflection.tell();
      this.settings.show();
    });
  }

  /**
   * A byte an attempt: 1 where its end is free, 2 where its path is, 4 where it is accepted.
   *
   * @public
   * @returns {Uint8Array | null}
   */
  get verdicts() {
    return this.ask((machine) => machine.verdicts);
  }

  /** The reader wants the robot in the apartment. @param {Pose} start */
  go(start) {
    this.runtime.attempt(() => this.#leave());
    this.decide({ start });
  }

  /** The reader wants the robot in a map of their own. @param {OwnMap} map */
  open(map) {
    if (!this.machine) return;
    this.runtime.attempt(() => this.#enter(map));
    this.gesture.step();
    this.commit();
  }

  /** Leaves the reader's own map, if it is there. */
  #leave() {
    const { machine } = this;
    if (!machine) return;
    this.#opener.forgive();
    if (!this.map) return;
    machine.setPlan(undefined);
    this.#moved(null);
  }

  /**
   * Puts the robot into another map. A machine of its own tries it: the present one stays as it is where
   * the map, or the place in it, is refused.
   *
   * @param {OwnMap} map
   */
  #enter(map) {
    const { motion } = this;
    if (!motion) return;
    this.settings.settle();
    let data = null;
    const next = orFree(this.createMachine(motion, this.snapshot()), (machine) => {
      map.apply(machine);
      findRoom(machine);
      showOnly(machine, this.cloud.asked);
      data = mapData(machine, map.name);
    });
    this.runtime.replace(next);
    this.#moved(data);
  }

  /** @param {MapData | null} map that the machine has now */
  #moved(map) {
    this.state.own.map = map;
    this.machineChanged();
    this.settings.stale = true;
    this.cloud.mark(-1);
  }

  /** @param {Reading} reading */
  content(reading) {
    const { config, note } = reading;
    const own = this.map;
    const map = mapText(own ? own.name || words.squeeze.pasted : words.squeeze.apartment, this.picture.plan);
    return html`
      <section
        class="machine"
        aria-label=${this.label}
        @dragover=${this.#opener.over}
        @dragleave=${this.#opener.leave}
        @drop=${this.#opener.drop}
      >
        <div class="views">
          <div class="stage" part="picture">
            ${canvas(this, this.picture, pictureText(reading, map))}
            ${this.#handles.render()}
          </div>
        </div>
        ${this.later(() => html`
        <p class="note" part="caption" ?hidden=${note === ''}>${note}</p>
        ${tally(reading)} ${placeControls(this)} ${judgeControls(this)}
        <div class="controls" part="controls">${motionControls(this)} ${cloudControls(this, SAMPLE_COUNTS)}</div>
        <div class="folds">
          ${fold(words.squeeze.keyAndSample, () => html`${legend(config)} ${markedDraw(this)}`)}
          ${fold(words.squeeze.costsLabel, () => costTable(this.#meter, config.steps))}
          ${fold(words.squeeze.own.legend, () => ownMap(this, this.#opener, map))} ${takeAlong(this)}
        </div>`)}
      </section>
    `;
  }
}

/**
 * Moves the robot to where it fits. In an occupancy grid it does so anyhow: the unknown is free there,
 * so that a place which is free may lie outside of everything that was mapped.
 *
 * @param {Machine} machine
 */
function findRoom(machine) {
  if (machine.startFree && machine.grid === null) return;
  const { freePoint, config, plan } = machine;
  const [left, bottom, right, top] = plan.bounds;
  const [x, y] = freePoint ?? [(left + right) / 2, (bottom + top) / 2];
  machine.configure({ start: { ...config.start, x, y } });
}

define('map-squeeze', MapSqueezeElement);
