/** A figure before an audience: it fills the screen, and all but its pictures and figures waits behind a key. */

import { html, nothing } from 'lit';
import { words } from '../messages/registry.js';
import { button } from '../ui/controls.js';
import { Part } from './part.js';

/** The key that shows and hides the controls. */
const KEY = 'c';

/**
 * The window that a figure is laid out for then, CSS pixels; the screen shows it enlarged. Smaller, and the ticks of the
 * axes, 13 px here, are larger for those in the last row, but the sentence takes more of the picture's room.
 */
const LAYOUT = { width: 960, height: 540 };

/** With the controls, the smallest in which all of them stand beside and below a large picture. */
const WITH_CONTROLS = { width: 1280, height: 720 };

/** Who the screen is given to. @type {import('./figure.js').Figure | undefined} */
let presented;

/** That it is left, since it last was. @type {Promise<void> | undefined} */
let left;

export class Presentation extends Part {
  /** Whether the controls are shown. */
  #controls = false;
  /** Ends listening; there while the figure is presented. @type {AbortController | undefined} */
  #listening;
  /** How far the page was scrolled. */
  #scrolled = 0;
  /** How much larger everything is. */
  zoom = 1;
  /** Brings the page back. */
  #uncover = () => {};

  hostConnected() {
    this.follow();
    // The browser leaves the full screen by keys of its own.
    this.host.addEventListener('fullscreenchange', this.#left);
  }

  hostDisconnected() {
    this.#end();
  }

  /** The element may have become a presentation, or have been one. */
  follow() {
    const { host } = this;
    if (!host.isConnected || host.presentation === (this.#listening !== undefined)) return;
    host.requestUpdate();
    if (host.presentation) this.#begin();
    else this.#end();
  }

  #begin() {
    const { host } = this;
    if (presented) presented.presentation = false;
    presented = host;
    this.#listening = new AbortController();
    const { signal } = this.#listening;
    this.#scrolled = scrolled();
    addEventListener('keydown', this.#key, { signal });
    addEventListener('resize', this.#fit, { signal });
    this.#uncover = cover(host);
    this.#fit();
    // Where the screen is not to be had, as in most frames and without a key or a press, the window is filled.
    if (document.fullscreenEnabled && navigator.userActivation.isActive) this.#fill();
    host.updateComplete.then(() => this.#focus('.presenting button'));
  }

  async #fill() {
    await left;
    await this.host.requestFullscreen().catch(() => {});
    // It may have ended before that was granted.
    if (!this.#listening) this.#empty();
    // Nothing else takes the focus while another figure has the screen.
    else if (!this.host.matches(':focus-within')) this.#focus('.presenting button');
  }

  /** Leaves the screen, if the figure has it. */
  #empty() {
    if (this.host.matches(':fullscreen')) left = document.exitFullscreen().catch(() => {});
  }

  #end() {
    if (!this.#listening) return;
    this.#listening.abort();
    this.#listening = presented = undefined;
    this.#controls = false;
    this.#uncover();
    this.#enlarge(1);
    this.#empty();
    this.#restore();
  }

  /** Brings the reader back to where they were: the page was shorter meanwhile. */
  async #restore() {
    await left;
    await this.host.updateComplete;
    await new Promise(requestAnimationFrame);
    scrollTo({ top: this.#scrolled, behavior: 'instant' });
    this.#focus('.to-present');
  }

  #left = () => {
    if (!this.host.matches(':fullscreen')) this.host.presentation = false;
  };

  /** @param {string} selector */
  #focus(selector) {
    /** @type {HTMLElement | null} */ (this.host.renderRoot.querySelector(selector))?.focus({ preventScroll: true });
  }

  #fit = () => {
    const { width, height } = this.#controls ? WITH_CONTROLS : LAYOUT;
    this.#enlarge(Math.max(1, Math.min(innerWidth / width, innerHeight / height)));
  };

  /** @param {number} zoom */
  #enlarge(zoom) {
    this.zoom = zoom;
    this.host.style.setProperty('--zoom', String(zoom));
    this.host.stage.measure();
  }

  #key = (/** @type {KeyboardEvent} */ event) => {
    const { key, ctrlKey, altKey, metaKey, defaultPrevented } = event;
    if (defaultPrevented || ctrlKey || altKey || metaKey) return;
    if (key === 'Escape') this.host.presentation = false;
    else if (key.toLowerCase() === KEY) this.#toggle();
  };

  #toggle() {
    this.#controls = !this.#controls;
    this.host.requestUpdate();
    this.#fit();
  }

  /** What the surface is called meanwhile, for styles. */
  get className() {
    return this.#listening && this.#controls ? 'with-controls' : '';
  }

  /** The button that begins it. */
  button() {
    const say = words.presentation;
    return html`<span class="begin">${button(say.begin, () => (this.host.presentation = true), { title: say.title, name: 'to-present' })}</span>`;
  }

  /** What a reader can do meanwhile, with the keys for it. */
  render() {
    if (!this.#listening) return nothing;
    const say = words.presentation;
    const keyed = (/** @type {string} */ key, /** @type {string} */ label) => html`<kbd>${key}</kbd> ${label}`;
    return html`<div class="presenting">
      ${button(keyed(KEY.toUpperCase(), say.controls), () => this.#toggle(), { pressed: this.#controls })}
      ${button(keyed('Esc', say.end), () => (this.host.presentation = false))}
    </div>`;
  }
}

/** How far the page is scrolled. Without the figure it may be too short for that already, and asking would scroll it. */
function scrolled() {
  const { style } = document.documentElement;
  const { minHeight } = style;
  style.minHeight = '1e7px';
  const top = scrollY;
  style.minHeight = minHeight;
  return top;
}

/**
 * Puts all of a page but one element out of reach: it takes no focus, is not read out, and does not scroll.
 *
 * @param {Element} element
 * @returns {() => void} what undoes it
 */
function cover(element) {
  const { style } = document.documentElement;
  const { overflow } = style;
  style.overflow = 'hidden';
  /** @type {HTMLElement[]} */
  const covered = [];
  /** @type {any} */
  let at = element;
  for (; at; at = at.parentNode ?? at.host) {
    for (const each of at.parentNode?.children ?? []) if (each !== at && !each.inert) covered.push(each);
  }
  for (const each of covered) each.inert = true;
  return () => {
    style.overflow = overflow;
    for (const each of covered) each.inert = false;
  };
}
