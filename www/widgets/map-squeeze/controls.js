/**
 * Map Squeeze's controls: where the robot stands, what it is told, how draws are judged, and maps of
 * the reader's own.
 */

import { html, nothing } from 'lit';
import { check, choices, slider, sliders } from '../../figure/controls.js';
import { words } from '../../messages/registry.js';
import { button, choice, radioGroup, rich } from '../../ui/controls.js';
import { fileInput } from '../shared/files.js';
import { EXTENSIONS } from './maps/open.js';
import { presetButtons, startOverButton } from '../shared/presets.js';
import { MOST_SAMPLES, MOTION, SAMPLERS } from './settings.js';

/** @typedef {import('./map-squeeze.js').MapSqueezeElement} Figure */

/** A floor plan to start from: a room with a gap in its wall. */
const EXAMPLE = `{
  "bounds": [0, 0, 6, 4],
  "walls": [
    [3, 0, 3, 1.5], [3, 2.5, 3, 4],
    [0, 0, 6, 0], [6, 0, 6, 4],
    [6, 4, 0, 4], [0, 4, 0, 0]
  ]
}`;

/** Places of the present map; the apartment's are not offered in another, which they would make the reader leave. @param {Figure} figure */
export function placeControls(figure) {
  const { map, left } = figure;
  const { own, pasted } = words.squeeze;
  if (!map) return presetButtons(figure, left ? button(own.back(left.name || pasted), () => figure.returnToMap()) : nothing);
  return html`<div class="buttons presets">
    ${button(own.open, () => figure.goToOpen(), { pressed: figure.inTheOpen })} ${button(own.leave, () => figure.leaveMap())}
    ${startOverButton(figure)}
  </div>`;
}

/** @param {Figure} figure */
export function viewChoice(figure) {
  const { settings: { view: { name } }, views } = words.squeeze;
  return radioGroup(name ?? '', 'view', views, figure.state.own.view, (view) => figure.gesture.choose('view', view));
}

/** What the cells are of which the map says nothing. @param {Figure} figure */
export function unknownChoice(figure) {
  return choices(figure, 'unknown', words.squeeze.unknown);
}

/** @param {Figure} figure */
export function judgeControls(figure) {
  const { conditioned, sampler, samples, steps } = figure.reading.config;
  const say = words.squeeze;
  // In steps there are as many fewer.
  const most = (/** @type {string} */ name) => (name === 'sub-stepped' ? Math.floor(MOST_SAMPLES / steps) : MOST_SAMPLES);
  const effect = say.samplerEffects[conditioned ? sampler : 'off'];
  return html`<fieldset class="judge">
    <legend class="visually-hidden">${say.map}</legend>
    ${check(figure, 'conditioned', say.condition)}
    <div class="choices" role="radiogroup" aria-label=${say.settings.sampler.name} aria-describedby="sampler-effect">
      ${SAMPLERS.map((name) =>
        choice({
          group: 'sampler',
          label: say.samplers[name],
          checked: name === sampler,
          choose: () => figure.gesture.decide({ sampler: name, ...(samples > most(name) && { samples: most(name) }) }),
        }),
      )}
    </div>
    <p class="effect caption" id="sampler-effect">${rich(effect)}</p>
  </fieldset>`;
}

/** @param {Figure} figure */
export function motionControls(figure) {
  const { conditioned, sampler } = figure.reading.config;
  return html`<fieldset>
    <legend class="visually-hidden">${words.squeeze.commandAndNoise}</legend>
    ${sliders(figure, MOTION)} ${slider(figure, 'steps', { off: !conditioned || sampler !== 'sub-stepped' })}
  </fieldset>`;
}

/**
 * @param {Figure} figure
 * @param {import('./maps/open.js').MapOpener} opener
 * @param {string} map the present one, with its size
 */
export function ownMap(figure, opener, map) {
  const say = words.squeeze.own;
  const paste = () => {
    const text = /** @type {HTMLTextAreaElement} */ (figure.renderRoot.querySelector('#map-text'));
    opener.paste(text.value);
  };
  const { complaint } = opener;
  return html`<fieldset class="own-map">
    <legend class="visually-hidden">${say.legend}</legend>
    <div>
      <p>${say.text}</p>
      <label for="map-files">${say.files}</label>
      ${fileInput('map-files', EXTENSIONS, (files) => opener.choose(files))}
      <p ?hidden=${!opener.isReading}>${say.reading}</p>
      <p class="note" role="alert" ?hidden=${complaint === ''}>${complaint}</p>
      <p class="present">${map}.</p>
    </div>
    <div>
      <label for="map-text">${say.plan}</label>
      <textarea id="map-text" rows="8" spellcheck="false" autocomplete="off" .defaultValue=${EXAMPLE}></textarea>
      ${button(say.use, paste)}
    </div>
  </fieldset>`;
}
