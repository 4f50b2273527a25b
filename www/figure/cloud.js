/**
 * What a widget with a cloud of samples needs: a cloud that grows in batches, and words once a change has come to rest.
 *
 * @module
 */

import { html } from 'lit';
import { words } from '../messages/registry.js';
import { button, sliderRow } from '../ui/controls.js';
import { counted } from '../ui/format.js';
import { CopyMenu } from './takeaway/copy.js';
import { csvOf, exportMenu, pngOf, svgOf } from './takeaway/export.js';
import { onPrint } from './page/print.js';
import { truth, whole as wholeNumber } from './checks.js';
import { StatefulElement } from './state.js';

/**
 * @typedef {object} Cloud
 * @property {() => void} free
 * @property {{ samples: number, seed: number }} config
 * @property {object} stats
 * @property {number} shown
 * @property {Float64Array} poses
 * @property {(count: number) => number} grow
 * @property {(count: number) => void} [beginToGrow] as grow, where it may take longer than a frame
 * @property {() => void} restart
 * @property {(settings: any) => void} configure
 *
 * @typedef {{ legend: string, play: string, step: (batch: string) => string, reset: string, reseed: string }} CloudWords
 */

/** Steps that a cloud grows in. */
const BATCHES = 150;

/**
 * @template {Cloud} Machine
 * @template {object} Settings
 * @extends {StatefulElement<Machine, Settings>}
 */
export class CloudElement extends StatefulElement {
  playing = false;
  announcement = '';
  /** The sample that is marked; −1 for none. */
  markedIndex = -1;
  #toAnnounce = false;
  #copies = new CopyMenu(this, () => this.requestUpdate());

  /** Ends listening for the printer. @type {(() => void) | undefined} */
  #unprint;

  connectedCallback() {
    super.connectedCallback();
    this.#unprint = onPrint((printing) => this.#print(printing));
  }

  disconnectedCallback() {
    super.disconnectedCallback();
    this.#unprint?.();
  }

