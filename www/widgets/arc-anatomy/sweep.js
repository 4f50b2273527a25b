/** The robot underway: along the arcs by itself, or where the reader puts it. */

import { html, nothing } from 'lit';
import { Part } from '../../figure/part.js';
import { isCalm } from '../../figure/stage.js';
import { words } from '../../messages/registry.js';
import { button } from '../../ui/controls.js';
import { fixed } from '../../ui/format.js';
import { track } from '../../ui/slider.js';

/** How long it takes by itself, whatever the command: ms. */
const DURATION = 2000;

/** The whole way, per cent. */
const WHOLE = 100;

/** @extends {Part<import('./arc-anatomy.js').ArcAnatomyElement>} */
export class Sweep extends Part {
  playing = false;
  /** What it has gone beyond a whole per cent. */
  #beyond = 0;

  /** How much of the way is behind it, from 0 to 1. */
  get share() {
    return this.#at / WHOLE;
  }

  get #at() {
    return this.host.state.own.underway;
  }

  /** @param {number} at per cent of the way */
  #put(at) {
    this.host.state.own.underway = at;
    this.host.gesture.step();
    this.host.stage.wake();
  }

  /**
   * To be called in each frame.
   *
   * @param {number} elapsed milliseconds since the one before
   * @returns {boolean} whether there is more to play
   */
  advance(elapsed) {
    if (!this.playing) return false;
    const gone = this.#beyond + (WHOLE * elapsed) / DURATION;
    this.#beyond = gone % 1;
    if (gone >= 1) this.#put(Math.min(WHOLE, this.#at + Math.floor(gone)));
    if (this.#at === WHOLE) this.#rest();
    return this.playing;
  }

  #rest() {
    this.playing = false;
    this.host.gesture.commit();
  }

  #toggle = () => {
    if (this.playing) {
      this.#rest();
      return;
    }
    if (this.#at === WHOLE) this.#put(0);
    this.playing = true;
    this.#beyond = 0;
    this.host.stage.wake();
  };

  #scrub = (/** @type {number} */ at) => {
    this.playing = false;
    this.#put(at);
  };

  render() {
    const { config: { command: { dt } } } = this.host.reading;
    const { underway: say } = words.anatomy;
    const shown = `${fixed(this.share * dt, 2)} s`;
    return html`<div class="underway">
      ${isCalm() ? nothing : button(this.playing ? words.pause : words.play, this.#toggle)}
      <label for="underway">${say}</label>
      ${track({ id: 'underway', min: 0, max: WHOLE, step: 1, value: this.#at, text: shown, input: this.#scrub, commit: () => this.#rest() })}
      <output for="underway">${shown}</output>
    </div>`;
  }
}
