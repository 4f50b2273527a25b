/** Handle at the end of the commanded arc: a ring that is dragged with a pointer, or moved with keys. */

import { words } from '../../messages/registry.ts';
import { Handle, stepsOfKey } from '../../scene/handle.ts';
import { clamp } from '../../ui/clamp.ts';
import { fixed } from '../../ui/format.ts';
import { sliderSpecs } from './settings.ts';

/** Displacement of the end of the arc per press of an arrow key, metres. */
const KEY_STEP = 0.02;

export class ArcHandle extends Handle {
  constructor(figure: import('./banana-machine.ts').BananaMachineElement) {
    super('end', {
      view: () => figure.pictures[0].view,
      drag: (x, y) => figure.moveArcEnd(x, y),
      key: (event) => {
        const keySteps = stepsOfKey(event);
        if (!keySteps || !figure.simulation) return false;
        const [x, y] = figure.visibleArcEnd;
        // The straight arc reaches furthest.
        const maxX = sliderSpecs.v.max * figure.settings.requested.command.dt;
        figure.moveArcEnd(clamp(x + KEY_STEP * keySteps[0], -maxX, maxX), y + KEY_STEP * keySteps[1]);
        return true;
      },
      commit: () => figure.gesture.commit(),
    });
  }

  /** Renders the handle, with a hint to drag it if the introduction asks for that. */
  render({ v, omega }: import('../../types.d.ts').Command, isAsking: boolean) {
    const texts = words.banana;
    const { min, max } = sliderSpecs.omega;
    const isAtLimit = [v - sliderSpecs.v.min, sliderSpecs.v.max - v, omega - min, max - omega].some((margin) => margin <= 0);
    return this.handleHtml({
      name: texts.handle,
      keys: texts.handleKeys,
      title: words.pose.moveTitle,
      range: [min, max],
      now: omega,
      text: `v = ${fixed(v, 2)} m/s, ω = ${fixed(omega, 2)} rad/s`,
      stop: isAtLimit && texts.slidersEnd,
      hint: isAsking && texts.handleHint,
    });
  }
}
