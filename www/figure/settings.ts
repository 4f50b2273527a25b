/**
 * What of the machine's settings is wanted and what is in effect: what the reader does takes effect with
 * the next frame, what the page does at once.
 */

import { Part } from './part.ts';
import { isTrap } from './trap.ts';

/** Settings by name. */
export type Values = Record<string, any>;

/** A few milliseconds' work a step; how much of it is done, from 0 to 1. */
export type Job = Generator<number, void>;

/** Longest work in a frame, milliseconds: with the pictures, a touch is answered within 50. */
export const LONGEST_WORK = 25;

/** What a machine does between two looks at the clock: a millisecond's work, ten on a slow phone. */
const SLICE = 50_000;

/** Lets a machine finish what it has begun. */
export function* advancing(machine: any): Job {
  while (machine.advance?.(SLICE) === false) yield machine.progress ?? 0;
}

export class Settings extends Part {
  /** Whether what is shown is no longer what the machine would say. */
  stale: boolean | undefined;
  /** The reader's changes that wait for the next frame. */
  #pending: Values = {};
  /** Changes that the machine has begun with, and that have not been read of it. */
  #begun: Values = {};
  /** What is being done. */
  #job: Job | undefined;
  /** What was begun last: the machine gives it up for what comes next. */
  #latest: Job | undefined;
  /** What the machine in the making was made with, and the present one was not: it is wanted of that if the other is stopped. */
  #former: Values = {};
  /** The machine that it is done with, where that is to take the place of the present one. */
  next: any;
  /** How much of it is done, from 0 to 1. */
  done = 0;
  #showing = false;

  /** Another machine is there: nothing waits for it. */
  reset() {
    this.stale = true;
    this.#job = this.next = undefined;
    this.#pending = {};
    this.#begun = {};
    this.#former = {};
  }

  /** The machine that was in the making is there. What the reader wanted meanwhile is still to come. */
  arrive() {
    const pending = this.#pending;
    this.reset();
    this.#pending = pending;
  }

  /** Those of some values that are declared settings of the machine. */
  declared(values: Values) {
    const keys = this.host.kind.declared.filter((setting) => !setting.in && !setting.of).map(({ key }) => key);
    return Object.fromEntries(keys.map((key) => [key, values[key]]));
  }

  /**
   * Those in effect, or that the machine has begun with: its copy of them takes long, and is not asked for where nothing has
   * changed since the last, nor can it be while the core is mended.
   */
  get present(): Values {
    const { machine, reading } = this.host;
    return this.stale && machine ? machine.config : reading.config;
  }

