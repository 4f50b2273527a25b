/** Presentation of a figure to an audience: it fills the screen, and its controls are shown on demand. */

import { html, nothing } from 'lit';
import { words } from '../messages/registry.ts';
import { button } from '../ui/controls.ts';
import { FigureController } from './controller.ts';

/** Key that shows and hides the controls. */
const CONTROLS_KEY = 'c';

/** Key that restores the state that the figure had when the presentation began. */
const RESTORE_KEY = '0';

export class Presentation extends FigureController {
  /** True while the controls are shown. */
  #controls = false;
  /** State at the beginning; undefined if the figure opened in a presentation. */
  #stateAtBegin: import('./settings.ts').Values | undefined;
  /** Stops listening to keys; undefined while the figure is not presented. */
  #listening: AbortController | undefined;

  hostConnected() {
    this.follow();
    // The browser ends full screen by its own keys.
    this.host.addEventListener('fullscreenchange', this.#fullScreenChanged);
  }

  hostDisconnected() {
    void this.#endPresentation();
  }

  /** Begins or ends the presentation to match the attribute. */
  follow() {
    const { host } = this;
    if (!host.isConnected || host.presentation === (this.#listening !== undefined)) return;
    if (host.presentation) void this.#beginPresentation();
    else void this.#endPresentation();
  }

  async #beginPresentation() {
    const { host } = this;
    this.#stateAtBegin = host.machine && host.snapshot();
    host.copies.forget();
    this.#listening = new AbortController();
    addEventListener('keydown', this.#onKey, { signal: this.#listening.signal });
    const focusedButton = host.renderRoot?.querySelector('.to-present:focus-visible');
    await host.updateComplete;
    // A click should leave no focus ring in the presentation.
    this.#focus(focusedButton ? '.presenting button' : '.presenting');
    // Browsers allow a full screen only after a key press or a click. Some phones have no full screen.
    if (navigator.userActivation.isActive) await host.requestFullscreen?.().catch(() => {});
    if (!this.#listening) await this.#exitFullScreen();
    else if (!host.matches(':fullscreen')) {
      // A popover in the top layer fills the window even if an ancestor has a transform.
      host.popover = 'manual';
      host.showPopover();
    }
  }

  async #endPresentation() {
    if (!this.#listening) return;
    this.#listening.abort();
    this.#listening = undefined;
    this.#controls = false;
    await this.#exitFullScreen();
    await this.host.updateComplete;
    // Focusing the button scrolls the page back to the figure.
    this.#focus('.to-present');
  }

  async #exitFullScreen() {
    this.host.popover = null;
    if (this.host.matches(':fullscreen')) await document.exitFullscreen().catch(() => {});
  }

  #fullScreenChanged = () => {
    if (!this.host.matches(':fullscreen')) this.host.presentation = false;
  };

  #focus(selector: string) {
    (this.host.renderRoot.querySelector(selector) as HTMLElement | null)?.focus();
  }

  #onKey = ({ key, ctrlKey, altKey, metaKey, defaultPrevented }: KeyboardEvent) => {
    if (defaultPrevented || ctrlKey || altKey || metaKey) return;
    const { definition, machine, state } = this.host;
    const preset = definition.attributes.preset?.words?.[Number(key) - 1];
    if (key === 'Escape') this.host.presentation = false;
    else if (key.toLowerCase() === CONTROLS_KEY) this.#toggle();
    else if (key === RESTORE_KEY) this.#restoreState();
    else if (preset !== undefined && machine) state.choosePreset(preset);
  };

  #restoreState() {
    if (this.host.machine) this.host.state.goBack(this.#stateAtBegin);
  }

  #toggle() {
    this.#controls = !this.#controls;
    this.host.requestUpdate();
  }

  get className() {
    return this.#controls ? 'with-controls' : '';
  }

  button() {
    const say = words.presentation;
    return button(say.begin, () => (this.host.presentation = true), { title: say.title, name: 'to-present' });
  }

  render() {
    if (!this.#listening) return nothing;
    const say = words.presentation;
    const keyHint = (key: string, label: string) => html`<kbd>${key}</kbd> ${label}`;
    return html`<div class="presenting" role="group" tabindex="-1" aria-label=${say.begin}>
      ${button(keyHint(CONTROLS_KEY.toUpperCase(), say.controls), () => this.#toggle(), { pressed: this.#controls })}
      ${button(keyHint(RESTORE_KEY, say.back), () => this.#restoreState(), { title: say.backTitle })}
      ${button(keyHint('Esc', say.end), () => (this.host.presentation = false))}
    </div>`;
  }
}
