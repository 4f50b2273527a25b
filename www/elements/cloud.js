/**
 * What a widget with a cloud of samples needs: settings that change once a frame, a cloud that grows in batches, and
 * words once a change has come to rest.
 *
 * @module
 */

import { html } from 'lit';
import { words } from '../messages/registry.js';
import { button, sliderRow } from '../ui/controls.js';
import { whole } from '../ui/format.js';
import { WidgetElement } from './base.js';

/**
 * @typedef {object} Cloud
 * @property {() => void} free
 * @property {{ samples: number, seed: number }} config
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

  /** @param {() => string} say what is said if something has come to rest since they were last asked for */
  announce(say) {
    if (!this.#toAnnounce) return;
    this.#toAnnounce = false;
    this.announcement = say();
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

  /**
   * Growth, seed and size of the cloud.
   *
   * @param {import('../messages/registry.js').Messages['banana']['cloud']} say
   * @param {readonly number[]} counts the sizes that the slider offers
   */
  cloudControls(say, counts) {
    const { samples, seed } = /** @type {Machine} */ (this.machine).config;
    const above = counts.findIndex((count) => count >= samples);
    const nearest = above < 0 ? counts.length - 1 : above;
    return html`<fieldset class="cloud">
      <legend class="visually-hidden">${say.legend}</legend>
      <div class="buttons">
        ${button(this.playing ? words.pause : words.play, () => this.play(), { title: say.play })}
        ${button(words.step, () => this.step(), { title: say.step(whole(this.batch)), disabled: this.complete })}
        ${button(words.reset, () => this.reset(), { title: say.reset })}
        ${button(words.newSeed, () => this.reseed(), { title: say.reseed })}
        <span class="seed">${words.seed(seed)}</span>
      </div>
      ${sliderRow({
        id: 'samples',
        symbol: html`<i>N</i>`,
        name: say.count,
        value: nearest,
        min: 0,
        max: counts.length - 1,
        step: 1,
        show: (index) => whole(index === nearest ? samples : counts[index]),
        effect: say.effect,
        role: 'truth',
        input: (value) => {
          const size = /** @type {unknown} */ ({ samples: counts[value] });
          this.change(/** @type {Partial<Settings>} */ (size));
        },
        commit: () => this.commit(),
      })}
    </fieldset>`;
  }
}
