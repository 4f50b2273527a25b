/** Plays a slider: from where it stands, or from its beginning where it stands at the end. */

import { Part } from '../../figure/part.js';

/** How long from one end of a slider to the other, milliseconds. */
const DURATION = { phase: 4000, drift: 8000 };

/** @typedef {keyof typeof DURATION} Played */

/** @extends {Part<import('./odometry-decomposer.js').OdometryDecomposerElement>} */
export class Player extends Part {
  /** What is played. @type {Played | undefined} */
  key;

  /** @param {Played} key */
  toggle(key) {
    const { settings, gesture, kind: { looks } } = this.host;
    const playing = this.key !== key;
    if (this.key) gesture.commit();
    this.key = playing ? key : undefined;
    if (playing && settings.wanted[key] >= looks[key].max) settings.want({ [key]: looks[key].min });
    this.host.stage.wake();
    this.host.requestUpdate();
  }

  /** The reader has taken over, or another state has come. */
  stop() {
    this.key = undefined;
  }

  /**
   * To be called in each frame.
   *
   * @param {number} elapsed milliseconds since the one before
   * @returns {boolean} whether there is more to play
   */
  advance(elapsed) {
    const { key, host: { settings, gesture, kind: { looks } } } = this;
    if (!key) return false;
    const { min, max } = looks[key];
    const next = settings.wanted[key] + ((max - min) * elapsed) / DURATION[key];
    settings.want({ [key]: Math.min(next, max) });
    if (next < max) return true;
    this.stop();
    gesture.commit();
    return false;
  }
}
