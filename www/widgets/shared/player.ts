/** Animation of a slider: from its current value, or from its beginning if it is at its end. */

import { nothing } from 'lit';
import { FigureController } from '../../figure/controller.ts';
import { isCalm } from '../../figure/stage.ts';
import { words } from '../../messages/registry.ts';
import { button } from '../../ui/controls.ts';

interface Played {
  from: number;
  to: number;
  /** Duration from one end to the other, milliseconds. */
  duration: number;
  at: () => number;
  put: (value: number) => void;
}

export class Player<Key extends string> extends FigureController {
  /** Key of the animated setting. */
  #key: Key | undefined;
  #played;
  /** Remainder of the last movement that a setting with whole steps could not take. */
  #beyond = 0;

  constructor(host: import('../../figure/figure.ts').Figure, played: Record<Key, Played>) {
    super(host);
    this.#played = played;
  }

  /** Stops the animation. */
  stop() {
    this.#key = undefined;
  }

  /** Sets a value that the reader has chosen, and stops the animation. */
  put(key: Key, value: number) {
    this.stop();
    this.#played[key].put(value);
  }

  #toggle(key: Key) {
    const { host: { gesture, stage } } = this;
    const { from, to, at, put } = this.#played[key];
    const playing = this.#key !== key;
    if (this.#key) gesture.commit();
    if (playing && at() >= to) put(from);
    this.#key = playing ? key : undefined;
    this.#beyond = 0;
    stage.requestFrame();
    this.host.requestUpdate();
  }

  /** Advances the animation by the milliseconds since the previous frame. Returns true if there is more to play. */
  advance(elapsed: number): boolean {
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

  /** Returns the button that plays and pauses, with a label for the animation. With reduced motion there is only the slider. */
  button(key: Key, label: string) {
    const [now, other] = this.#key === key ? [words.pause, label] : [label, words.pause];
    return isCalm() ? nothing : button(now, () => this.#toggle(key), { other });
  }
}
