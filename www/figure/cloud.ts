/** A cloud of samples that grows before the reader's eyes: for figures that have one. */

import { html, noChange, nothing } from 'lit';
import { live } from 'lit/directives/live.js';
import { words } from '../messages/registry.ts';
import { pointOn } from '../scene/canvas.ts';
import { button, inputOf } from '../ui/controls.ts';
import { counted } from '../ui/format.ts';
import { truth, wholeNumber } from './checks.ts';
import { Part } from './part.ts';
import { LONGEST_WORK } from './settings.ts';
import { isCalm } from './stage.ts';
import type { Figure } from './figure.ts';
import type { Values } from './state.ts';

/** A machine with a cloud. */
export interface Growing {
  config: { samples: number, seed: number };
  shown: number;
  grow: (count: number) => number;
  /** Begin to grow as grow, in slices. */
  beginToGrow: (count: number) => void;
  restart: () => void;
}

/** Steps that a cloud grows in. */
const BATCHES = 150;

export class Cloud extends Part {
  playing = false;
  /** Whether a step has begun that has not been shown. */
  #begun = false;
  #gaveUp;

  /** @param gaveUp whether the machine has stopped short of its samples for good */
  constructor(host: Figure, gaveUp: (machine: any) => boolean = () => false) {
    super(host);
    this.#gaveUp = gaveUp;
  }