  /** Those in effect with the changes that are on their way; a machine in the making was made with all before it. */
  get wanted(): Values {
    return { ...this.present, ...this.#former, ...this.next?.config, ...this.#pending };
  }

  /** What controls show: what was read of the machine, with the changes that are on their way. */
  get told(): Values {
    return { ...this.host.reading.config, ...this.#begun, ...this.#former, ...this.#pending };
  }

  /** The machine has been read. */
  read() {
    this.stale = false;
    this.#begun = {};
  }

  /** The reader wants others, from the next frame on: a drag costs one configuration a frame. */
  want(change: Values | ((wanted: Values) => Values)) {
    this.host.runtime.attempt(() => {
      if (!this.host.machine) return;
      this.host.typing.forget();
      const values = () => (typeof change === 'function' ? change(this.wanted) : change);
      const given = values();
      const both = (key: string, other: string) => key in given && other in this.#pending;
      // Two ways to say the same are two changes, one after the other.
      if (this.host.kind.declared.some(({ key, of }) => of && (both(key, of) || both(of, key)))) {
        this.settle();
        this.host.refresh();
      }
      Object.assign(this.#pending, values());
      this.host.gesture.step();
      this.host.stage.wake();
    });
  }

  /**
   * The page wants others, at once.
   *
   * @throws {TypeError | RangeError} and nothing is changed
   */
  assign(values: Values) {
    this.host.runtime.attempt(() => {
      this.takeUp();
      this.#begin(values);
      this.#proceed(LONGEST_WORK);
      this.host.reflection.tell();
      this.host.stage.release();
      this.show();
    });
  }

  /**
   * Puts what is wanted into effect. A change that is refused is reported and forgotten.
   *
   * @param limit milliseconds that it may take
   * @returns whether all is in effect
   */
  settle(limit: number = Infinity): boolean {
    if (limit === Infinity) this.#proceed(limit);
    if (!this.#job) this.#beginPending();
    return this.#proceed(limit);
  }

  /** The machine begins with what the reader wants, so that its settings can be asked for before all is done with them. */
  takeUp() {
    if (this.#job && this.#job !== this.#latest) this.settle();
    else this.#beginPending();
  }

  #beginPending() {
    const pending = this.#pending;
    if (Object.keys(pending).length === 0) return;
    this.#pending = {};
    this.host.runtime.tolerate(() => this.#begin(pending));
  }

  #begin(values: Values) {
    const { machine } = this.host;
    if (!machine) return;
    // A machine that has all at once needs no slices.
    if (machine.begin) machine.begin(values);
    else machine.configure(values);
    // What it was doing it has given up by itself.
    this.#job = undefined;
    this.work();
    this.#latest = this.#job;
    Object.assign(this.#begun, values);
    this.stale = true;
  }

  /**
   * To be called when something has begun that `settle` is to go on with. It takes the place of what is being done.
   *
   * @param next the machine that it is done with, if that is to take the place of the present one
   */
  work(job: Job = advancing(this.host.machine), next: any = undefined) {
    if (this.#job) this.#giveWay();
    if (next) {
      this.#former = { ...this.#former, ...this.#pending };
      this.#pending = {};
    }
    this.#job = job;
    this.next = next;
    this.done = 0;
  }

  /**
   * Makes a machine ready that is to take the place of the present one, as far as there is time. What is wrong with it is
   * thrown where it shows by then; where it shows later, all stays as it is and `refuse` is called.
   *
   * @param end of that time, by performance.now()
   */
  prepare(next: any, job: Job, refuse: (error: unknown) => void, end: number) {
    const time = { isOver: false };
    this.work(this.#prepared(next, job, refuse, time), next);
    this.settle(end - performance.now());
    time.isOver = true;
  }

  *#prepared(next: any, job: Job, refuse: (error: unknown) => void, time: { isOver: boolean }): Job {
    try {
      yield* job;
    } catch (error) {
      if (!time.isOver || this.next !== next || isTrap(error)) throw error;
      this.abandon();
      this.show();
      refuse(error);
    }
  }

  /** What is being done is given up. */
  #giveWay() {
    if (this.next) {
      this.next.free();
    } else {
      this.host.machine.stop?.();
      this.#former = this.#begun;
      this.#begun = {};
    }
  }

  /**
   * @param limit milliseconds
   * @returns whether nothing is left to do
   */
  #proceed(limit: number): boolean {
    const began = performance.now();
    while (this.#job) {
      const job = this.#job;
      let step;
      try {
        step = job.next();
      } catch (error) {
        this.#drop();
        throw error;
      }
      if (!step.done) {
        this.done = step.value;
        if (performance.now() - began < limit) continue;
        this.host.progress.tell();
        return false;
      }
      // Its end may have been the beginning of another.
      if (this.#job !== job) continue;
      this.stale = true;
      this.#job = this.next = undefined;
    }
    this.host.progress.rest();
    return true;
  }

  /** Nothing goes on any more, and the machine that was in the making is freed. */
  #drop() {
    const { next } = this;
    this.#job = this.next = undefined;
    this.#pending = { ...this.#former, ...this.#pending };
    this.#begun = {};
    this.#former = {};
    this.host.progress.rest();
    next?.free();
  }

  /** The machine in the making is not wanted any more. */
  abandon() {
    if (this.next) this.#drop();
  }

  /** Whether what is being done can be stopped. */
  get canStop() {
    return this.next !== undefined || this.host.machine.stop !== undefined;
  }

  /** The reader does not want to wait: all is as it was before. */
  stop() {
    const { runtime, reflection, cloud } = this.host;
    runtime.attempt(() => {
      if (!this.#job || !this.canStop) return;
      if (!this.next) {
        this.host.machine.stop();
        cloud?.pause();
      }
      this.#drop();
      this.stale = true;
      reflection.tell();
      this.show();
    });
  }

  /** Shows what the page changed, also to one who listens while the element is out of sight. */
  show() {
    this.host.stage.wake();
    if (this.#showing) return;
    this.#showing = true;
    queueMicrotask(this.#showUnseen);
  }

  #showUnseen = () => {
    const { stage, runtime } = this.host;
    this.#showing = false;
    if (stage.inSight) return;
    runtime.attemptOrFail(() => {
      if (!this.settle(LONGEST_WORK)) {
        this.#showing = true;
        setTimeout(this.#showUnseen);
      } else if (this.stale) this.host.refresh();
    });
  };
}
