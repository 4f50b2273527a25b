/** Buttons of the presets, and the button that restores the initial state. */

import { html } from 'lit';
import { words } from '../../messages/registry.ts';
import { button } from '../../ui/controls.ts';

/** Returns a button for each preset, of which the current one is pressed, and the button to start over. */
export function presetButtons(figure: import('../../figure/figure.ts').Figure) {
  const { definition, settings, state } = figure;
  const { presets } = (words as any)[definition.messageKey];
  const presetAttribute = definition.attributes.preset;
  const currentPreset = presetAttribute.get(settings.requested);
  return html`<div class="buttons presets" role="group" aria-label=${words.presets}>
    ${Object.entries(presets).map(([name, label]) =>
      button(label, () => state.choosePreset(name), { pressed: name === currentPreset, name: 'preset' }))}
    ${startOverButton(figure)}
  </div>`;
}

/** Returns the button that restores the state that the figure opened with. */
export const startOverButton = ({ state }: import('../../figure/figure.ts').Figure, restore = () => state.restoreAsUser()) => button(words.startOver, restore, { title: words.startOverTitle, name: 'start-over' });
