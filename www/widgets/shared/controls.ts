/** Controls that several figures share: buttons of the presets, the button that restores the initial state, and the player of an animation. */

import { html, nothing } from 'lit';
import { FigureController } from '../../figure/controller.ts';
import { settingSliderHtml } from '../../figure/controls.ts';
import { prefersReducedMotion } from '../../figure/renderer.ts';
import { words } from '../../messages/registry.ts';
import { buttonHtml } from '../../ui/controls.ts';

/** Returns a button for each preset, and the button that restores the initial state. The button of the current preset is pressed. */
export function presetButtonsHtml(figure: import('../../figure/figure.ts').Figure) {
  const { definition, settings } = figure;
  const { presets } = (words as any)[definition.messageKey];
  const currentPreset = definition.attributes.preset.getValue(settings.requestedValues);
  return html`<div class="buttons presets" role="group" aria-label=${words.presetsHeading}>
    ${Object.entries(presets).map(([presetName, presetLabel]) =>
      buttonHtml(presetLabel, () => settings.choosePreset(presetName), { isPressed: presetName === currentPreset, className: 'preset' }))}
    ${startOverButtonHtml(figure)}
  </div>`;
}

/** Returns the button that restores the state that the figure opened with. */
export const startOverButtonHtml = ({ settings }: import('../../figure/figure.ts').Figure, restoreState = () => settings.restoreAsUser()) => buttonHtml(words.startOver, restoreState, { title: words.startOverTitle, className: 'start-over' });

/** Player that animates a setting with a slider, from the current value to the maximum. At the maximum, it starts again from 0. */
export class Player<Key extends string> extends FigureController {
  /** Key of the animated setting. */
  #playedKey: Key | undefined;
  #playedSettings;

  /** Creates the player. `animatedSettings` has the maximum of each animated setting, and the duration of an animation from 0 to this maximum. */
  constructor(figure: import('../../figure/figure.ts').Figure, animatedSettings: Record<Key, { max: number, durationMs: number }>) {
    super(figure);
    this.#playedSettings = animatedSettings;
  }

  stopAnimation() {
    this.#playedKey = undefined;
  }

  /** Sets a setting to the value that the user has chosen, and stops the animation. */
  #setByUser(settingKey: Key, newValue: number) {
    this.stopAnimation();
    this.figure.settings.requestChange({ [settingKey]: newValue });
  }

  #valueOf(settingKey: Key): number {
    return this.figure.settings.requestedValues[settingKey];
  }

  #togglePlaying(settingKey: Key) {
    const { figure: { gesture, renderer, settings } } = this;
    const willPlay = this.#playedKey !== settingKey;
    if (this.#playedKey) gesture.commitChange();
    this.#playedKey = willPlay ? settingKey : undefined;
    this.figure.requestUpdate();
    if (willPlay && this.#valueOf(settingKey) >= this.#playedSettings[settingKey].max) settings.requestChange({ [settingKey]: 0 });
    renderer.requestFrame();
  }

  /** Advances the animation by the time since the previous frame. Returns true if the animation has to continue. */
  advanceAnimation(elapsedMs: number): boolean {
    if (!this.#playedKey) return false;
    // No time has elapsed if the picture is drawn again only because its size has changed. The animation does not advance then.
    if (elapsedMs === 0) return true;
    const { max, durationMs } = this.#playedSettings[this.#playedKey];
    const nextValue = Math.min(max, this.#valueOf(this.#playedKey) + (max * elapsedMs) / durationMs);
    this.figure.settings.requestChange({ [this.#playedKey]: nextValue });
    if (nextValue < max) return true;
    this.stopAnimation();
    this.figure.gesture.commitChange();
    return false;
  }

  /** Returns the slider of a setting with the button that plays and pauses. If the user prefers reduced motion, there is only the slider. */
  sliderHtml(settingKey: Key, playLabel: string) {
    const [currentLabel, otherLabel] = this.#playedKey === settingKey ? [words.pauseLabel, playLabel] : [playLabel, words.pauseLabel];
    return html`<div class="playable with-button ${settingKey}">
      ${settingSliderHtml(this.figure, settingKey, { onInput: (newValue) => this.#setByUser(settingKey, newValue) })}
      ${prefersReducedMotion() ? nothing : buttonHtml(currentLabel, () => this.#togglePlaying(settingKey), { otherLabel })}
    </div>`;
  }
}
