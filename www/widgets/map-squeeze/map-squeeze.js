/**
 * <map-squeeze>: motion conditioned on a map, and what the condition cannot see.
 *
 * @module
 */

import { html, nothing } from 'lit';
import { speak, words } from '../../messages/registry.js';
import { theme } from '../../ui/theme.js';
import { CloudElement, showOnly } from '../../figure/cloud.js';
import { define } from '../../figure/settings.js';
import { judgeControls, motionControls, ownMap, placeControls } from './controls.js';
import { CostMeter } from './cost.js';
import { applyMap, mapData } from './maps/data.js';
import { figuresOf } from './figures.js';
import { RobotHandles } from './handles.js';
import { MapOpener } from './maps/open.js';
import { FloorPicture } from './picture.js';
import { costTable, key, markedDraw, tally } from './readouts.js';
import { squeezeStyles } from './styles.js';
import { announcementOf, mapText, pictureText, verdictText } from './words.js';
import { ATTRIBUTES, SAMPLERS, SAMPLE_COUNTS, VERDICT, VIEWS, findRoom, machineIn, openingOf } from './settings.js';
import { reserve } from '../../figure/page/reserve.js';
import { schemeStyles } from '../../figure/page/scheme.js';
import { word } from '../../figure/checks.js';

/**
 * @typedef {import('../../types.d.ts').MapSqueeze} MapSqueeze
 * @typedef {import('../../types.d.ts').Motion} Motion
 * @typedef {import('../../types.d.ts').SqueezeSettings} Settings
 * @typedef {import('../../types.d.ts').MapData} MapData
 * @typedef {import('./maps/files.js').OwnMap} OwnMap
 * @typedef {import('../../figure/state.js').State} State
 */

const ROOM = reserve([[0, 175], [26, 152], [33, 141], [47, 120], [57, 87]]);

/**
 * Motion conditioned on a map, and what the condition cannot see.
 *
 * Attributes and properties say what the figure shows, whoever has changed it. What is out of range is
 * refused with a TypeError or RangeError that names the field, the value and what is allowed: a property
 * throws it, an attribute reports it by `error`, and the last good value stays.
 *
 * @attr {"doorway" | "wall" | "corridor"} preset - A place in the apartment to start from; none elsewhere.
 * @attr {number} x - Where the robot starts, m.
 * @attr {number} y - Where the robot starts, m.
 * @attr {number} theta - Its heading there, rad.
 * @attr {number} v - Commanded speed, m/s.
 * @attr {number} omega - Commanded turn rate, rad/s, positive to the left.
 * @attr {number} dt - Duration of the command, s.
 * @attr {number} noise - Level n: the first four noise parameters are n, the others n/4.
 * @attr {number} clearance - Radius of the robot, m.
 * @attr {"true" | "false"} conditioned - Whether draws are judged by the map at all; they are unless it says false.
 * @attr {"endpoint" | "whole-arc" | "sub-stepped"} sampler - How they are judged.
 * @attr {number} steps - Parts of the command, for the sub-stepped sampler.
 * @attr {number} samples - Motions tried, 1 to 1 000 000.
 * @attr {number} seed - The same seed draws the same motions.
 * @attr {"whole" | "close"} view - The whole map, or what is near the robot.
 * @attr {"auto" | "light" | "dark"} theme - Auto, the default, is as the surroundings are.
 * @attr {boolean} share - Keeps the state in the fragment of the page's address, and opens in the state that it carries.
 *
 * @fires load - The figure is ready.
 * @fires {ErrorEvent} error - Something was refused, or the core failed and was started again, or the figure cannot run.
 * @fires input - The reader has changed something, and may go on.
 * @fires change - What the reader changed has come to rest.
 * @fires {CustomEvent<SqueezeStats>} stats - There are fresh statistics; the detail has them.
 *
 * @csspart picture - A canvas with what stands on it.
 * @csspart caption - The sentences below a picture.
 * @csspart legend - What the lines and dots are, and which are shown.
 * @csspart controls - All controls.
 * @csspart slider - A slider with its name, value and effect.
 * @csspart button - A button.
 * @csspart readouts - The figures about the cloud.
 * @csspart table - A table of figures.
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
 * @extends {CloudElement<MapSqueeze, Settings>}
 */