  get #machine(): Growing {
    return this.host.machine as Growing;
  }

  /** Whether it will not grow any more. */
  get complete() {
    return this.#machine.shown === this.#samples || this.#gaveUp(this.#machine);
  }

  /** How many samples there are when all have come. */
  get #samples(): number {
    return this.host.settings.present.samples;
  }

  /** How many samples a step adds. */
  get #batch() {
    return Math.ceil(this.#samples / BATCHES);
  }

  /** Whether it has not been shown yet: it opens with all of its samples on their way. */
  get #unopened() {
    return this.host.reading === undefined;
  }

  /** How many samples have been asked for so far: all of them where the machine has given up before. */
  get asked() {
    return this.complete || this.#unopened ? this.#samples : this.#machine.shown;
  }

  /** Whether samples are still to come. */
  get growing() {
    return this.playing || this.#unopened;
  }

  /**
   * Starts the show: the cloud grows, or stands there for one who wants less motion.
   *
   * @param state that the machine is in, if it is not the opening
   */
  introduce(state?: Values) {
    if (!state && !isCalm()) this.#machine.restart();
    this.pause();
    this.playing = state ? state.playing : true;
    if (isCalm()) this.finish();
  }

  /** A cloud that grows is complete at once. */
  finish() {
    if (!this.playing) return;
    this.pause();
    this.#machine.grow(this.#samples);
    this.host.settings.stale = true;
  }

  /** @returns its part of the state */
  snapshot(): Values {
    return { shown: this.asked, playing: this.playing, marked: this.#isWanted ? this.index : null };
  }

  /**
   * @returns what follows for fields that are left out
   * @throws {TypeError} where it is not said whether it grows
   */
  completed(present: Values, given: Values): Values {
    const { samples, playing } = { ...present, ...given };
    truth('state.playing', playing);
    const { shown = present.shown === present.samples ? samples : Math.min(present.shown, samples) } = given;
    // None is less than any number, and stays none.
    const marked = present.marked < (playing ? samples : shown) ? present.marked : null;
    return { shown, marked };
  }

  /** The sample that is marked; −1 for none. */
  get index(): number {
    return this.host.state.own.marked ?? -1;
  }

  /** @param index −1 for none */
  mark(index: number) {
    if (index === this.index) return;
    this.host.state.own.marked = index < 0 ? null : index;
    this.host.stage.wake();
  }

  /** The pointer is over a picture, or was pressed there: marks the nearest sample. */
  point(picture: import('../scene/picture.ts').Picture<any>, event: PointerEvent) {
    this.host.runtime.attempt(() => {
      const { machine, gesture } = this.host;
      // A finger that moves scrolls the page; one that taps comes as a click.
      if (!machine || gesture.pressed || (event.pointerType === 'touch' && event.type !== 'click')) return;
      const [x, y] = pointOn(event.currentTarget as Element, picture.view, event);
      const index = picture.nearest(machine, x, y);
      if (index >= 0 || event.type === 'click') this.mark(index);
    });
  }

  /** Whether the marked sample is among those shown. */
  get isMarked() {
    return this.index >= 0 && this.index < this.#machine.shown;
  }

  /** Whether the marked sample is there, or comes. */
  get #isWanted() {
    return this.index >= 0 && this.index < this.markable;
  }

  /** How many samples can be marked: one that is to come can be, and is from when it is there. */
  get markable() {
    return this.growing ? this.#machine.config.samples : this.#machine.shown;
  }

  /** A mark of what is not there, and does not come, goes. */
  unmark() {
    if (!this.#isWanted) this.mark(-1);
  }

  /** @returns whether there is nothing left to do in this frame: a large cloud may take more than one */
  grow(): boolean {
    if (!this.playing) return true;
    // A step that took several frames is shown before the next begins.
    if (!this.#begun && !this.complete) {
      this.#begun = true;
      this.#machine.beginToGrow(this.#batch);
      this.host.settings.work();
      if (!this.host.settings.settle(LONGEST_WORK)) return false;
    }
    this.#begun = false;
    this.host.settings.stale = true;
    if (this.complete) {
      this.playing = false;
      this.host.announcer.expect();
    }
    return true;
  }

  /** It stands, and of a step that it has begun with nothing is to come. */
  pause() {
    this.playing = this.#begun = false;
  }

  play() {
    this.#turn(!this.playing, () => {
      if (!this.playing && this.complete) this.#machine.restart();
    });
  }

  step() {
    this.#turn(false, () => this.#machine.grow(this.#batch));
  }

  clear() {
    this.#turn(false, () => this.#machine.restart());
  }

  reseed() {
    this.host.settings.want(() => ({ seed: this.host.motion.randomSeed() }));
    this.host.gesture.commit();
  }

  /**
   * @param playing from now on
   * @param act the reader's, on the growth of the cloud
   */
  #turn(playing: boolean, act: () => void) {
    this.host.runtime.attempt(() => {
      if (!this.host.machine) return;
      act();
      this.pause();
      this.playing = playing;
      this.host.gesture.step();
      this.host.gesture.commit();
    });
  }

  buttons() {
    const say = words.cloud;
    return html`<div class="buttons">
      ${button(this.playing ? words.pause : say.play, () => this.play(), { title: say.playTitle })}
      ${button(words.step, () => this.step(), { title: say.step(counted(this.#batch)), disabled: this.complete })}
      ${button(words.clear, () => this.clear(), { title: say.clear })}
      ${this.#seedField()} ${button(words.newSeed, () => this.reseed(), { title: say.reseed })}
    </div>`;
  }

  #seedField() {
    const { host } = this;
    const { max } = host.kind.declared.find(({ key }) => key === 'seed') as { max: number };
    const refusal = host.typing.refusalOf('seed');
    const type = (event: Event) => {
      const text = inputOf(event).value;
      if (/^\d+$/.test(text) && Number(text) <= max) host.settings.want({ seed: Number(text) });
      else host.typing.refuse('seed', words.refused(words.seed, text.replace('-', '\u2212'), '0', counted(max), true));
    };
    return html`<label class="seed">
      ${words.seed}
      <input
        type="text"
        inputmode="numeric"
        autocomplete="off"
        .value=${refusal ? noChange : live(String(host.settings.told.seed))}
        @input=${type}
        @change=${() => host.gesture.commit()}
        @blur=${() => host.typing.forget()}
      />
      ${refusal ? html`<output role="alert">${refusal}</output>` : nothing}
    </label>`;
  }
}

/**
 * How many samples a state shows.
 *
 * @param machine in that state
 */
export function shownOf(machine: Growing, shown: number) {
  return wholeNumber('state.shown', shown, 0, machine.config.samples);
}

/** What of the state of an element with a cloud is its own. */
export const cloudState: Record<string, import('./state.ts').Owned> = {
  marked: {
    opening: null,
    check: (field, marked, machine, markable) => (marked === null ? null : wholeNumber(field, marked, 0, markable - 1)),
  },
};

/** The properties of an element with a cloud. */
export const cloudProperties: PropertyDescriptorMap & ThisType<Figure> = {
  playing: {
    get() {
      return (this.cloud as Cloud).playing;
    },
  },
  marked: {
    get() {
      return this.state.own.marked;
    },
    set(marked) {
      this.reflection.give('marked', marked, (given: unknown) => this.state.assign('marked', given));
    },
  },
  poses: {
    get() {
      return this.ask((machine) => machine.poses);
    },
  },
};
