/**
 * <map-squeeze>: motion conditioned on a map, and what the condition cannot see.
 *
 * @module
 */

import { html, nothing } from 'lit';
import { words } from '../messages/registry.js';
import { theme } from '../ui/theme.js';
import { CloudElement } from './cloud.js';
import { judgeControls, motionControls, ownMap, placeControls } from './map-squeeze-controls.js';
import { CostMeter } from './map-squeeze-cost.js';
import { MapFileError, readMapFiles, readPlan } from './map-squeeze-files.js';
import { RobotHandles } from './map-squeeze-handles.js';
import { FloorPicture, sort } from './map-squeeze-picture.js';
import { costTable, key, markedDraw, tally } from './map-squeeze-readouts.js';
import { squeezeStyles } from './map-squeeze-styles.js';
import {
  SAMPLERS,
  SAMPLE_COUNTS,
  announcementOf,
  mapText,
  noteOn,
  pictureText,
  verdictText,
} from './map-squeeze-words.js';

/**
 * @typedef {import('../types.d.ts').MapSqueeze} MapSqueeze
 * @typedef {import('../types.d.ts').Motion} Motion
 * @typedef {import('../types.d.ts').SqueezeSettings} Settings
 * @typedef {import('./map-squeeze-files.js').OwnMap} OwnMap
 */

/** How near to a sample the pointer must be to mark it, CSS pixels. */
const REACH = 12;

/** Paths drawn at most: more would be one blot, and cost more than a frame. */
const MOST_PATHS = 150;

/** @extends {CloudElement<MapSqueeze, Settings>} */
export class MapSqueezeElement extends CloudElement {
  static styles = [theme, ...squeezeStyles];

