/** Plays what a slider sets: from where it stands, or from its beginning where it stands at its end. */

import { nothing } from 'lit';
import { Part } from '../../figure/part.js';
import { isCalm } from '../../figure/stage.js';
import { words } from '../../messages/registry.js';
import { button } from '../../ui/controls.js';

/**
 * @typedef {object} Played
 * @property {number} from
 * @property {number} to
 * @property {number} duration from one to the other, milliseconds
 * @property {() => number} at
 * @property {(value: number) => void} put
 */

/** @template {string} Key */
export class Player extends Part {
  /** What is played. @type {Key | undefined} */
  #key;
  #played;
  /** What was gone and not put, where only whole steps are. */
  #beyond = 0;

  /**
   * @param {import('../../figure/figure.js').Figure} host
   * @param {Record<Key, Played>} played
   */
  constructor(host, played) {
    super(host);
    this.#played = played;
  }

  /** Another state has come. */
  stop() {
    this.#key = undefined;
  }

  /**
   * The reader takes over.
   *
   * @param {Key} key
   * @param {number} value
   */
  put(key, value) {
    this.stop();
    this.#played[key].put(value);
  }

  /** @param {Key} key */
  #toggle(key) {
    const { host: { gesture, stage } } = this;
    const { from, to, at, put } = this.#played[key];
    const playing = this.#key !== key;
    if (this.#key) gesture.commit();
    if (playing && at() >= to) put(from);
    this.#key = playing ? key : undefined;
    this.#beyond = 0;
    stage.wake();
    this.host.requestUpdate();
  }

  /**
   * To be called in each frame.
   *
   * @param {number} elapsed milliseconds since the one before
   * @returns {boolean} whether there is more to play
   */
  advance(elapsed) {
    if (!this.#key) return false;
    const { from, to, duration, at, put } = this.#played[this.#key];
    const next = Math.min(to, at() + this.#beyond + ((to - from) * elapsed) / duration);
    put(next);
    this.#beyond = next - at();
    if (next < to) return true;
    this.stop();
    this.host.gesture.commit();
    return false;
  }

  /**
   * Plays and pauses. Nothing for who wants less motion: the slider is there to be moved.
   *
   * @param {Key} key
   * @param {string} label of the button, which names what is played
   */
  button(key, label) {
    return isCalm() ? nothing : button(this.#key === key ? words.pause : label, () => this.#toggle(key));
  }
}
