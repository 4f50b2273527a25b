/** Buttons of what is worth beginning with. */

import { html } from 'lit';
import { words } from '../../messages/registry.js';
import { button } from '../../ui/controls.js';

/**
 * @param {import('../../figure/figure.js').Figure} figure
 * @param {object} presets
 * @param {Record<string, string>} presets.names in the order shown, by what they are called in attributes
 * @param {string | null} presets.present which of them the figure is at
 * @param {(name: string) => Parameters<import('../../figure/gesture.js').Gesture['decide']>[0]} presets.settings to make for one
 * @param {Record<string, string | undefined>} [presets.titles] what one does that its name does not say
 */
export function presetButtons({ gesture, stage }, { names, present, settings, titles = {} }) {
  const begin = (/** @type {string} */ name) => {
    stage.release();
    gesture.decide(settings(name));
  };
  return html`<div class="buttons presets" role="group" aria-label=${words.beginWith}>
    ${Object.entries(names).map(([name, label]) => button(label, () => begin(name), { pressed: name === present, title: titles[name] }))}
  </div>`;
}
