/**
 * Map Squeeze's controls: where the robot stands, what it is told, how draws are judged, and maps of
 * the reader's own.
 */

import { html, nothing } from 'lit';
import { check, slider, sliders } from '../../figure/controls.js';
import { words } from '../../messages/registry.js';
import { button, choice, inputOf, radioGroup, rich } from '../../ui/controls.js';
import { EXTENSIONS } from './maps/open.js';
import { MOTION, PRESETS, SAMPLERS } from './settings.js';

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

/** @param {Figure} figure */
export function placeControls(figure) {
  const { x, y, theta } = figure.reading.config.start;
  const { map, view } = figure.state.own;
  const say = words.squeeze;
  return html`<fieldset>
    <legend>${say.place}</legend>
    <div class="buttons">
      ${PRESETS.map(({ name, start }) =>
        button(say.presets[/** @type {keyof typeof say.presets} */ (name)], () => figure.go(start), {
          pressed: map === null && start.x === x && start.y === y && start.theta === theta,
        }),
      )}
    </div>
    ${radioGroup(say.settings.view.name, 'view', say.views, view, (name) => figure.choose('view', name))}
  </fieldset>`;
}

/** @param {Figure} figure */
export function judgeControls(figure) {
  const { conditioned, sampler } = figure.reading.config;
  const say = words.squeeze;
  return html`<fieldset class="judge">
    <legend>${say.map} ${check(figure, 'conditioned', say.condition)}</legend>
    <div class="choices" role="radiogroup" aria-label=${say.settings.sampler.name} aria-describedby="sampler-effect">
      ${SAMPLERS.map((name) =>
        choice({
          group: 'sampler',
          label: say.samplers[name],
          checked: name === sampler,
          choose: () => figure.decide({ sampler: name }),
        }),
      )}
    </div>
    <p class="effect" id="sampler-effect">${rich(say.samplerEffects[conditioned ? sampler : 'off'])}</p>
    ${sampler === 'sub-stepped' ? slider(figure, 'steps', { off: !conditioned }) : nothing}
  </fieldset>`;
}

/** @param {Figure} figure */
export function motionControls(figure) {
  return html`<fieldset>
    <legend>${words.squeeze.commandAndNoise}</legend>
    ${sliders(figure, MOTION)}
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
    <legend>${say.legend}</legend>
    <div>
      <p>${say.text}</p>
      <label for="map-files">${say.files}</label>
      <input
        id="map-files"
        type="file"
        multiple
        accept=${EXTENSIONS.join(',')}
        @change=${(/** @type {Event} */ event) => {
          const input = inputOf(event);
          opener.choose([...(input.files ?? [])]);
          // So that choosing the same file again, mended, is a change too.
          input.value = '';
        }}
      />
      <p class="note" role="alert" ?hidden=${complaint === ''}>${complaint}</p>
      <p class="present">${map}.</p>
      ${figure.map === null ? nothing : button(say.leave, () => figure.go(PRESETS[0].start))}
    </div>
    <div>
      <label for="map-text">${say.plan}</label>
      <textarea id="map-text" rows="8" spellcheck="false" autocomplete="off" .defaultValue=${EXAMPLE}></textarea>
      ${button(say.use, paste)}
    </div>
  </fieldset>`;
}
