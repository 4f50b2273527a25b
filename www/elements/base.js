/**
 * What every widget needs: the core loaded, frames, canvases that match the screen's pixels, a
 * palette that follows the page, an end to the simulation when the element goes, and a sentence
 * instead of a blank when something fails.
 *
 * @module
 */

import { LitElement, html, nothing } from 'lit';
import { load } from '../core.js';
import { en } from '../messages/en.js';
import { onLanguage, setMessages, speak, words } from '../messages/registry.js';
import { resolvePalette } from '../ui/theme.js';
import { sleep, wake } from './frames.js';

/**
 * @typedef {import('../types.d.ts').Motion} Motion
 * @typedef {import('../types.d.ts').Palette} Palette
 */

setMessages('en', en);

/**
 * A widget over one simulation object of the core.
 *
 * Events: `error`, an ErrorEvent, when the widget cannot run; it does not bubble.
 *
 * @template {{ free(): void, config: object }} Machine
 */
export class WidgetElement extends LitElement {
  /** @type {Motion | undefined} the core, once it runs */
  motion;
  /** @type {Machine | undefined} the simulation, which owns all of its state */
  machine;
  /** @type {Palette | undefined} */
  palette;
  /** @type {string | undefined} the reason why it cannot run */
  #failure;
  /** @type {object | undefined} settings of the simulation that was freed on removal */
  #kept;
  /** @type {ResizeObserver | undefined} */
  #sizes;
  #drawable = false;
  /** Ends listening for other words. @type {(() => void) | undefined} */
  #silence;

  /**
   * Makes the simulation object.
   *
   * @param {Motion} _motion
   * @param {object} [_settings] those of an earlier simulation that this one takes up
   * @returns {Machine}
   */
  createMachine(_motion, _settings) {
    throw new Error('A widget makes its own machine.');
  }

  /** Called when the simulation is there, before anything of it is shown. */
  machineReady() {}

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

  connectedCallback() {
    super.connectedCallback();
    this.#silence = onLanguage(this, () => this.relabel());
    if (!this.machine) this.#start();
  }

  disconnectedCallback() {
    super.disconnectedCallback();
    this.#silence?.();
    // An element that is being moved is back in the document by the time the microtasks run.
    queueMicrotask(() => {
      if (!this.isConnected) this.#stop();
    });
  }

  /** Says everything again: the words or the language may be others. */
  relabel() {
    this.requestUpdate();
    this.wake();
  }

  /** Asks for one call of `draw`. */
  wake() {
    if (this.machine) wake(this);
  }

  /** @param {number} elapsed milliseconds */
  frame(elapsed) {
    if (!this.machine || !this.#drawable || !this.#hasSize) return;
    try {
      speak(this);
      this.palette ??= resolvePalette(this.#probe());
      this.draw(elapsed);
    } catch (error) {
      this.fail(error);
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
   * Shows a sentence in the widget's place and tells the page.
   *
   * @param {unknown} error
   */
  fail(error) {
    this.#stop();
    const reason = error instanceof Error ? error.message : String(error);
    this.#failure = reason;
    this.dispatchEvent(new ErrorEvent('error', { error, message: reason }));
    this.requestUpdate();
  }

  render() {
    speak(this);
    if (this.#failure !== undefined) return html`<p class="failure" role="alert">${words.failure(this.#failure)}</p>`;
    if (!this.machine) return nothing;
    return html`
      <span class="scheme-probe" aria-hidden="true" @transitionend=${this.#repaint}></span>
      ${this.renderWidget()}
    `;
  }

  updated() {
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
    try {
      const motion = await load();
      if (!this.isConnected || this.machine) return;
      this.motion = motion;
      this.machine = this.createMachine(motion, this.#kept);
      this.#failure = undefined;
      this.machineReady();
      this.requestUpdate();
    } catch (error) {
      this.fail(error);
    }
  }

  #stop() {
    sleep(this);
    this.#sizes?.disconnect();
    this.#drawable = false;
    this.palette = undefined;
    if (!this.machine) return;
    this.#kept = this.machine.config;
    this.machine.free();
    this.machine = undefined;
    this.requestUpdate();
  }

  #probe() {
    return /** @type {HTMLElement} */ (this.renderRoot.querySelector('.scheme-probe'));
  }

  #repaint() {
    this.palette = undefined;
    this.wake();
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
    // At once: a canvas that was resized is blank, and the next frame is too late to hide that.
    this.frame(0);
  }
}