  /** The draw that is marked; −1 for none. */
  #marked = -1;
  /** What the machine said when it was last asked. @type {ReturnType<typeof read> | undefined} */
  #figures;
  /** @type {OwnMap | undefined} the reader's; none for the apartment */
  #map;
  /** @type {import('../types.d.ts').Plan} */
  #plan = { bounds: new Float64Array(4), walls: new Float64Array() };
  /** Why the latest map was refused. @type {(() => string) | undefined} */
  #complaint;
  /** The latest attempt to read files: an earlier one that ends later is void. */
  #reading = 0;
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
    change: (/** @type {import('./map-squeeze-controls.js').Change} */ change) => this.change(change),
    commit: () => this.commit(),
  };

  /**
   * @param {Motion} motion
   * @param {Partial<Settings>} [settings]
   */
  createMachine(motion, settings) {
    return new motion.MapSqueeze(settings);
  }

  machineReady() {
    this.#marked = -1;
    const { machine } = this;
    if (!machine) return;
    this.#map?.apply(machine);
    this.#takePlan(machine);
    this.begin();
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
    if (this.stale) this.read();

    const figures = /** @type {ReturnType<typeof read>} */ (this.#figures);
    const marked = this.#isMarked
      ? { pose: figures.poses.subarray(3 * this.#marked), path: machine.path(this.#marked) }
      : undefined;
    this.#picture.close = this.#close;
    const scene = { ...figures, marked };
    const moving = this.#picture.draw(this.#canvas, scene, palette, elapsed, {
      still: this.#handles.held !== undefined,
      atOnce: this.calm,
    });
    this.#handles.place(this.renderRoot, figures.config.start, figures.config.clearance);
    this.requestUpdate();
    if (moving || this.playing) this.wake();
  }

  read() {
    if (!this.machine) return;
    this.#figures = read(this.machine);
    this.stale = false;
    if (!this.playing && this.#handles.held === undefined) this.#measureSoon();
    const { config, stats, note } = this.#figures;
    this.announce(() => announcementOf(config, stats, note));
  }

  #measureSoon() {
    this.#meter.measureSoon(
      () => this.machine,
      SAMPLERS,
      () => this.requestUpdate(),
    );
  }

  /** @param {Settings['start']} start in the apartment */
  #go(start) {
    this.#leaveOwn();
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
    this.#complaint = undefined;
    if (!this.#map) return;
    machine.setPlan(undefined);
    this.#map = undefined;
    this.#takePlan(machine);
    this.#marked = -1;
  }

  /**
   * Puts the robot into a map of the reader's. A machine of its own tries it: the present one stays as
   * it is where the map, or the place in it, is refused.
   *
   * @param {OwnMap} map
   */
  #enter(map) {
    const { machine, motion } = this;
    if (!machine || !motion) return;
    this.configure();
    const next = this.createMachine(motion, machine.config);
    try {
      map.apply(next);
      findRoom(next);
      if (!this.complete) {
        next.restart();
        next.grow(machine.shown);
      }
    } catch (error) {
      next.free();
      throw error;
    }
    this.#meter.outdate();
    machine.free();
    this.machine = next;
    this.#map = map;
    this.#complaint = undefined;
    this.#takePlan(next);
    this.#marked = -1;
  }

  /** @param {MapSqueeze} machine */
  #takePlan(machine) {
    this.#plan = machine.plan;
    this.#picture = new FloorPicture(this.#plan, machine.grid);
  }

  /**
   * Puts the robot into a map of the reader's, or says why not.
   *
   * @param {() => OwnMap | Promise<OwnMap>} find
   */
  async #openMap(find) {
    const reading = ++this.#reading;
    try {
      const map = await find();
      if (reading !== this.#reading || !this.machine) return;
      this.#enter(map);
      this.commit();
    } catch (error) {
      if (reading !== this.#reading) return;
      const reason = error instanceof Error ? error.message : String(error);
      this.#complaint = () => {
        const { refused } = words.squeeze;
        return error instanceof MapFileError ? error.sentence(refused) : refused.cannot(reason);
      };
      this.requestUpdate();
    }
  }

  #paste() {
    const field = /** @type {HTMLTextAreaElement} */ (this.renderRoot.querySelector('#map-text'));
    this.#openMap(() => readPlan(words.squeeze.pasted, field.value));
  }

  /** @param {DragEvent} event */
  #dragOver(event) {
    if (!event.dataTransfer?.types.includes('Files')) return;
    event.preventDefault();
    /** @type {HTMLElement} */ (event.currentTarget).classList.add('dropping');
  }

  /** @param {DragEvent} event */
  #dragLeave(event) {
    const section = /** @type {HTMLElement} */ (event.currentTarget);
    const to = /** @type {Node | null} */ (event.relatedTarget);
    if (!section.contains(to)) section.classList.remove('dropping');
  }

  /** @param {DragEvent} event */
  #drop(event) {
    /** @type {HTMLElement} */ (event.currentTarget).classList.remove('dropping');
    if (!event.dataTransfer?.types.includes('Files')) return;
    // The browser would leave the page for the file.
    event.preventDefault();
    const files = [...event.dataTransfer.files];
    this.#openMap(() => readMapFiles(files));
  }

  /** @param {number} index −1 for none */
  #mark(index) {
    if (index === this.#marked) return;
    this.#marked = index;
    this.wake();
  }

  get #isMarked() {
    return this.#marked >= 0 && this.#marked < (this.machine?.shown ?? 0);
  }

  /** @param {PointerEvent} event */
  #point(event) {
    if (!this.machine || this.#handles.held) return;
    const { view } = this.#picture;
    const [x, y] = [view.toWorldX(event.offsetX), view.toWorldY(event.offsetY)];
    const index = this.machine.nearest(x, y, REACH / view.scaleX);
    if (index >= 0 || event.type === 'pointerdown') this.#mark(index);
  }

  get #canvas() {
    return /** @type {HTMLCanvasElement} */ (this.renderRoot.querySelector('canvas.plane'));
  }

  renderWidget() {
    const { machine, motion } = this;
    if (!machine || !motion || !this.#figures) return nothing;
    const { config, stats, note, verdicts, paths } = this.#figures;
    const map = mapText(this.#map?.name ?? words.squeeze.apartment, this.#plan);
    const own = this.#map !== undefined;
    const look = (/** @type {boolean} */ close) => {
      this.#close = close;
      this.wake();
    };
    return html`
      <section
        class="machine"
        aria-label=${words.squeeze.title}
        @dragover=${this.#dragOver}
        @dragleave=${this.#dragLeave}
        @drop=${this.#drop}
      >
        <div class="floor">
          ${this.#stage(pictureText(config, stats, map, note))}
          <p class="note" ?hidden=${note === ''}>${note}</p>
          ${key(config)} ${tally(stats, config, paths.length)}
          ${markedDraw({
            index: this.#marked,
            shown: stats.attempts,
            verdict: this.#isMarked ? verdictText(verdicts[this.#marked], config) : '',
            mark: (index) => this.#mark(index),
          })}
          ${this.cloudControls(words.squeeze.cloud, SAMPLE_COUNTS)}
        </div>
        <div class="controls">
          ${placeControls(config, { own, close: this.#close, look }, motion.MapSqueeze.presets, (start) => this.#go(start))}
          ${judgeControls(config, this.#actions)}
          ${motionControls(config, motion.MapSqueeze, this.#actions)} ${costTable(this.#meter, config.steps)}
        </div>
        ${ownMap({
          map,
          own,
          complaint: this.#complaint?.() ?? '',
          choose: (files) => this.#openMap(() => readMapFiles(files)),
          paste: () => this.#paste(),
          leave: () => this.#leaveMap(),
        })}
        <p class="visually-hidden" role="status">${this.announcement}</p>
      </section>
    `;
  }

  /** @param {string} description */
  #stage(description) {
    return html`<div class="stage">
      <canvas
        class="plane"
        role="img"
        aria-label=${description}
        @pointermove=${this.#point}
        @pointerdown=${this.#point}
      ></canvas>
      ${this.#handles.render(this.wanted().start)}
    </div>`;
  }
}

/**
 * Moves the robot to where it fits. In an occupancy grid it does so anyhow: the unknown is free there,
 * so that a place which is free may lie outside of everything that was mapped.
 *
 * @param {MapSqueeze} machine
 */
function findRoom(machine) {
  if (machine.startFree && machine.grid === null) return;
  const { freePoint, config, plan } = machine;
  const [left, bottom, right, top] = plan.bounds;
  const [x, y] = freePoint ?? [(left + right) / 2, (bottom + top) / 2];
  machine.configure({ start: { ...config.start, x, y } });
}

/**
 * Everything that the picture and the figures need of the machine, asked once a change.
 *
 * @param {MapSqueeze} machine
 */
function read(machine) {
  const { config, stats, verdicts, poses, commanded, startFree } = machine;
  const sorted = sort(poses, verdicts);
  return {
    config,
    stats,
    verdicts,
    poses,
    commanded,
    sorted,
    paths: sorted.through.slice(0, MOST_PATHS).map((index) => machine.path(index)),
    note: noteOn(config, stats, startFree),
  };
}

// A page may carry the script twice.
if (!customElements.get('map-squeeze')) {
  customElements.define('map-squeeze', MapSqueezeElement);
}
