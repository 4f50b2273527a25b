/** Controls of several figures: the buttons of the presets, the button that restores the initial state, and the player of an animation. */

import { html, nothing } from 'lit';
import { FigureController } from '../../figure/controller.ts';
import { settingSliderHtml } from '../../figure/controls.ts';
import { prefersReducedMotion } from '../../figure/renderer.ts';
import { words } from '../../messages/registry.ts';
import { buttonHtml } from '../../ui/controls.ts';

/** Returns a button for each preset, of which the current one is pressed, and the button to start over. */
export function presetButtonsHtml(figure: import('../../figure/figure.ts').Figure) {
  const { definition, settings } = figure;
  const { presets } = (words as any)[definition.messageKey];
  const currentPreset = definition.attributes.preset.get(settings.requested);
  return html`<div class="buttons presets" role="group" aria-label=${words.presets}>
    ${Object.entries(presets).map(([presetName, label]) =>
      buttonHtml(label, () => settings.choosePreset(presetName), { pressed: presetName === currentPreset, className: 'preset' }))}
    ${startOverButtonHtml(figure)}
  </div>`;
}

/** Returns the button that restores the state that the figure opened with. */
export const startOverButtonHtml = ({ settings }: import('../../figure/figure.ts').Figure, restoreState = () => settings.restoreAsUser()) => buttonHtml(words.startOver, restoreState, { title: words.startOverTitle, className: 'start-over' });

/** Player that animates a slider from its current value to its maximum. At the maximum it starts again from 0. */
export class Player<Key extends string> extends FigureController {
  /** Key of the animated setting. */
  #playedKey: Key | undefined;
  #playedSettings;

  /** Creates the player. `animatedSettings` has the maximum of each animated setting, and the duration of the animation from 0 to the maximum. */
  constructor(host: import('../../figure/figure.ts').Figure, animatedSettings: Record<Key, { max: number, durationMs: number }>) {
    super(host);
    this.#playedSettings = animatedSettings;
  }

  stop() {
    this.#playedKey = undefined;
  }

  /** Sets a value that the user has chosen, and stops the animation. */
  #setByUser(settingKey: Key, newValue: number) {
    this.stop();
    this.host.settings.requestChange({ [settingKey]: newValue });
  }

  #valueOf(settingKey: Key): number {
    return this.host.settings.requested[settingKey];
  }

  #togglePlaying(settingKey: Key) {
    const { host: { gesture, renderer, settings } } = this;
    const willPlay = this.#playedKey !== settingKey;
    if (this.#playedKey) gesture.commit();
    this.#playedKey = willPlay ? settingKey : undefined;
    this.host.requestUpdate();
    if (willPlay && this.#valueOf(settingKey) >= this.#playedSettings[settingKey].max) settings.requestChange({ [settingKey]: 0 });
    renderer.requestFrame();
  }

  /** Advances the animation by the time since the previous frame. Returns true until the animation has reached its end. */
  advance(elapsedMs: number): boolean {
    if (!this.#playedKey) return false;
    // A picture that is drawn again only because of its size has no elapsed time, and does not advance the animation.
    if (elapsedMs === 0) return true;
    const { max, durationMs } = this.#playedSettings[this.#playedKey];
    const nextValue = Math.min(max, this.#valueOf(this.#playedKey) + (max * elapsedMs) / durationMs);
    this.host.settings.requestChange({ [this.#playedKey]: nextValue });
    if (nextValue < max) return true;
    this.stop();
    this.host.gesture.commit();
    return false;
  }

  /** Returns the slider of a setting with the button that plays and pauses. With reduced motion there is only the slider. */
  sliderHtml(key: Key, playLabel: string) {
    const [currentLabel, otherLabel] = this.#playedKey === key ? [words.pause, playLabel] : [playLabel, words.pause];
    return html`<div class="playable with-button ${key}">
      ${settingSliderHtml(this.host, key, { onInput: (value) => this.#setByUser(key, value) })}
      ${prefersReducedMotion() ? nothing : buttonHtml(currentLabel, () => this.#togglePlaying(key), { otherLabel })}
    </div>`;
  }
}
