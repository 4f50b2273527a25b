/** Map Squeeze's controls: start positions, command, noise, sampler, and maps of the user. */

import { html, nothing } from 'lit';
import { settingCheckbox, settingRadios, cloudControls, settingSlider, settingSliders } from '../../figure/controls.ts';
import { words } from '../../messages/registry.ts';
import { button, group, radioGroup } from '../../ui/controls.ts';
import { EXTENSIONS } from './maps/open.ts';
import { presetButtons, startOverButton } from '../shared/presets.ts';
import { COMMAND_SLIDERS, MAX_SAMPLES, SAMPLE_COUNTS } from './settings.ts';
import type { MapSqueezeElement as Figure } from './map-squeeze.ts';

/** Example of a floor plan: a room with a gap in its wall. */
const EXAMPLE_PLAN = `{
  "bounds": [0, 0, 6, 4],
  "walls": [
    [3, 0, 3, 1.5], [3, 2.5, 3, 4],
    [0, 0, 6, 0], [6, 0, 6, 4],
    [6, 4, 0, 4], [0, 4, 0, 0]
  ]
}`;

/** Returns the buttons of start positions in the current map. The presets are only offered in the apartment. */
export function startControls(figure: Figure) {
  const { own } = words.squeeze;
  if (!figure.map) return presetButtons(figure);
  return html`<div class="buttons presets">
    ${button(own.leave, () => figure.openMap(null))} ${button(own.open, () => figure.moveToFreePose())} ${startOverButton(figure)}
  </div>`;
}

export function samplerControls(figure: Figure) {
  const { conditioned, sampler, samples, steps } = figure.viewModel.config;
  const { settings, samplers, samplerEffects } = words.squeeze;
  // With sub-steps each sample takes several draws.
  const maxSampleCountOf = (name: string) => (name === 'sub-stepped' ? Math.floor(MAX_SAMPLES / steps) : MAX_SAMPLES);
  const chooseSampler = (name: string) => figure.gesture.decide({ sampler: name, ...(samples > maxSampleCountOf(name) && { samples: maxSampleCountOf(name) }) });
  return html`<div class="judge">
    ${radioGroup(settings.sampler.name, 'sampler', samplers, sampler, chooseSampler)}
    <p class="effect muted small">${samplerEffects[conditioned ? sampler : 'off']}</p>
    ${conditioned && sampler === 'sub-stepped' ? settingSlider(figure, 'steps') : nothing}
  </div>`;
}

export function motionControls(figure: Figure) {
  return html`${group(words.command, settingSliders(figure, COMMAND_SLIDERS))}
    ${group(words.noise, settingSlider(figure, 'noise'), 'single')} ${cloudControls(figure, SAMPLE_COUNTS)}`;
}

/** Returns the controls that are changed less often. One of them is for unknown cells, if the map has any. */
export function robotAndMapControls(figure: Figure, hasUnknown: boolean) {
  const { robotAndMap: heading, condition, settings, unknown, views } = words.squeeze;
  return group(heading, html`${settingSlider(figure, 'clearance')} ${settingCheckbox(figure, 'conditioned', condition)}
    ${hasUnknown ? settingRadios(figure, 'unknown', unknown) : nothing}
    ${radioGroup(settings.view.name, 'view', views, figure.state.elementState.view, (view) => figure.gesture.choose('view', view))}`);
}

/** Returns the controls for a map of the user's own, with the name and size of the present map. */
export function userMapControls(figure: Figure, opener: import('./maps/open.ts').MapOpener, mapText: string) {
  const texts = words.squeeze.own;
  const pasteMap = () => {
    const mapField = figure.renderRoot.querySelector('#map-text') as HTMLTextAreaElement;
    opener.paste(mapField.value);
  };
  return group(texts.legend, html`<div class="own-map figures">
    <div>
      <p>${texts.text}</p>
      <p>${opener.button('map-files', texts.files, EXTENSIONS)}</p>
      <p ?hidden=${!opener.isReading}>${texts.reading}</p>
      ${opener.refusalNoteHtml}
      <p class="present muted">${mapText}.</p>
    </div>
    <div>
      <label for="map-text">${texts.plan}</label>
      <textarea id="map-text" rows="8" spellcheck="false" autocomplete="off" .defaultValue=${EXAMPLE_PLAN}></textarea>
      ${button(texts.use, pasteMap)}
    </div>
  </div>`);
}
