/** A cloud of samples that grows before the reader's eyes: for figures that have one. */

import { html, noChange, nothing } from 'lit';
import { live } from 'lit/directives/live.js';
import { words } from '../messages/registry.js';
import { pointOn } from '../scene/canvas.js';
import { button, inputOf } from '../ui/controls.js';
import { counted } from '../ui/format.js';
import { truth, wholeNumber } from './checks.js';
import { Part } from './part.js';
import { LONGEST_WORK } from './settings.js';
import { isCalm } from './stage.js';

/**
 * @import { Figure } from './figure.js'
 * @import { Values } from './state.js'
 *
 * @typedef {object} Growing a machine with a cloud
 * @property {{ samples: number, seed: number }} config
 * @property {number} shown
 * @property {(count: number) => number} grow
 * @property {(count: number) => void} beginToGrow as grow, in slices
 * @property {() => void} restart
 */

/** Steps that a cloud grows in. */
const BATCHES = 150;

export class Cloud extends Part {
  playing = false;
  /** Whether a step has begun that has not been shown. */
  #begun = false;
  #gaveUp;

  /**
   * @param {Figure} host
   * @param {(machine: any) => boolean} [gaveUp] whether the machine has stopped short of its samples for good
   */
  constructor(host, gaveUp = () => false) {
    super(host);
    this.#gaveUp = gaveUp;
  }

  /** @returns {Growing} */
  get #machine() {
    return /** @type {Growing} */ (this.host.machine);
  }

  /** Whether it will not grow any more. */
  get complete() {
    return this.#machine.shown === this.#samples || this.#gaveUp(this.#machine);
  }

  /** How many samples there are when all have come. @returns {number} */
  get #samples() {
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
   * @param {Values} [state] that the machine is in, if it is not the opening
   */
  introduce(state) {
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

  /** @returns {Values} its part of the state */
  snapshot() {
    return { shown: this.asked, playing: this.playing, marked: this.#isWanted ? this.index : null };
  }

  /**
   * @param {Values} present
   * @param {Values} given
   * @returns {Values} what follows for fields that are left out
   * @throws {TypeError} where it is not said whether it grows
   */
  completed(present, given) {
    const { samples, playing } = { ...present, ...given };
    truth('state.playing', playing);
    const { shown = present.shown === present.samples ? samples : Math.min(present.shown, samples) } = given;
    // None is less than any number, and stays none.
    const marked = present.marked < (playing ? samples : shown) ? present.marked : null;
    return { shown, marked };
  }

  /** The sample that is marked; −1 for none. @returns {number} */
  get index() {
    return this.host.state.own.marked ?? -1;
  }

  /** @param {number} index −1 for none */
  mark(index) {
    if (index === this.index) return;
    this.host.state.own.marked = index < 0 ? null : index;
    this.host.stage.wake();
  }

  /**
   * The pointer is over a picture, or was pressed there: marks the nearest sample.
   *
   * @param {import('../scene/picture.js').Picture<any>} picture
   * @param {PointerEvent} event
   */
  point(picture, event) {
    this.host.runtime.attempt(() => {
      const { machine, gesture } = this.host;
      // A finger that moves scrolls the page; one that taps comes as a click.
      if (!machine || gesture.pressed || (event.pointerType === 'touch' && event.type !== 'click')) return;
      const [x, y] = pointOn(/** @type {Element} */ (event.currentTarget), picture.view, event);
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

  /** @returns {boolean} whether there is nothing left to do in this frame: a large cloud may take more than one */
  grow() {
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
   * @param {boolean} playing from now on
   * @param {() => void} act the reader's, on the growth of the cloud
   */
  #turn(playing, act) {
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
    const { max } = /** @type {{ max: number }} */ (host.kind.declared.find(({ key }) => key === 'seed'));
    const refusal = host.typing.refusalOf('seed');
    const type = (/** @type {Event} */ event) => {
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
 * @param {Growing} machine in that state
 * @param {number} shown
 */
export function shownOf(machine, shown) {
  return wholeNumber('state.shown', shown, 0, machine.config.samples);
}

/** What of the state of an element with a cloud is its own. @type {Record<string, import('./state.js').Owned>} */
export const cloudState = {
  marked: {
    opening: null,
    check: (field, marked, machine, markable) => (marked === null ? null : wholeNumber(field, marked, 0, markable - 1)),
  },
};

/** The properties of an element with a cloud. @type {PropertyDescriptorMap & ThisType<Figure>} */
export const cloudProperties = {
  playing: {
    get() {
      return /** @type {Cloud} */ (this.cloud).playing;
    },
  },
  marked: {
    get() {
      return this.state.own.marked;
    },
    set(marked) {
      this.reflection.give('marked', marked, (/** @type {unknown} */ given) => this.state.assign('marked', given));
    },
  },
  poses: {
    get() {
      return this.ask((machine) => machine.poses);
    },
  },
};
