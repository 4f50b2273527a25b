/** Player that animates a slider from its current value to its maximum. At the maximum it starts again from 0. */

import { nothing } from 'lit';
import { FigureController } from '../../figure/controller.ts';
import { prefersReducedMotion } from '../../figure/renderer.ts';
import { words } from '../../messages/registry.ts';
import { button } from '../../ui/controls.ts';

interface PlayedSetting {
  /** Maximum of the setting. */
  to: number;
  /** Duration from 0 to the maximum, milliseconds. */
  duration: number;
}

export class Player<Key extends string> extends FigureController {
  /** Key of the animated setting. */
  #key: Key | undefined;
  #playedSettings;

  constructor(host: import('../../figure/figure.ts').Figure, played: Record<Key, PlayedSetting>) {
    super(host);
    this.#playedSettings = played;
  }

  stop() {
    this.#key = undefined;
  }

  /** Sets a value that the user has chosen, and stops the animation. */
  put(key: Key, value: number) {
    this.stop();
    this.host.settings.request({ [key]: value });
  }

  #valueAt(key: Key): number {
    const { settings, state } = this.host;
    return key in state.elementState ? state.elementState[key] : settings.requested[key];
  }

  #toggle(key: Key) {
    const { host: { gesture, renderer, settings } } = this;
    const willPlay = this.#key !== key;
    if (this.#key) gesture.commit();
    this.#key = willPlay ? key : undefined;
    this.host.requestUpdate();
    if (willPlay && this.#valueAt(key) >= this.#playedSettings[key].to) settings.request({ [key]: 0 });
    renderer.requestFrame();
  }

  /** Advances the animation by the milliseconds since the previous frame. Returns true if there is more to play. */
  advance(elapsed: number): boolean {
    if (!this.#key) return false;
    const { to, duration } = this.#playedSettings[this.#key];
    const next = Math.min(to, this.#valueAt(this.#key) + (to * elapsed) / duration);
    this.host.settings.request({ [this.#key]: next });
    if (next < to) return true;
    this.stop();
    this.host.gesture.commit();
    return false;
  }

  /** Returns the button that plays and pauses, with a label for the animation. With reduced motion there is only the slider. */
  button(key: Key, label: string) {
    const [currentLabel, otherLabel] = this.#key === key ? [words.pause, label] : [label, words.pause];
    return prefersReducedMotion() ? nothing : button(currentLabel, () => this.#toggle(key), { otherLabel });
  }
}
