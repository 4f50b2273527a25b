/** The ring at the end of the commanded arc, dragged by pointer or moved from the keyboard. */

import { words } from '../../messages/registry.js';
import { Handle, WAYS } from '../../scene/handle.js';
import { fixed } from '../../ui/format.js';
import { looks } from './settings.js';

/** What an arrow key moves the end of the arc by, metres; with Shift the longer way. */
const KEY_STEP = 0.02;
const LONG_KEY_STEP = 0.1;

/**
 * @typedef {object} Hooks what the handle asks of the element
 * @property {() => import('../../scene/view.js').View} view of the floor
 * @property {() => [number, number]} end of the arc, with every change so far in effect, metres
 * @property {(x: number, y: number) => void} reach wants the command that ends there
 * @property {() => void} commit after the last of a row of changes
 */

export class ArcHandle {
  #hooks;
  #ring;

  /** @param {Hooks} hooks */
  constructor(hooks) {
    this.#hooks = hooks;
    this.#ring = new Handle('end', {
      view: hooks.view,
      drag: hooks.reach,
      key: (event) => this.#key(event),
      commit: hooks.commit,
    });
  }

  /** Whether it is held: the views keep still under it. */
  get held() {
    return this.#ring.held;
  }

  /** @param {import('../../types.d.ts').Command} command */
  render({ v, omega }) {
    const say = words.banana;
    const { min, max } = looks.omega;
    return this.#ring.render({
      name: say.handle,
      keys: say.handleKeys,
      title: say.handleTitle,
      range: [min, max],
      now: omega,
      text: `v = ${fixed(v, 2)} m/s, ω = ${fixed(omega, 2)} rad/s`,
    });
  }

  /**
   * Puts the ring where the arc ends.
   *
   * @param {ParentNode} root that it was rendered into
   * @param {[number, number]} end metres
   */
  place(root, [x, y]) {
    const view = this.#hooks.view();
    this.#ring.place(root, view.toPixelX(x), view.toPixelY(y));
  }

  /** @param {KeyboardEvent} event */
  #key({ key, shiftKey }) {
    const way = WAYS[key];
    if (!way) return false;
    const step = shiftKey ? LONG_KEY_STEP : KEY_STEP;
    const [x, y] = this.#hooks.end();
    this.#hooks.reach(x + step * way[0], y + step * way[1]);
    return true;
  }
}
