/** Presentation of a figure to an audience: it fills the screen, and its controls are shown on demand. */

import { html, nothing } from 'lit';
import { words } from '../messages/registry.ts';
import { buttonHtml } from '../ui/controls.ts';
import { FigureController } from './controller.ts';

const CONTROLS_KEY = 'c';

/** Key that restores the state that the figure had when the presentation began. */
const RESTORE_KEY = '0';

export class Presentation extends FigureController {
  showsControls = false;
  /** State at the beginning of the presentation; undefined if the figure opened in a presentation. */
  #stateAtStart: import('./settings.ts').StateValues | undefined;
  /** AbortController that removes the key listener at the end of the presentation; undefined while the figure is not presented. */
  #keyListenerAbort: AbortController | undefined;

  hostConnected() {
    const { host } = this;
    this.#syncWithProperty();
    // The user can also leave full screen by keys of the browser.
    host.addEventListener('fullscreenchange', () => {
      if (!host.matches(':fullscreen')) host.presentation = false;
    }, { signal: host.lifetime.signal });
  }

  hostDisconnected() {
    void this.#endPresentation();
  }

  hostUpdate() {
    this.#syncWithProperty();
  }

  #syncWithProperty() {
    const { host } = this;
    if (!host.isConnected || host.presentation === (this.#keyListenerAbort !== undefined)) return;
    if (host.presentation) void this.#beginPresentation();
    else void this.#endPresentation();
  }

  async #beginPresentation() {
    const { host } = this;
    this.#stateAtStart = host.simulation && host.takeSnapshot();
    host.notice.dismissNotice();
    this.#keyListenerAbort = new AbortController();
    addEventListener('keydown', this.#onKeyDown, { signal: this.#keyListenerAbort.signal });
    const focusedButton = host.renderRoot?.querySelector('.to-present:focus-visible');
    await host.updateComplete;
    // A click should leave no focus ring in the presentation.
    this.#focusElement(focusedButton ? '.presenting button' : '.presenting');
    // Full screen may fail: browsers allow it only after a key press or a click, and some phones do not have it.
    if (navigator.userActivation.isActive) await host.requestFullscreen?.().catch(() => {});
    if (!this.#keyListenerAbort) await this.#exitFullScreen();
    else if (!host.matches(':fullscreen')) {
      // A popover in the top layer fills the window even if an ancestor has a transform.
      host.popover = 'manual';
      host.showPopover();
    }
  }

  async #endPresentation() {
    if (!this.#keyListenerAbort) return;
    this.#keyListenerAbort.abort();
    this.#keyListenerAbort = undefined;
    this.showsControls = false;
    await this.#exitFullScreen();
    await this.host.updateComplete;
    // Focusing the button scrolls the page back to the figure.
    this.#focusElement('.to-present');
  }

  async #exitFullScreen() {
    this.host.popover = null;
    if (this.host.matches(':fullscreen')) await document.exitFullscreen().catch(() => {});
  }

  #focusElement(selector: string) {
    (this.host.renderRoot.querySelector(selector) as HTMLElement | null)?.focus();
  }

  #onKeyDown = ({ key, ctrlKey, altKey, metaKey, defaultPrevented }: KeyboardEvent) => {
    if (defaultPrevented || ctrlKey || altKey || metaKey) return;
    const { definition, simulation, settings } = this.host;
    const presetName = definition.attributes.preset?.words?.[Number(key) - 1];
    if (key === 'Escape') this.host.presentation = false;
    else if (key.toLowerCase() === CONTROLS_KEY) this.#toggleControls();
    else if (key === RESTORE_KEY) this.#restoreState();
    else if (presetName !== undefined && simulation) settings.choosePreset(presetName);
  };

  #restoreState() {
    if (this.host.simulation) this.host.settings.restoreAsUser(this.#stateAtStart);
  }

  #toggleControls() {
    this.showsControls = !this.showsControls;
    this.host.requestUpdate();
  }

  buttonHtml() {
    return buttonHtml(words.presentation.beginLabel, () => (this.host.presentation = true), { title: words.presentation.beginTitle, className: 'to-present' });
  }

  render() {
    if (!this.#keyListenerAbort) return nothing;
    const presentationWords = words.presentation;
    const keyHintHtml = (key: string, label: string) => html`<b>${key}</b> ${label}`;
    return html`<div class="presenting" role="group" tabindex="-1" aria-label=${presentationWords.beginLabel}>
      ${buttonHtml(keyHintHtml(CONTROLS_KEY.toUpperCase(), presentationWords.controlsLabel), () => this.#toggleControls(), { pressed: this.showsControls })}
      ${buttonHtml(keyHintHtml(RESTORE_KEY, presentationWords.restoreLabel), () => this.#restoreState(), { title: presentationWords.restoreTitle })}
      ${buttonHtml(keyHintHtml('Esc', presentationWords.endLabel), () => (this.host.presentation = false))}
    </div>`;
  }
}
