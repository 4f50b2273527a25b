/** Cloud of samples that grows in steps. */

import { html } from 'lit';
import { words } from '../messages/registry.ts';
import { pointInView } from '../scene/canvas.ts';
import { button } from '../ui/controls.ts';
import { integer } from '../ui/format.ts';
import { refusalError, checkedInteger } from './checks.ts';
import { FigureController } from './controller.ts';
import { prefersReducedMotion } from './renderer.ts';
import type { Figure } from './figure.ts';
import type { Values } from './settings.ts';

/** Sample counts of a simulation, or of a view model of it. */
interface SampleCount {
  shown: number;
  /** Number of samples that take a few milliseconds. */
  block: number;
}

interface GrowingSimulation extends SampleCount {
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
  #requestedCount = Infinity;
  #hasGivenUp;

  /** `hasGivenUp` returns true for a view model or simulation that has stopped before it had all samples. */
  constructor(host: Figure, hasGivenUp: (latest: any) => boolean = () => false) {
    super(host);
    this.#hasGivenUp = hasGivenUp;
  }

  get #simulation(): GrowingSimulation {
    return this.host.simulation as GrowingSimulation;
  }

  /** Latest sample counts: those of the view model, or of the simulation if it has changed since. */
  get #latest(): SampleCount {
    return this.host.settings.isStale ? this.#simulation : this.host.viewModel;
  }

  /** True if all samples are requested, or the simulation has given up. */
  get isComplete() {
    return this.#requestedCount >= this.#samples || this.#hasGivenUp(this.#latest);
  }

  get #samples(): number {
    return this.host.settings.current.samples;
  }

  get #batchSize() {
    return Math.ceil(this.#samples / GROWTH_STEPS);
  }

  /** Number of samples to show; all of them if the simulation has given up. */
  get targetCount() {
    return this.isComplete ? this.#samples : this.#requestedCount;
  }

  /** True if the cloud is not playing, and has as many samples as requested or as the simulation can draw. */
  get isSettled(): boolean {
    return !this.playing && (this.#latest.shown >= this.targetCount || this.#hasGivenUp(this.#latest));
  }

  /** Starts the growth, or shows a state. */
  introduce(state?: Values) {
    this.playing = state ? state.playing : true;
    this.#requestedCount = state && state.shown < this.#samples ? state.shown : Infinity;
    if (!state && !prefersReducedMotion()) this.#restart();
    if (this.playing && prefersReducedMotion()) this.finish();
  }

  /** Changes settings and shows one block of samples; later frames add the others. Returns all settings. */
  configure(values: Values): Values {
    return this.#simulation.configureFirst(values, this.#requestedCount);
  }

  #restart() {
    this.#requestedCount = 0;
    if (this.#latest.shown > 0) this.configure({});
    this.host.settings.isStale = true;
  }

  /** Shows all requested samples at once. A growing cloud is complete then. */
  finish() {
    if (this.playing) this.#requestedCount = Infinity;
    this.playing = false;
    this.refine(Infinity);
  }

  show(count: number) {
    this.#requestedCount = Math.min(count, this.#samples);
    this.refine(Infinity);
  }

  /** Adds samples for `limitMs` milliseconds; returns true if all are shown. */
  refine(limitMs = ADDING_MS): boolean {
    const { targetCount } = this;
    const endTime = performance.now() + limitMs;
    const latest = this.#latest;
    const { block } = latest;
    let { shown } = latest;
    while (shown < targetCount) {
      if (performance.now() > endTime) return false;
      const shownBefore = shown;
      shown = this.#simulation.addSamples(Math.min(targetCount - shown, block));
      // The simulation has given up.
      if (shown === shownBefore) break;
      this.host.settings.isStale = true;
    }
    return true;
  }

  snapshot(): Values {
    return { shown: this.targetCount, playing: this.playing, marked: this.#isWanted ? this.selectedIndex : null };
  }

  /** Returns values that follow from a partial state; throws a TypeError if `playing` is not a boolean. */
  withDerivedFields(currentState: Values, changes: Values): Values {
    const { samples, playing } = { ...currentState, ...changes };
    if (typeof playing !== 'boolean') throw refusalError('state.playing', playing, 'true or false', TypeError);
    return { shown: currentState.shown === currentState.samples ? samples : Math.min(currentState.shown, samples) };
  }

  /** Index of the selected sample; −1 for none. */
  get selectedIndex(): number {
    return this.host.state.elementState.marked ?? -1;
  }

  mark(index: number) {
    if (index === this.selectedIndex) return;
    this.host.state.elementState.marked = index < 0 ? null : index;
    this.host.renderer.requestFrame();
  }

  selectAtPointer(picture: import('../scene/picture.ts').Picture<any>, event: PointerEvent) {
    const { simulation, gesture } = this.host;
    // A moving finger scrolls; a tap is a click.
    if (!simulation || gesture.isPressed || (event.pointerType === 'touch' && event.type !== 'click')) return;
    const [x, y] = pointInView(event.currentTarget as Element, picture.view, event);
    const index = picture.nearest(simulation, x, y);
    if (index >= 0 || event.type === 'click') this.mark(index);
  }

  /** True if the selected sample is shown. */
  get isMarked() {
    return this.selectedIndex >= 0 && this.selectedIndex < this.#latest.shown;
  }

  /** True if the selected sample is shown or will be. */
  get #isWanted() {
    return this.selectedIndex >= 0 && this.selectedIndex < this.selectableCount;
  }

  /** Number of samples that can be selected or pinned, including those that are still to be added. */
  get selectableCount() {
    return this.playing ? this.#samples : this.targetCount;
  }

  /** Clears the selection if the selected sample is not shown and will not be. */
  unmark() {
    if (!this.#isWanted) this.mark(-1);
  }

  /** Adds samples in a frame. The first frame after a change shows one block, so that drags are quick. */
  advance() {
    if (this.playing) this.grow();
    else if (!this.host.settings.isStale) this.refine();
  }

  grow() {
    this.show(this.#latest.shown + this.#batchSize);
    if (!this.isComplete) return;
    this.#requestedCount = Infinity;
    this.playing = false;
    this.host.announcer.announceNext();
  }

  /** Runs the action of a button of the cloud, and sets `playing`. */
  #control(playing: boolean, action: () => void) {
    if (!this.host.simulation) return;
    action();
    this.playing = playing;
    this.host.gesture.complete();
    this.host.renderer.requestFrame();
  }

  buttons(seedField: unknown) {
    const cloudWords = words.cloud;
    const playOrPause = () => this.#control(!this.playing, () => {
      if (!this.playing && this.isComplete) this.#restart();
    });
    const [label, otherLabel] = this.playing ? [words.pause, cloudWords.play] : [cloudWords.play, words.pause];
    return html`<div class="buttons">
      ${button(label, playOrPause, { title: cloudWords.playTitle, otherLabel })}
      ${button(words.step, () => this.#control(false, () => this.show(this.#latest.shown + this.#batchSize)), { title: cloudWords.step(integer(this.#batchSize)), disabled: this.isComplete })}
      ${button(words.clear, () => this.#control(false, () => this.#restart()), { title: cloudWords.clear })}
      ${seedField} ${button(words.newSeed, () => this.host.gesture.decide(() => ({ seed: this.host.motion.randomSeed() })), { title: cloudWords.reseed })}
    </div>`;
  }
}

/**
 * Sets a new simulation to a state if there is one, with the first block of its samples, and returns it. Throws a TypeError or RangeError for
 * an invalid state.
 */
export function enterCloud<M extends GrowingSimulation>({ settings }: Figure, simulation: M, state?: Values): M {
  if (!state) return simulation;
  simulation.configureFirst(settings.pick(state), 0);
  simulation.configureFirst({}, checkedInteger('state.shown', state.shown, 0, simulation.config.samples));
  return simulation;
}

/** Read-only properties of elements with a cloud. */
export const cloudProperties: PropertyDescriptorMap & ThisType<Figure> = {
  playing: { get() { return (this.cloud as Cloud).playing; } },
  poses: { get() { return this.querySimulation((simulation) => simulation.poses); } },
};
