/** A cloud of samples that grows before the reader's eyes: for figures that have one. */

import { html, noChange, nothing } from 'lit';
import { live } from 'lit/directives/live.js';
import { words } from '../messages/registry.ts';
import { pointOn } from '../scene/canvas.ts';
import { button, inputOf } from '../ui/controls.ts';
import { counted } from '../ui/format.ts';
import { boolean, wholeNumber } from './checks.ts';
import { Part } from './part.ts';
import { isCalm } from './stage.ts';
import type { Figure } from './figure.ts';
import type { Values } from './state.ts';

/** Number of samples of a machine or a reading. */
interface Count {
  shown: number;
  /** Number of samples that are added within a few milliseconds. */
  block: number;
}

/** A machine with a cloud. */
export interface Growing extends Count {
  config: { samples: number, seed: number };
  /** Changes settings and shows the first block of `goal` samples. Returns all settings. */
  configureFirst: (settings: Values, goal: number) => Values;
  /** Returns how many are shown then. */
  addSamples: (count: number) => number;
}

/** Steps that a cloud grows in. */
const BATCHES = 150;

/** Time in a frame for adding samples, ms: with the pictures it stays below 50. */
const FRAME_WORK = 12;

export class Cloud extends Part {
  playing = false;
  /** Number of samples that are to be shown; Infinity for all. */
  #goal = Infinity;
  #gaveUp;

  /** @param gaveUp tells of a reading or a machine whether it has stopped short of its samples for good */
  constructor(host: Figure, gaveUp: (latest: any) => boolean = () => false) {
    super(host);
    this.#gaveUp = gaveUp;
  }

  get #machine(): Growing {
    return this.host.machine as Growing;
  }

  /** Latest reading, or the machine if that has changed since. */
  get #latest(): Count {
    return this.host.settings.stale ? this.#machine : this.host.reading;
  }

  /** True if it will not grow any more. */
  get complete() {
    return this.#goal >= this.#samples || this.#gaveUp(this.#latest);
  }

  /** Number of samples of the complete cloud. */
  get #samples(): number {
    return this.host.settings.present.samples;
  }

  /** Number of samples that a step adds. */
  get #batch() {
    return Math.ceil(this.#samples / BATCHES);
  }

  /** Number of samples that are to be shown: all of them where the machine has given up before. */
  get asked() {
    return this.complete ? this.#samples : this.#goal;
  }

  /** True if all samples that are to be shown are. */
  get isSettled(): boolean {
    return !this.playing && (this.#latest.shown >= this.asked || this.#gaveUp(this.#latest));
  }

  /**
   * Starts the show: the cloud grows, or is complete for readers who want less motion.
   *
   * @param state that the machine is in, if it is not the opening
   */
  introduce(state?: Values) {
    this.playing = state ? state.playing : true;
    this.#goal = state && state.shown < this.#samples ? state.shown : Infinity;
    if (!state && !isCalm()) this.#restart();
    if (isCalm()) this.finish();
  }

  /** Changes settings: a block of samples is shown at once, and the others in later frames. Returns all settings. */
  configure(values: Values): Values {
    return this.#machine.configureFirst(values, this.#goal);
  }

  #restart() {
    this.#goal = 0;
    this.configure({});
    this.host.settings.stale = true;
  }

  /** Completes a cloud that grows. */
  finish() {
    if (!this.playing) return;
    this.pause();
    this.#goal = Infinity;
    this.refine(Infinity);
  }

  /** Shows so many samples. */
  show(count: number) {
    this.#goal = Math.min(count, this.#samples);
    this.refine(Infinity);
  }

  /**
   * Adds samples that are to be shown, as many as a frame has time for.
   *
   * @param limit milliseconds
   * @returns true if all of them are shown
   */
  refine(limit = FRAME_WORK): boolean {
    const { asked } = this;
    const end = performance.now() + limit;
    const latest = this.#latest;
    const { block } = latest;
    let { shown } = latest;
    while (shown < asked) {
      if (performance.now() > end) return false;
      const before = shown;
      shown = this.#machine.addSamples(Math.min(asked - shown, block));
      // It has given up.
      if (shown === before) break;
      this.host.settings.stale = true;
    }
    return true;
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
    boolean('state.playing', playing);
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
    this.host.stage.requestFrame();
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

  /** True if the marked sample is shown. */
  get isMarked() {
    return this.index >= 0 && this.index < this.#latest.shown;
  }

  /** True if the marked sample is shown or will be. */
  get #isWanted() {
    return this.index >= 0 && this.index < this.selectableCount;
  }

  /** Number of samples that can be marked: also one that is to come. */
  get selectableCount() {
    return this.playing ? this.#samples : this.asked;
  }

  /** A mark of what is not there, and does not come, goes. */
  unmark() {
    if (!this.#isWanted) this.mark(-1);
  }

  /**
   * Adds samples in a frame. A change is answered with one block, so that a drag of a large cloud is as quick as one of a small cloud.
   *
   * @param isLast tells whether no frame will follow, as on paper
   */
  advance(isLast: boolean) {
    if (this.playing) this.grow();
    else if (isLast || !this.host.settings.stale) this.refine(isLast ? Infinity : FRAME_WORK);
  }

  /** Adds a step to a cloud that grows. */
  grow() {
    this.show(this.#latest.shown + this.#batch);
    if (!this.complete) return;
    this.#goal = Infinity;
    this.playing = false;
    this.host.announcer.announceNext();
  }

  pause() {
    this.playing = false;
  }

  play() {
    this.#control(!this.playing, () => {
      if (!this.playing && this.complete) this.#restart();
    });
  }

  step() {
    this.#control(false, () => this.show(this.#latest.shown + this.#batch));
  }

  clear() {
    this.#control(false, () => this.#restart());
  }

  reseed() {
    this.host.settings.want(() => ({ seed: this.host.motion.randomSeed() }));
    this.host.gesture.commit();
  }

  /**
   * @param playing from now on
   * @param act the reader's, on the growth of the cloud
   */
  #control(playing: boolean, act: () => void) {
    this.host.runtime.attempt(() => {
      if (!this.host.machine) return;
      act();
      this.playing = playing;
      this.host.gesture.step();
      this.host.gesture.commit();
      this.host.stage.requestFrame();
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
        .value=${refusal ? noChange : live(String(host.settings.wanted.seed))}
        @input=${type}
        @change=${() => host.gesture.commit()}
        @blur=${() => host.typing.forget()}
      />
      ${refusal ? html`<output role="alert">${refusal}</output>` : nothing}
    </label>`;
  }
}

/**
 * Puts a machine into a state, with the first block of the samples that it shows.
 *
 * @throws {TypeError | RangeError}
 */
export function enterCloud(machine: Growing, settings: Values, shown: number) {
  machine.configureFirst(settings, 0);
  machine.configureFirst({}, wholeNumber('state.shown', shown, 0, machine.config.samples));
}

/** State of an element with a cloud that is not its machine's. */
export const cloudState: Record<string, import('./state.ts').Owned> = {
  marked: {
    opening: null,
    check: (field, marked, machine, selectableCount) => (marked === null ? null : wholeNumber(field, marked, 0, selectableCount - 1)),
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
      this.reflection.setProperty('marked', marked, (given: unknown) => this.state.assign('marked', given));
    },
  },
  poses: {
    get() {
      return this.ask((machine) => machine.poses);
    },
  },
};
