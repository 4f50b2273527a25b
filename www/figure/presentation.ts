/** Presentation of a figure to an audience: it fills the screen, and its controls are shown on demand. */

import { html, nothing } from 'lit';
import { words } from '../messages/registry.ts';
import { button } from '../ui/controls.ts';
import { FigureController } from './controller.ts';

const CONTROLS_KEY = 'c';

/** Key that restores the state that the figure had when the presentation began. */
const RESTORE_KEY = '0';

export class Presentation extends FigureController {
  hasControls = false;
  /** State at the beginning; undefined if the figure opened in a presentation. */
  #stateAtBegin: import('./settings.ts').Values | undefined;
  /** Stops listening to keys; undefined while the figure is not presented. */
  #keyListeners: AbortController | undefined;

  hostConnected() {
    const { host } = this;
    this.matchAttribute();
    // The browser ends full screen by its own keys.
    host.addEventListener('fullscreenchange', () => {
      if (!host.matches(':fullscreen')) host.presentation = false;
    }, { signal: host.connection.signal });
  }

  hostDisconnected() {
    void this.#endPresentation();
  }

  matchAttribute() {
    const { host } = this;
    if (!host.isConnected || host.presentation === (this.#keyListeners !== undefined)) return;
    if (host.presentation) void this.#beginPresentation();
    else void this.#endPresentation();
  }

  async #beginPresentation() {
    const { host } = this;
    this.#stateAtBegin = host.simulation && host.snapshot();
    host.notice.dismiss();
    this.#keyListeners = new AbortController();
    addEventListener('keydown', this.#onKey, { signal: this.#keyListeners.signal });
    const focusedButton = host.renderRoot?.querySelector('.to-present:focus-visible');
    await host.updateComplete;
    // A click should leave no focus ring in the presentation.
    this.#focus(focusedButton ? '.presenting button' : '.presenting');
    // Browsers allow a full screen only after a key press or a click. Some phones have no full screen.
    if (navigator.userActivation.isActive) await host.requestFullscreen?.().catch(() => {});
    if (!this.#keyListeners) await this.#exitFullScreen();
    else if (!host.matches(':fullscreen')) {
      // A popover in the top layer fills the window even if an ancestor has a transform.
      host.popover = 'manual';
      host.showPopover();
    }
  }

  async #endPresentation() {
    if (!this.#keyListeners) return;
    this.#keyListeners.abort();
    this.#keyListeners = undefined;
    this.hasControls = false;
    await this.#exitFullScreen();
    await this.host.updateComplete;
    // Focusing the button scrolls the page back to the figure.
    this.#focus('.to-present');
  }

  async #exitFullScreen() {
    this.host.popover = null;
    if (this.host.matches(':fullscreen')) await document.exitFullscreen().catch(() => {});
  }

  #focus(selector: string) {
    (this.host.renderRoot.querySelector(selector) as HTMLElement | null)?.focus();
  }

  #onKey = ({ key, ctrlKey, altKey, metaKey, defaultPrevented }: KeyboardEvent) => {
    if (defaultPrevented || ctrlKey || altKey || metaKey) return;
    const { definition, simulation, settings } = this.host;
    const preset = definition.attributes.preset?.words?.[Number(key) - 1];
    if (key === 'Escape') this.host.presentation = false;
    else if (key.toLowerCase() === CONTROLS_KEY) this.#toggle();
    else if (key === RESTORE_KEY) this.#restoreState();
    else if (preset !== undefined && simulation) settings.choosePreset(preset);
  };

  #restoreState() {
    if (this.host.simulation) this.host.settings.restoreAsUser(this.#stateAtBegin);
  }

  #toggle() {
    this.hasControls = !this.hasControls;
    this.host.requestUpdate();
  }

  button() {
    return button(words.presentation.begin, () => (this.host.presentation = true), { title: words.presentation.title, name: 'to-present' });
  }

  render() {
    if (!this.#keyListeners) return nothing;
    const presentationWords = words.presentation;
    const keyHint = (key: string, label: string) => html`<b>${key}</b> ${label}`;
    return html`<div class="presenting" role="group" tabindex="-1" aria-label=${presentationWords.begin}>
      ${button(keyHint(CONTROLS_KEY.toUpperCase(), presentationWords.controls), () => this.#toggle(), { pressed: this.hasControls })}
      ${button(keyHint(RESTORE_KEY, presentationWords.back), () => this.#restoreState(), { title: presentationWords.backTitle })}
      ${button(keyHint('Esc', presentationWords.end), () => (this.host.presentation = false))}
    </div>`;
  }
}
