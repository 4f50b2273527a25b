/** Presentation of a figure to an audience: it fills the screen, and its controls are shown on demand. */

import { html, nothing } from 'lit';
import { words } from '../messages/registry.ts';
import { buttonHtml } from '../ui/controls.ts';
import { FigureController } from './controller.ts';

const CONTROLS_KEY = 'c';

/** Key that restores the state that the figure had when the presentation began. */
const RESTORE_KEY = '0';

export class PresentationMode extends FigureController {
  showsControls = false;
  /** State at the beginning of the presentation; undefined if the figure opened in a presentation. */
  #stateAtStart: import('./settings.ts').StateValues | undefined;
  /** AbortController that removes the key listener at the end of the presentation; undefined while the figure is not presented. */
  #keyListenerAbort: AbortController | undefined;

  hostConnected() {
    const { figure } = this;
    this.hostUpdate();
    // The user can also leave full screen by keys of the browser.
    figure.addEventListener('fullscreenchange', () => {
      if (!figure.matches(':fullscreen')) figure.presentation = false;
    }, { signal: figure.lifetime.signal });
  }

  hostDisconnected() {
    void this.#endPresentation();
  }

  /** Begins or ends the presentation if the property `presentation` has changed. */
  hostUpdate() {
    const { figure } = this;
    if (!figure.isConnected || figure.presentation === (this.#keyListenerAbort !== undefined)) return;
    if (figure.presentation) void this.#beginPresentation();
    else void this.#endPresentation();
  }

  async #beginPresentation() {
    const { figure } = this;
    this.#stateAtStart = figure.simulation && figure.takeSnapshot();
    figure.notice.dismissNotice();
    this.#keyListenerAbort = new AbortController();
    addEventListener('keydown', this.#onKeyDown, { signal: this.#keyListenerAbort.signal });
    const focusedButton = figure.renderRoot?.querySelector('.to-present:focus-visible');
    await figure.updateComplete;
    // A button gets the focus only after a key press. After a click, its focus ring would distract the audience.
    this.#focusElement(focusedButton ? '.presenting button' : '.presenting');
    // Full screen may fail: browsers allow it only after a key press or a click, and some phones do not have it.
    if (navigator.userActivation.isActive) await figure.requestFullscreen?.().catch(() => {});
    if (!this.#keyListenerAbort) await this.#exitFullScreen();
    else if (!figure.matches(':fullscreen')) {
      // A popover in the top layer fills the window even if an ancestor has a transform.
      figure.popover = 'manual';
      figure.showPopover();
    }
  }

  async #endPresentation() {
    if (!this.#keyListenerAbort) return;
    this.#keyListenerAbort.abort();
    this.#keyListenerAbort = undefined;
    this.showsControls = false;
    await this.#exitFullScreen();
    await this.figure.updateComplete;
    // The button that starts a presentation gets the focus, so that the page scrolls back to the figure.
    this.#focusElement('.to-present');
  }

  async #exitFullScreen() {
    this.figure.popover = null;
    if (this.figure.matches(':fullscreen')) await document.exitFullscreen().catch(() => {});
  }

  #focusElement(elementSelector: string) {
    (this.figure.renderRoot.querySelector(elementSelector) as HTMLElement | null)?.focus();
  }

  #onKeyDown = ({ key: pressedKey, ctrlKey, altKey, metaKey, defaultPrevented }: KeyboardEvent) => {
    if (defaultPrevented || ctrlKey || altKey || metaKey) return;
    const { definition, simulation, settings } = this.figure;
    const presetName = definition.attributes.preset?.words?.[Number(pressedKey) - 1];
    if (pressedKey === 'Escape') this.figure.presentation = false;
    else if (pressedKey.toLowerCase() === CONTROLS_KEY) this.#toggleControls();
    else if (pressedKey === RESTORE_KEY) this.#restoreState();
    else if (presetName !== undefined && simulation) settings.choosePreset(presetName);
  };

  #restoreState() {
    if (this.figure.simulation) this.figure.settings.restoreAsUser(this.#stateAtStart);
  }

  #toggleControls() {
    this.showsControls = !this.showsControls;
    this.figure.requestUpdate();
  }

  buttonHtml() {
    return buttonHtml(words.presentation.beginLabel, () => (this.figure.presentation = true), { title: words.presentation.beginTitle, className: 'to-present' });
  }

  render() {
    if (!this.#keyListenerAbort) return nothing;
    const presentationWords = words.presentation;
    const keyHintHtml = (hintedKey: string, keyLabel: string) => html`<b>${hintedKey}</b> ${keyLabel}`;
    return html`<div class="presenting" role="group" tabindex="-1" aria-label=${presentationWords.beginLabel}>
      ${buttonHtml(keyHintHtml(CONTROLS_KEY.toUpperCase(), presentationWords.controlsLabel), () => this.#toggleControls(), { isPressed: this.showsControls })}
      ${buttonHtml(keyHintHtml(RESTORE_KEY, presentationWords.restoreLabel), () => this.#restoreState(), { title: presentationWords.restoreTitle })}
      ${buttonHtml(keyHintHtml('Esc', presentationWords.endLabel), () => (this.figure.presentation = false))}
    </div>`;
  }
}
