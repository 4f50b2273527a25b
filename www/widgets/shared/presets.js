/** Buttons of the presets, and the one that brings back how the figure opened. */

import { html, nothing } from 'lit';
import { words } from '../../messages/registry.js';
import { button } from '../../ui/controls.js';

/**
 * Returns a button for each preset, the present one pressed, and the one to start over.
 *
 * @param {import('../../figure/figure.js').Figure} figure
 * @param {unknown} [more] buttons after them
 */
export function presetButtons(figure, more = nothing) {
  const { gesture, kind, machine, settings, stage } = figure;
  const { presets, presetTitles = {} } = /** @type {any} */ (words)[kind.vocabulary];
  const preset = /** @type {import('../../figure/attributes.js').Setting} */ (kind.attributes.preset);
  const present = { config: settings.told, machine };
  const current = preset.get(present);
  const begin = (/** @type {string} */ name) => {
    stage.release();
    gesture.decide(preset.change(name, present));
  };
  return html`<div class="buttons presets" role="group" aria-label=${words.presets}>
    ${Object.entries(presets).map(([name, label]) =>
      button(label, () => begin(name), { pressed: name === current, title: presetTitles[name] }))}
    ${more} ${startOverButton(figure)}
  </div>`;
}

/** Returns the button that brings back how the figure opened. @param {import('../../figure/figure.js').Figure} figure */
export const startOverButton = ({ state }) => button(words.startOver, () => state.startOver(), { title: words.startOverTitle, name: 'start-over' });