  /**
   * Paper is light, whatever the screen is.
   *
   * @param {boolean} printing
   */
  #print(printing) {
    const surface = /** @type {HTMLElement | null} */ (this.renderRoot.querySelector('.surface'));
    if (!surface) return;
    surface.style.colorScheme = printing ? 'light' : '';
    this.palette = undefined;
    // At once: the printer waits for no frame.
    this.frame(0);
  }

  /** What there is to take along, with every change so far in effect. @returns {import('./takeaway/export.js').Figure} */
  figure() {
    throw new Error('There is no figure yet: it is there from the load event on.');
  }

  /** The picture with twice the pixels of the screen. @returns {Promise<Blob>} image/png */
  async toPNG() {
    return pngOf(this.figure());
  }

  /** The picture as vector graphics, with a title and a description. @returns {string} */
  toSVG() {
    return svgOf(this.figure());
  }

  /** Every sample shown, after a line with the settings and the seed. @returns {string} */
  toCSV() {
    return csvOf(this.figure());
  }

  relabel() {
    this.stale = true;
    super.relabel();
  }

  /** Whether the cloud will not grow any more. */
  get complete() {
    return this.machine !== undefined && this.machine.shown === this.machine.config.samples;
  }

  /** How many samples a step adds. */
  get batch() {
    return Math.ceil((this.machine?.config.samples ?? 0) / BATCHES);
  }

  /**
   * Starts a machine's show: it grows before the reader's eyes, or stands there for one who wants less motion.
   *
   * @param {import('./state.js').State} [state] that it is in, if it is not the opening
   */
  begin(state) {
    if (!state && !this.calm) this.machine?.restart();
    this.playing = state ? state.playing : true;
    if (this.calm && this.playing) {
      this.playing = false;
      this.machine?.grow(this.machine.config.samples);
    }
    this.read();
  }

  /** How many samples have been asked for so far: all of them where the machine has given up before. */
  get asked() {
    return this.complete ? (this.machine?.config.samples ?? 0) : (this.machine?.shown ?? 0);
  }

  snapshot() {
    const { samples, seed } = /** @type {Machine} */ (this.machine).config;
    return { ...super.snapshot(), samples, seed, shown: this.asked, playing: this.playing, marked: this.marked };
  }

  /**
   * @param {import('./state.js').State} present
   * @param {import('./state.js').State} given
   */
  completed(present, given) {
    const { samples = present.samples } = given;
    const shown = present.shown === present.samples ? samples : Math.min(present.shown, samples);
    const marked = present.marked !== null && present.marked < shown ? present.marked : null;
    return { shown, marked, ...given };
  }

  /**
   * @param {import('./state.js').State} state
   * @param {Machine} machine
   */
  checked(state, machine) {
    const { shown, playing, marked } = super.checked(state, machine);
    wholeNumber('state.shown', shown, 0, machine.config.samples);
    truth('state.playing', playing);
    if (marked !== null) wholeNumber('state.marked', marked, 0, machine.shown - 1);
    return state;
  }

  /** @param {import('./state.js').State} state */
  adopt(state) {
    super.adopt(state);
    this.markedIndex = state.marked ?? -1;
  }

  /** @param {number} index −1 for none */
  mark(index) {
    if (index === this.markedIndex) return;
    this.markedIndex = index;
    this.wake();
  }

  /** The sample that is marked, counted from 0; null for none. @returns {number | null} */
  get marked() {
    return this.markedIndex < 0 ? null : this.markedIndex;
  }

  set marked(marked) {
    this.whenReady('marked', marked, () => {
      this.mark(marked === null ? -1 : wholeNumber('marked', marked, 0, (this.machine?.shown ?? 0) - 1));
    });
  }

  /** x, y (m), θ (rad) of each sample shown; a copy. */
  get poses() {
    return this.ask((machine) => machine.poses);
  }

  /** What was changed has come to rest: put it into effect and say what it led to. */
  commit() {
    this.attempt(() => this.configure());
    this.#toAnnounce = true;
    this.stale = true;
    this.rest();
  }

  /** @param {() => string} say what is said if something has come to rest since they were last asked for */
  announce(say) {
    if (!this.#toAnnounce) return;
    this.#toAnnounce = false;
    this.announcement = say();
  }

  /** @returns {boolean} whether there is a larger cloud now: of a large one it may take more than a frame */
  growOn() {
    const { machine } = this;
    if (!machine) return true;
    if (!this.complete) {
      if (machine.beginToGrow) machine.beginToGrow(this.batch);
      else machine.grow(this.batch);
      this.work();
      if (!this.settle()) return false;
    }
    this.stale = true;
    if (this.complete) {
      this.playing = false;
      this.#toAnnounce = true;
    }
    return true;
  }

  play() {
    this.#turn(() => {
      if (!this.playing && this.complete) this.machine?.restart();
      this.playing = !this.playing;
    });
  }

  step() {
    this.#turn(() => {
      this.playing = false;
      this.machine?.grow(this.batch);
    });
  }

  reset() {
    this.#turn(() => {
      this.playing = false;
      this.machine?.restart();
    });
  }

  reseed() {
    this.attempt(() => {
      if (!this.motion) return;
      const seed = /** @type {unknown} */ ({ seed: this.motion.randomSeed() });
      this.change(/** @type {Partial<Settings>} */ (seed));
      this.commit();
    });
  }

  /** @param {() => void} act the reader's, on the growth of the cloud */
  #turn(act) {
    this.attempt(() => {
      act();
      this.touch();
      this.commit();
    });
  }

  /**
   * Growth, seed and size of the cloud.
   *
   * @param {{ cloud: CloudWords, settings: { samples: { name: string, effect: string } } }} say
   * @param {readonly number[]} counts the sizes that the slider offers
   */
  cloudControls({ cloud: say, settings }, counts) {
    const { samples, seed } = /** @type {Machine} */ (this.machine).config;
    const above = counts.findIndex((count) => count >= samples);
    const nearest = above < 0 ? counts.length - 1 : above;
    return html`<fieldset class="cloud">
      <legend class="visually-hidden">${say.legend}</legend>
      <div class="buttons">
        ${button(this.playing ? words.pause : words.play, () => this.play(), { title: say.play })}
        ${button(words.step, () => this.step(), { title: say.step(counted(this.batch)), disabled: this.complete })}
        ${button(words.reset, () => this.reset(), { title: say.reset })}
        ${button(words.newSeed, () => this.reseed(), { title: say.reseed })}
        <span class="seed">${words.seed(seed)}</span>
      </div>
      ${sliderRow({
        id: 'samples',
        symbol: html`<i>N</i>`,
        name: settings.samples.name,
        value: nearest,
        min: 0,
        max: counts.length - 1,
        step: 1,
        show: (index) => counted(index === nearest ? samples : counts[index]),
        effect: settings.samples.effect,
        role: 'truth',
        input: (value) => {
          const size = /** @type {unknown} */ ({ samples: counts[value] });
          this.change(/** @type {Partial<Settings>} */ (size));
        },
        commit: () => this.commit(),
      })}
      ${exportMenu(this, seed)} ${this.#copies.render()}
    </fieldset>`;
  }
}

/**
 * Leaves of a machine's cloud the first samples only.
 *
 * @param {Cloud} machine
 * @param {number} shown
 */
export function showOnly(machine, shown) {
  if (shown >= machine.config.samples) return;
  machine.restart();
  machine.grow(shown);
}
