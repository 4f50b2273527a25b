/** Cloud of samples that grows in steps. */

import { html } from 'lit';
import { words } from '../messages/registry.ts';
import { pointOn } from '../scene/canvas.ts';
import { button } from '../ui/controls.ts';
import { integer } from '../ui/format.ts';
import { refusalError, wholeNumber } from './checks.ts';
import { FigureController } from './controller.ts';
import { freeOnError } from './runtime.ts';
import { prefersReducedMotion } from './renderer.ts';
import type { Figure } from './figure.ts';
import type { Values } from './settings.ts';

/** Numbers of samples of a machine, or of a reading of it. */
interface SampleCount {
  shown: number;
  /** Number of samples that take a few milliseconds. */
  block: number;
}

export interface GrowingMachine extends SampleCount {
  config: { samples: number, seed: number };
  /** Changes settings and shows the first block of `goal` samples. Returns all settings. */
  configureFirst: (settings: Values, goal: number) => Values;
  /** Returns the number of samples shown. */
  addSamples: (count: number) => number;
}

const GROWTH_STEPS = 150;

/** Time for adding samples in a frame, ms. A frame, with its pictures, then takes less than 50 ms. */
const ADDING_MS = 12;

export class Cloud extends FigureController {
  playing = false;
  /** Number of samples to show; Infinity for all. */
  #goalCount = Infinity;
  #gaveUp;

  /** Creates the cloud. `gaveUp` returns true for a reading or machine that has stopped before it had all samples. */
  constructor(host: Figure, gaveUp: (latest: any) => boolean = () => false) {
    super(host);
    this.#gaveUp = gaveUp;
  }

