/** The ring at the end of the commanded arc, dragged by pointer or moved from the keyboard. */

import { words } from '../../messages/registry.js';
import { Handle, WAYS } from '../../scene/handle.js';
import { fixed } from '../../ui/format.js';
import { looks } from './settings.js';

/** What an arrow key moves the end of the arc by, metres; with Shift the longer way. */
const KEY_STEP = 0.02;
const LONG_KEY_STEP = 0.1;

export class ArcHandle extends Handle {
  /** @param {import('./banana-machine.js').BananaMachineElement} figure */
  constructor(figure) {
    super('end', {
      view: () => figure.pictures[0].view,
      drag: (x, y) => figure.reach(x, y),
      key: ({ key, shiftKey }) => {
        const way = WAYS.get(key);
        if (!way) return false;
        const step = shiftKey ? LONG_KEY_STEP : KEY_STEP;
        const [x, y] = figure.runtime.attempt(() => figure.machine && figure.fresh.end) ?? [0, 0];
        figure.reach(x + step * way[0], y + step * way[1]);
        return true;
      },
      commit: () => figure.gesture.commit(),
    });
  }

  /** @param {import('../../types.d.ts').Command} command */
  render({ v, omega }) {
    const say = words.banana;
    const { min, max } = looks.omega;
    const ends = [v - looks.v.min, looks.v.max - v, omega - min, max - omega].some((left) => left <= 0);
    return this.element({
      name: say.handle,
      keys: say.handleKeys,
      title: say.handleTitle,
      range: [min, max],
      now: omega,
      text: `v = ${fixed(v, 2)} m/s, ω = ${fixed(omega, 2)} rad/s`,
      stop: ends && say.slidersEnd,
    });
  }
}
