/**
 * What every widget needs: a core of its own once it comes near, frames while it is in sight, canvases
 * that match the screen's pixels, a palette that follows the page, another core when one traps, an end
 * to the simulation when the element goes, and a sentence instead of a blank when something fails.
 *
 * @module
 */

import { LitElement, html, noChange, nothing } from 'lit';
import { abandon, instantiate } from '../core.js';
import { en } from '../messages/en.js';
import { addEnglish, onLanguage, speak, words } from '../messages/registry.js';
import { resolvePalette } from '../ui/theme.js';
import { sleep, wake } from './page/frames.js';
import { surroundings } from './page/scheme.js';
import { unwatch, watch } from './page/sight.js';

/**
 * @typedef {import('../types.d.ts').Motion} Motion
 * @typedef {import('../ui/theme.js').Palette} Palette
 */

addEnglish(en);

/** Cores that may trap one after the other, without a picture between, until the widget gives up. */
const MOST_CRASHES = 3;

/**
 * A widget over one simulation object of a core.
 *
 * @template {{ free(): void }} Machine
 */
export class WidgetElement extends LitElement {
  /** The core, once it runs: an instance of its own. @type {Motion | undefined} */
  motion;
  /** @type {Machine | undefined} the simulation, which owns all of its state */
  machine;
  /** @type {Palette | undefined} */
  palette;
  /** @type {string | undefined} the reason why it cannot run */
  #failure;
  /** @type {ResizeObserver | undefined} */
  #sizes;
  #drawable = false;
  #near = false;
  #inSight = false;
  /** Whether there is something to draw when it comes into sight. */
  #due = false;
  #starting = false;
  /** Whether what is shown is that of a machine which is being made again. */
  #mending = false;
  #crashes = 0;
  /** @type {'light' | 'dark' | ''} */
  #surroundings = '';
  /** Ends listening for other words. @type {(() => void) | undefined} */
  #silence;

  /** What has to be there before the machine is made, besides the core. */
  async prepare() {}

  /**
   * Makes the simulation object, of the last good state if there was one before.
   *
   * @param {Motion} _motion
   * @returns {Machine}
   */
  createMachine(_motion) {
    throw new Error('A widget makes its own machine.');
  }

  /** Called when the simulation is there, before anything of it is shown. */
  machineReady() {}

  /** Called before the simulation is freed. */
  parting() {}

  /**
   * Brings the picture up to date. Called once in an animation frame after `wake`.
   *
   * @param {number} _elapsed milliseconds since the frame before
   */
  draw(_elapsed) {}

  /** The widget, when the simulation runs. @returns {unknown} */
  renderWidget() {
    return nothing;
  }

  /** Light, dark, or as the surroundings are. @returns {import('./page/scheme.js').Theme} */
  get theme() {
    return 'auto';
  }

  connectedCallback() {
    super.connectedCallback();
    this.#silence = onLanguage(this, () => this.relabel());
    watch(this);
  }

  disconnectedCallback() {
    super.disconnectedCallback();
    this.#silence?.();
    // An element that is being moved is back in the document by the time the microtasks run.
    queueMicrotask(() => {
      if (this.isConnected) return;
      unwatch(this);
      this.#near = this.#inSight = false;
      this.#stop();
    });
  }

  /** It is near enough to be made ready. */
  approach() {
    this.#near = true;
    this.#start();
  }

