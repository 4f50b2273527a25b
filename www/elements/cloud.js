/**
 * What a widget with a cloud of samples needs: settings that change once a frame, a cloud that grows in batches, and
 * words once a change has come to rest.
 *
 * @module
 */

import { WidgetElement } from './base.js';

/**
 * @typedef {object} Cloud
 * @property {() => void} free
 * @property {{ samples: number }} config
 * @property {number} shown
 * @property {(count: number) => number} grow
 * @property {() => void} restart
 * @property {(settings: any) => void} configure
 */

/** Steps that a cloud grows in. */
const BATCHES = 150;

/**
 * @template {Cloud} Machine
 * @template {object} Settings
 * @extends {WidgetElement<Machine>}
 */
export class CloudElement extends WidgetElement {
  playing = false;
  /** Whether the machine has to be asked again. */
  stale = true;
  announcement = '';
  /** @type {Partial<Settings>} changes that wait for the next frame */
  #pending = {};
  #toAnnounce = false;

  /** Asks the machine for everything that is shown. */
  read() {}

  /** Called when other settings have taken effect. */
  configured() {}

  /** Whether the cloud will not grow any more. */
  get complete() {
    return this.machine !== undefined && this.machine.shown === this.machine.config.samples;
  }

  /** How many samples a step adds. */
  get batch() {
    return Math.ceil((this.machine?.config.samples ?? 0) / BATCHES);
  }

  /** Starts a machine's show: it grows before the reader's eyes, or stands there for one who wants less motion. */
  begin() {
    this.stale = true;
    this.#pending = {};
    if (!this.calm) {
      this.machine?.restart();
      this.playing = true;
    }
    this.read();
  }

  /** The settings with the changes that wait. @returns {Settings} */
  wanted() {
    const { config } = /** @type {Machine} */ (this.machine);
    return /** @type {Settings} */ (/** @type {unknown} */ ({ ...config, ...this.#pending }));
  }

  /**
   * Wants other settings from the next frame on: a drag costs one configuration a frame.
   *
   * @param {Partial<Settings> | ((wanted: Settings) => Partial<Settings>)} change
   */
  change(change) {
    if (!this.machine) return;
    Object.assign(this.#pending, typeof change === 'function' ? change(this.wanted()) : change);
    this.wake();
  }

  configure() {
    if (Object.keys(this.#pending).length === 0) return;
    const pending = this.#pending;
    this.#pending = {};
    this.machine?.configure(pending);
    this.stale = true;
    this.configured();
  }

  /** What was changed has come to rest: put it into effect and say what it led to. */
  commit() {
    this.configure();
    this.#toAnnounce = true;
    this.stale = true;
    this.wake();
  }

  /** @param {() => string} words said if something has come to rest since they were last asked for */
  announce(words) {
    if (!this.#toAnnounce) return;
    this.#toAnnounce = false;
    this.announcement = words();
  }

  growOn() {
    if (!this.machine) return;
    this.stale = true;
    this.machine.grow(this.batch);
    if (!this.complete) return;
    this.playing = false;
    this.#toAnnounce = true;
  }

  play() {
    if (!this.playing && this.complete) this.machine?.restart();
    this.playing = !this.playing;
    this.commit();
  }

  step() {
    this.playing = false;
    this.machine?.grow(this.batch);
    this.commit();
  }

  reset() {
    this.playing = false;
    this.machine?.restart();
    this.commit();
  }

  reseed() {
    if (!this.motion) return;
    const seed = /** @type {unknown} */ ({ seed: this.motion.randomSeed() });
    this.change(/** @type {Partial<Settings>} */ (seed));
    this.commit();
  }
}