export class MapSqueezeElement extends CloudElement {
  static styles = [theme, schemeStyles, ROOM, ...squeezeStyles];

  static attributes = ATTRIBUTES;
  static settings = ['start', 'command', 'alphas'];

  /** What the machine said when it was last asked. @type {ReturnType<typeof figuresOf> | undefined} */
  #figures;
  /** The reader's own; null for the apartment. @type {MapData | null} */
  #map = null;
  /** @type {import('../../types.d.ts').Plan} */
  #plan = { bounds: new Float64Array(4), walls: new Float64Array() };
  #opener = new MapOpener(
    (map) => {
      if (!this.machine) return;
      this.attempt(() => this.#enter(map));
      this.touch();
      this.commit();
    },
    () => this.requestUpdate(),
  );
  #close = false;
  #picture = new FloorPicture(this.#plan, null);
  #meter = new CostMeter();
  #handles = new RobotHandles({
    view: () => this.#picture.view,
    start: () => this.wanted().start,
    bounds: () => this.#plan.bounds,
    change: (start) => this.change({ start }),
    commit: () => this.commit(),
  });

  #actions = {
    change: (/** @type {import('./controls.js').Change} */ change) => this.change(change),
    commit: () => this.commit(),
  };

  /**
   * @param {Motion} motion
   * @param {State} [state]
   */
  build(motion, state) {
    return machineIn(motion, state);
  }

  /** @param {Motion} motion */
  opening(motion) {
    return openingOf(motion);
  }

  machineReady() {
    this.#takePlan();
    super.machineReady();
  }

  parting() {
    super.parting();
    this.#meter.outdate();
  }

  snapshot() {
    const { start, command, alphas, clearance, conditioned, sampler, steps } = /** @type {MapSqueeze} */ (this.machine).config;
    return {
      ...super.snapshot(),
      start,
      command,
      alphas,
      clearance,
      conditioned,
      sampler,
      steps,
      view: this.view,
      map: this.#map,
    };
  }

  /**
   * @param {State} state
   * @param {MapSqueeze} machine
   */
  checked(state, machine) {
    const { view, map } = super.checked(state, machine);
    word('state.view', view, VIEWS);
    return map === null ? state : { ...state, map: mapData(machine, map.name ?? '') };
  }

  /** @param {State} state */
  adopt(state) {
    super.adopt(state);
    this.#close = state.view === 'close';
    this.#map = state.map;
    this.#opener.forgive();
    this.#takePlan();
  }

  get usual() {
    return { preset: this.motion?.MapSqueeze.presets[0].name, view: 'whole' };
  }

  /** The place in the apartment that the robot starts from; null elsewhere. @returns {string | null} */
  get preset() {
    if (!this.machine || !this.motion) return /** @type {string | undefined} */ (this.wished('preset')) ?? null;
    if (this.#map) return null;
    const { x, y, theta } = this.wanted().start;
    const holds = (/** @type {Settings['start']} */ start) => start.x === x && start.y === y && start.theta === theta;
    return this.motion.MapSqueeze.presets.find(({ start }) => holds(start))?.name ?? null;
  }

  set preset(name) {
    this.whenReady('preset', name, () => {
      const { presets } = /** @type {Motion} */ (this.motion).MapSqueeze;
      const known = word('preset', name, presets.map((preset) => preset.name));
      this.#leaveOwn();
      for (const preset of presets) if (preset.name === known) this.assign({ start: preset.start });
    });
  }

  /** Whether the whole map is shown, or what is near the robot. @returns {'whole' | 'close'} */
  get view() {
    return this.#close ? 'close' : 'whole';
  }

  set view(view) {
    this.#close = word('view', view, VIEWS) === 'close';
    this.retell();
  }

  /** The map of the reader's own; null for the apartment. @returns {MapData | null} */
  get map() {
    return this.#map;
  }

  set map(map) {
    this.whenReady('map', map, () => this.#put(map));
  }

  /** A byte an attempt: 1 where its end is free, 2 where its path is, 4 where it is accepted. */
  get verdicts() {
    return this.ask((machine) => machine.verdicts);
  }

  get complete() {
    return super.complete || this.machine?.stats.gaveUp === true;
  }

  configured() {
    this.#meter.outdate();
  }

  /** @param {number} elapsed milliseconds */
  draw(elapsed) {
    const { machine, palette } = this;
    if (!machine || !palette) return;
    this.configure();
    if (this.playing) this.growOn();
    const scene = this.#scene(machine);
    const moving = this.#picture.draw(this.#canvas, scene, palette, {
      elapsed,
      still: this.#handles.held !== undefined,
      atOnce: this.calm,
    });
    this.#handles.place(this.renderRoot, scene.config.start, scene.config.clearance);
    this.requestUpdate();
    if (moving || this.playing) this.wake();
  }

  /** @param {MapSqueeze} machine */
  #scene(machine) {
    this.configure();
    if (this.stale) this.read();
    const figures = /** @type {ReturnType<typeof figuresOf>} */ (this.#figures);
    const marked = this.#isMarked
      ? { pose: figures.poses.subarray(3 * this.markedIndex), path: machine.path(this.markedIndex) }
      : undefined;
    this.#picture.close = this.#close;
    return { ...figures, marked };
  }

  /** @returns {import('../../figure/takeaway/export.js').Figure} */
  figure() {
    const { machine } = this;
    if (!machine) return super.figure();
    speak(this);
    const palette = this.palette ?? this.look();
    const scene = this.#scene(machine);
    const { poses, verdicts } = scene;
    return {
      canvas: this.#canvas,
      palette,
      paint: (surface) => {
        this.#picture.draw(surface, scene, palette, { atOnce: true });
      },
      settings: { element: this.localName, map: this.#map?.name ?? null, ...scene.config },
      title: words.squeeze.title,
      columns: ['x_m', 'y_m', 'theta_rad', 'end_free', 'path_free', 'accepted'],
      row: (i) => [
        ...poses.subarray(3 * i, 3 * i + 3),
        ...[VERDICT.endFree, VERDICT.pathFree, VERDICT.accepted].map((bit) => Math.sign(verdicts[i] & bit)),
      ],
      count: verdicts.length,
    };
  }

  read() {
    if (!this.machine) return;
    this.#figures = figuresOf(this.machine);
    this.stale = false;
    if (!this.playing && this.#handles.held === undefined) this.#measureSoon();
    const { config, stats, note } = this.#figures;
    this.announce(() => announcementOf(config, stats, note));
    this.refreshed();
  }

  #measureSoon() {
    this.#meter.measureSoon(
      () => this.machine,
      SAMPLERS,
      () => this.requestUpdate(),
      (work) => this.attempt(work),
    );
  }

  /** @param {Settings['start']} start in the apartment */
  #go(start) {
    this.attempt(() => this.#leaveOwn());
    this.change({ start });
    this.commit();
  }

  #leaveMap() {
    const [first] = this.motion?.MapSqueeze.presets ?? [];
    if (first) this.#go(first.start);
  }

  #leaveOwn() {
    const { machine } = this;
    if (!machine) return;
    this.#opener.forgive();
    if (!this.#map) return;
    machine.setPlan(undefined);
    this.#map = null;
    this.stale = true;
    this.#takePlan();
    this.mark(-1);
  }

  /**
   * Puts the robot into another map. A machine of its own tries it: the present one stays as it is where
   * the map, or the place in it, is refused.
   *
   * @param {OwnMap} map
   */
  #enter(map) {
    const { machine, motion } = this;
    if (!machine || !motion) return;
    this.configure();
    const next = this.build(motion, this.snapshot());
    try {
      map.apply(next);
      findRoom(next);
      showOnly(next, this.asked);
      this.#map = mapData(next, map.name);
    } catch (error) {
      next.free();
      throw error;
    }
    this.#meter.outdate();
    machine.free();
    this.machine = next;
    this.stale = true;
    this.#opener.forgive();
    this.#takePlan();
    this.mark(-1);
  }

  /** @param {MapData | null} map that the page gives */
  #put(map) {
    if (map === null) this.#leaveOwn();
    else this.#enter({ name: map?.name ?? '', apply: (machine) => applyMap(machine, map) });
    this.tell();
    this.refresh();
  }

  #takePlan() {
    const { machine } = this;
    if (!machine) return;
    this.#plan = machine.plan;
    this.#picture = new FloorPicture(this.#plan, machine.grid);
  }

  get #isMarked() {
    return this.markedIndex >= 0 && this.markedIndex < (this.machine?.shown ?? 0);
  }

  /** @param {PointerEvent} event */
  #point(event) {
    this.attempt(() => {
      // A finger that moves scrolls the page; one that taps comes as a click.
      if (!this.machine || this.#handles.held || (event.pointerType === 'touch' && event.type !== 'click')) return;
      const index = this.#picture.nearest(this.machine, event.offsetX, event.offsetY);
      if (index >= 0 || event.type === 'click') this.mark(index);
    });
  }

  get #canvas() {
    return /** @type {HTMLCanvasElement} */ (this.renderRoot.querySelector('canvas.plane'));
  }

  renderWidget() {
    const { machine, motion } = this;
    if (!machine || !motion || !this.#figures) return nothing;
    const { config, stats, note, verdicts, paths } = this.#figures;
    const map = mapText(this.#map ? this.#map.name || words.squeeze.pasted : words.squeeze.apartment, this.#plan);
    const own = this.#map !== null;
    const look = (/** @type {boolean} */ close) => {
      this.#close = close;
      this.touch();
      this.rest();
    };
    return html`
      <section
        class="machine"
        aria-label=${words.squeeze.title}
        @dragover=${this.#opener.over}
        @dragleave=${this.#opener.leave}
        @drop=${this.#opener.drop}
      >
        <div class="floor">
          ${this.#stage(pictureText(config, stats, map, note))}
          <p class="note" part="caption" ?hidden=${note === ''}>${note}</p>
          ${key(config)} ${tally(stats, config, paths.length)}
          ${markedDraw({
            index: this.markedIndex,
            shown: stats.attempts,
            verdict: this.#isMarked ? verdictText(verdicts[this.markedIndex], config) : '',
            mark: (index) => this.mark(index),
          })}
          ${this.cloudControls(words.squeeze, SAMPLE_COUNTS)}
        </div>
        <div class="controls" part="controls">
          ${placeControls(config, { own, close: this.#close, look }, motion.MapSqueeze.presets, (start) => this.#go(start))}
          ${judgeControls(config, this.#actions)}
          ${motionControls(config, motion.MapSqueeze, this.#actions)} ${costTable(this.#meter, config.steps)}
        </div>
        ${ownMap({
          map,
          own,
          complaint: this.#opener.complaint,
          choose: (files) => this.#opener.choose(files),
          paste: () => this.#opener.paste(/** @type {HTMLTextAreaElement} */ (this.renderRoot.querySelector('#map-text')).value),
          leave: () => this.#leaveMap(),
        })}
        <p class="visually-hidden" role="status">${this.announcement}</p>
      </section>
    `;
  }

  /** @param {string} description */
  #stage(description) {
    return html`<div class="stage" part="picture">
      <canvas
        class="plane"
        role="img"
        aria-label=${description}
        @pointermove=${this.#point}
        @click=${this.#point}
      ></canvas>
      ${this.#handles.render(this.wanted().start)}
    </div>`;
  }
}

define('map-squeeze', MapSqueezeElement);