  /** @param {boolean} inSight */
  sight(inSight) {
    this.#inSight = inSight;
    if (inSight && this.#due) this.wake();
    if (!inSight) sleep(this);
  }

  get inSight() {
    return this.#inSight;
  }

  /** Says everything again: the words or the language may be others. */
  relabel() {
    this.requestUpdate();
    this.wake();
  }

  /** Asks for one call of `draw`, when there is somebody to see it. */
  wake() {
    this.#due = true;
    if (this.machine && this.#inSight) wake(this);
  }

  /** @param {number} elapsed milliseconds */
  frame(elapsed) {
    if (!this.machine || !this.#drawable || !this.#hasSize) return;
    this.#due = false;
    try {
      speak(this);
      this.palette ??= this.look();
      this.draw(elapsed);
      this.#crashes = 0;
    } catch (error) {
      if (!this.mend(error)) this.fail(error);
    }
  }

  /** Whether there is something to draw on: not inside a closed tab, where everything has size 0. */
  get #hasSize() {
    return [...this.renderRoot.querySelectorAll('canvas')].every(
      ({ width, height, clientWidth, clientHeight }) => Math.min(width, height, clientWidth, clientHeight) > 0,
    );
  }

  /** Whether the reader has asked for less motion. */
  get calm() {
    return matchMedia('(prefers-reduced-motion: reduce)').matches;
  }

  /**
   * Does what may trap, from outside of a frame.
   *
   * @template Result
   * @param {() => Result} work
   * @returns {Result | undefined} undefined where it trapped
   */
  attempt(work) {
    try {
      return work();
    } catch (error) {
      if (!this.mend(error)) throw error;
    }
  }

  /**
   * After a trap, takes a new core and the last good state: the old core's memory may be damaged, and
   * nothing of it is used again. What is shown stays until then.
   *
   * @param {unknown} error
   * @returns {boolean} whether it was one that this mends
   */
  mend(error) {
    if (!isTrap(error) || ++this.#crashes > MOST_CRASHES) return false;
    if (this.machine) abandon(this.machine);
    this.machine = this.motion = undefined;
    this.#mending = true;
    this.report(error);
    sleep(this);
    this.#start();
    return true;
  }

  /**
   * Tells the page of what went wrong.
   *
   * @param {unknown} error
   */
  report(error) {
    const message = messageOf(error);
    this.dispatchEvent(new ErrorEvent('error', { error, message, bubbles: true, composed: true }));
  }

  /**
   * Shows a sentence in the widget's place and tells the page.
   *
   * @param {unknown} error
   */
  fail(error) {
    if (this.machine && isTrap(error)) {
      abandon(this.machine);
      this.machine = undefined;
    }
    this.#mending = false;
    this.#stop();
    this.#failure = messageOf(error);
    this.report(error);
    this.requestUpdate();
  }

  shouldUpdate() {
    return !this.#mending;
  }

  render() {
    speak(this);
    const scheme = this.theme === 'auto' ? this.#surroundings : this.theme;
    return html`
      <span class="scheme-probe" aria-hidden="true" @transitionend=${this.#rescheme}></span>
      <div class="surface ${scheme}" @input=${stop} @change=${stop}>
        ${this.#content()}
      </div>
    `;
  }

  #content() {
    if (this.#failure !== undefined) return html`<p class="failure" role="alert">${words.failure(this.#failure)}</p>`;
    if (!this.machine) return html`<div class="reserved"></div>`;
    try {
      return this.renderWidget();
    } catch (error) {
      if (!this.mend(error)) this.fail(error);
      return noChange;
    }
  }

  updated() {
    if (!this.#drawable) this.#rescheme();
    if (!this.machine || this.#drawable) return;
    this.#drawable = true;
    this.#sizes = new ResizeObserver((entries) => this.#resize(entries));
    for (const canvas of this.renderRoot.querySelectorAll('canvas')) {
      try {
        this.#sizes.observe(canvas, { box: 'device-pixel-content-box' });
      } catch {
        this.#sizes.observe(canvas);
      }
    }
    this.wake();
  }

  async #start() {
    if (this.#starting || this.machine || !this.#near) return;
    this.#starting = true;
    try {
      const [motion] = await Promise.all([instantiate(), this.prepare()]);
      if (!this.#near) return;
      const machine = this.createMachine(motion);
      this.motion = motion;
      this.machine = machine;
      this.#failure = undefined;
      this.machineReady();
      // It may have trapped at once.
      if (this.machine) await this.#show();
    } catch (error) {
      this.fail(error);
    } finally {
      this.#starting = false;
    }
    // It went and came back meanwhile, or trapped again.
    if (this.#near && !this.machine && this.#failure === undefined) this.#start();
  }

  async #show() {
    const mended = this.#mending;
    this.#mending = false;
    this.requestUpdate();
    await this.updateComplete;
    if (mended) this.wake();
    else this.dispatchEvent(new Event('load', { bubbles: true, composed: true }));
  }

  #stop() {
    sleep(this);
    this.#sizes?.disconnect();
    this.#drawable = this.#mending = false;
    this.palette = undefined;
    if (this.machine) {
      this.attempt(() => this.parting());
      this.machine?.free();
    }
    this.machine = this.motion = undefined;
    this.requestUpdate();
  }

  /** The page's colours, or the element's theme, may be others. */
  #rescheme() {
    const now = surroundings(this.#probe('.scheme-probe'));
    if (now !== this.#surroundings) {
      this.#surroundings = now;
      this.requestUpdate();
    }
    this.repaint();
  }

  /** Takes the colours from the page again. */
  async repaint() {
    await this.updateComplete;
    this.palette = undefined;
    this.wake();
  }

  /** The colours as they are now. */
  look() {
    return resolvePalette(this.#probe('.surface'));
  }

  /** @param {string} selector */
  #probe(selector) {
    return /** @type {HTMLElement} */ (this.renderRoot.querySelector(selector));
  }

  /**
   * Gives each canvas as many pixels as the screen has under it.
   *
   * @param {ResizeObserverEntry[]} entries
   */
  #resize(entries) {
    for (const { target, contentRect, devicePixelContentBoxSize } of entries) {
      const canvas = /** @type {HTMLCanvasElement} */ (target);
      const exact = devicePixelContentBoxSize?.[0];
      canvas.width = exact?.inlineSize ?? Math.round(contentRect.width * devicePixelRatio);
      canvas.height = exact?.blockSize ?? Math.round(contentRect.height * devicePixelRatio);
    }
    // Inside a closed tab, nothing tells of a change of colours.
    this.palette = undefined;
    // At once: a canvas that was resized is blank, and the next frame is too late to hide that.
    this.frame(0);
  }
}

/**
 * Whether an error is the core's end: a trap, or what its glue throws where a machine is used after one,
 * which are plain errors. What refuses a value is a TypeError or RangeError.
 *
 * @param {unknown} error
 */
function isTrap(error) {
  if (typeof WebAssembly === 'undefined') return false;
  return error instanceof WebAssembly.RuntimeError || (error instanceof Error && error.constructor === Error);
}

/** @param {unknown} error */
function messageOf(error) {
  return error instanceof Error ? error.message : String(error);
}

/**
 * The native controls' own events stay inside: the element has one of its own for each gesture.
 *
 * @param {Event} event
 */
function stop(event) {
  event.stopPropagation();
}