  get #machine(): GrowingMachine {
    return this.host.machine as GrowingMachine;
  }

  /** Latest reading, or the machine if it has changed since. */
  get #latest(): SampleCount {
    return this.host.settings.stale ? this.#machine : this.host.reading;
  }

  /** True if the goal is all samples, or the machine has given up. */
  get isComplete() {
    return this.#goalCount >= this.#samples || this.#gaveUp(this.#latest);
  }

  /** Number of samples of the complete cloud. */
  get #samples(): number {
    return this.host.settings.current.samples;
  }

  /** Number of samples that a step adds. */
  get #batchSize() {
    return Math.ceil(this.#samples / GROWTH_STEPS);
  }

  /** Number of samples to show; all of them if the machine has given up. */
  get asked() {
    return this.isComplete ? this.#samples : this.#goalCount;
  }

  /** True if all samples to show are shown. */
  get isSettled(): boolean {
    return !this.playing && (this.#latest.shown >= this.asked || this.#gaveUp(this.#latest));
  }

  /** Starts the growth, or shows a state; users who prefer reduced motion see the complete cloud. */
  introduce(state?: Values) {
    this.playing = state ? state.playing : true;
    this.#goalCount = state && state.shown < this.#samples ? state.shown : Infinity;
    if (!state && !prefersReducedMotion()) this.#restart();
    if (prefersReducedMotion()) this.finish();
  }

  /** Changes settings and shows one block of samples; later frames add the others. Returns all settings. */
  configure(values: Values): Values {
    return this.#machine.configureFirst(values, this.#goalCount);
  }

  #restart() {
    this.#goalCount = 0;
    if (this.#latest.shown > 0) this.configure({});
    this.host.settings.stale = true;
  }

  /** Shows all samples of a growing cloud at once. */
  finish() {
    if (!this.playing) return;
    this.playing = false;
    this.#goalCount = Infinity;
    this.refine(Infinity);
  }

  show(count: number) {
    this.#goalCount = Math.min(count, this.#samples);
    this.refine(Infinity);
  }

  /** Adds samples for `limit` milliseconds; returns true if all are shown. */
  refine(limit = ADDING_MS): boolean {
    const { asked } = this;
    const endTime = performance.now() + limit;
    const latest = this.#latest;
    const { block } = latest;
    let { shown } = latest;
    while (shown < asked) {
      if (performance.now() > endTime) return false;
      const shownBefore = shown;
      shown = this.#machine.addSamples(Math.min(asked - shown, block));
      // The machine has given up.
      if (shown === shownBefore) break;
      this.host.settings.stale = true;
    }
    return true;
  }

  snapshot(): Values {
    return { shown: this.asked, playing: this.playing, marked: this.#isWanted ? this.index : null };
  }

  /** Returns values that follow from a partial state; throws a TypeError if `playing` is not a boolean. */
  withDerivedFields(currentState: Values, changes: Values): Values {
    const { samples, playing } = { ...currentState, ...changes };
    if (typeof playing !== 'boolean') throw refusalError('state.playing', playing, 'true or false', TypeError);
    const { shown = currentState.shown === currentState.samples ? samples : Math.min(currentState.shown, samples) } = changes;
    // A comparison with undefined is false, so that a missing selection becomes null.
    const marked = currentState.marked < (playing ? samples : shown) ? currentState.marked : null;
    return { shown, marked };
  }

  /** Index of the selected sample; −1 for none. */
  get index(): number {
    return this.host.state.elementState.marked ?? -1;
  }

  /** Selects a sample; −1 for none. */
  mark(index: number) {
    if (index === this.index) return;
    this.host.state.elementState.marked = index < 0 ? null : index;
    this.host.renderer.requestFrame();
  }

  /** Selects the sample nearest to the pointer. */
  point(picture: import('../scene/picture.ts').Picture<any>, event: PointerEvent) {
    this.host.runtime.attempt(() => {
      const { machine, gesture } = this.host;
      // A moving finger scrolls; a tap is a click.
      if (!machine || gesture.pressed || (event.pointerType === 'touch' && event.type !== 'click')) return;
      const [x, y] = pointOn(event.currentTarget as Element, picture.view, event);
      const index = picture.nearest(machine, x, y);
      if (index >= 0 || event.type === 'click') this.mark(index);
    });
  }

  /** True if the selected sample is shown. */
  get isMarked() {
    return this.index >= 0 && this.index < this.#latest.shown;
  }

  /** True if the selected sample is shown or will be. */
  get #isWanted() {
    return this.index >= 0 && this.index < this.selectableCount;
  }

  /** Number of samples that can be selected or pinned, including those that are still to be added. */
  get selectableCount() {
    return this.playing ? this.#samples : this.asked;
  }

  /** Clears the selection if the selected sample is not shown and will not be. */
  unmark() {
    if (!this.#isWanted) this.mark(-1);
  }

  /** Adds samples in a frame. The first frame after a change shows one block, so that drags are quick. The last frame adds all samples. */
  advance(isLast: boolean) {
    if (this.playing) this.grow();
    else if (isLast || !this.host.settings.stale) this.refine(isLast ? Infinity : ADDING_MS);
  }

  grow() {
    this.show(this.#latest.shown + this.#batchSize);
    if (!this.isComplete) return;
    this.#goalCount = Infinity;
    this.playing = false;
    this.host.announcer.announceNext();
  }

  play() {
    this.#control(!this.playing, () => {
      if (!this.playing && this.isComplete) this.#restart();
    });
  }

  step() {
    this.#control(false, () => this.show(this.#latest.shown + this.#batchSize));
  }

  clear() {
    this.#control(false, () => this.#restart());
  }

  reseed() {
    this.host.gesture.decide(() => ({ seed: this.host.motion.randomSeed() }));
  }

  /** Runs the action of a button of the cloud, and sets `playing`. */
  #control(playing: boolean, act: () => void) {
    this.host.runtime.attempt(() => {
      if (!this.host.machine) return;
      act();
      this.playing = playing;
      this.host.gesture.complete();
      this.host.renderer.requestFrame();
    });
  }

  /** Returns the buttons of growth and seed, with the field of the seed. */
  buttons(seedField: unknown) {
    const say = words.cloud;
    const [label, other] = this.playing ? [words.pause, say.play] : [say.play, words.pause];
    return html`<div class="buttons">
      ${button(label, () => this.play(), { title: say.playTitle, other })}
      ${button(words.step, () => this.step(), { title: say.step(integer(this.#batchSize)), disabled: this.isComplete })}
      ${button(words.clear, () => this.clear(), { title: say.clear })}
      ${seedField} ${button(words.newSeed, () => this.reseed(), { title: say.reseed })}
    </div>`;
  }
}

/**
 * Sets a new machine to a state if there is one, with the first block of its samples, and returns it. An invalid state frees the machine and
 * throws a TypeError or RangeError.
 */
export function enterCloud<M extends GrowingMachine & { free(): void }>({ settings }: Figure, machine: M, state?: Values): M {
  if (!state) return machine;
  return freeOnError(machine, () => {
    machine.configureFirst(settings.pick(state), 0);
    machine.configureFirst({}, wholeNumber('state.shown', state.shown, 0, machine.config.samples));
  });
}

/** Read-only properties of elements with a cloud. */
export const cloudProperties: PropertyDescriptorMap & ThisType<Figure> = {
  playing: { get() { return (this.cloud as Cloud).playing; } },
  poses: { get() { return this.ask((machine) => machine.poses); } },
};
