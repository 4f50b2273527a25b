/**
 * Map Squeeze's controls: where the robot stands, what it is told, how draws are judged, and maps of
 * the reader's own.
 *
 * @module
 */

import { html, nothing } from 'lit';
import { words } from '../../messages/registry.js';
import { button, choice, inputOf, radioGroup, rich, sliderRow, toggle } from '../../ui/controls.js';
import { fixed } from '../../ui/format.js';
import { EXTENSIONS } from './maps/files.js';
import {
  CLEARANCE_SLIDER,
  COMMAND_SLIDERS,
  NOISE_SLIDER,
  SAMPLERS,
  STEPS_SLIDER,
} from './settings.js';

/**
 * @typedef {import('../../types.d.ts').SqueezeSettings} Settings
 * @typedef {import('../../types.d.ts').MapSqueezeClass} MapSqueezeClass
 *
 * @typedef {Partial<Settings> | ((wanted: Settings) => Partial<Settings>)} Change settings, or what
 *   makes them from those wanted so far
 *
 * @typedef {object} Actions what the controls ask of the element
 * @property {(settings: Change) => void} change takes effect with the next frame
 * @property {() => void} commit after the last of a row of changes, which it puts into effect
 */

const COMMAND_KEYS = /** @type {const} */ (['v', 'omega', 'dt']);

/** A floor plan to start from: a room with a gap in its wall. */
const EXAMPLE = `{
  "bounds": [0, 0, 6, 4],
  "walls": [
    [3, 0, 3, 1.5], [3, 2.5, 3, 4],
    [0, 0, 6, 0], [6, 0, 6, 4],
    [6, 4, 0, 4], [0, 4, 0, 0]
  ]
}`;

/**
 * @param {Settings} config
 * @param {{ own: boolean, close: boolean, look: (close: boolean) => void }} map whether it is the
 *   reader's own, and whether the view is close
 * @param {MapSqueezeClass['presets']} presets
 * @param {(start: Settings['start']) => void} go puts the robot into the apartment
 */
export function placeControls({ start }, { own, close, look }, presets, go) {
  const there = (/** @type {Settings['start']} */ { x, y, theta }) =>
    !own && start.x === x && start.y === y && start.theta === theta;
  const say = words.squeeze;
  return html`<fieldset>
    <legend>${say.place}</legend>
    <div class="buttons">
      ${presets.map((preset) =>
        button(say.presets[preset.name], () => go(preset.start), { pressed: there(preset.start) }),
      )}
    </div>
    ${radioGroup(say.settings.view.name, 'view', say.views, close ? 'close' : 'whole', (name) => look(name === 'close'))}
  </fieldset>`;
}

/**
 * @param {Settings} config
 * @param {Actions} actions
 */
export function judgeControls({ conditioned, sampler, steps }, { change, commit }) {
  const now = (/** @type {Partial<Settings>} */ settings) => {
    change(settings);
    commit();
  };
  const say = words.squeeze;
  return html`<fieldset class="judge">
    <legend>
      ${say.map}
      ${toggle({ label: say.condition, checked: conditioned, change: (on) => now({ conditioned: on }) })}
    </legend>
    <div class="samplers" role="radiogroup" aria-label=${say.settings.sampler.name} aria-describedby="sampler-effect">
      ${SAMPLERS.map((name) =>
        choice({
          group: 'sampler',
          label: say.samplers[name],
          checked: name === sampler,
          choose: () => now({ sampler: name }),
        }),
      )}
    </div>
    <p class="effect" id="sampler-effect">
      ${rich(say.samplerEffects[conditioned ? sampler : 'off'])}
    </p>
    ${sampler === 'sub-stepped'
      ? sliderRow({
          ...STEPS_SLIDER,
          id: 'steps',
          symbol: html`<i>k</i>`,
          name: say.settings.steps.name,
          effect: rich(say.settings.steps.effect),
          value: steps,
          show: String,
          role: 'prediction',
          off: !conditioned,
          input: (value) => change({ steps: value }),
          commit,
        })
      : nothing}
  </fieldset>`;
}

/**
 * @param {Settings} config
 * @param {MapSqueezeClass} squeeze
 * @param {Actions} actions
 */
export function motionControls({ command, alphas, clearance }, squeeze, { change, commit }) {
  const say = words.squeeze;
  return html`<fieldset>
    <legend>${say.commandAndNoise}</legend>
    ${COMMAND_KEYS.map((key) => {
      const { symbol, unit, ...range } = COMMAND_SLIDERS[key];
      return sliderRow({
        ...range,
        id: key,
        symbol: html`<i>${symbol}</i>`,
        name: words.settings[key].name,
        value: command[key],
        show: (value) => `${fixed(value, 2)} ${unit}`,
        effect: say.settings[key].effect,
        role: 'prior',
        input: (value) => change(({ command }) => ({ command: { ...command, [key]: value } })),
        commit,
      });
    })}
    ${sliderRow({
      ...NOISE_SLIDER,
      id: 'noise',
      symbol: html`<i>n</i>`,
      name: say.settings.noise.name,
      effect: rich(say.settings.noise.effect),
      value: alphas[0],
      show: (value) => fixed(value, 3),
      role: 'prediction',
      input: (value) => change({ alphas: [...squeeze.alphasOfNoise(value)] }),
      commit,
    })}
    ${sliderRow({
      ...CLEARANCE_SLIDER,
      id: 'clearance',
      symbol: html`<i>r</i>`,
      name: say.settings.clearance.name,
      effect: say.settings.clearance.effect,
      value: clearance,
      show: (value) => `${fixed(value, 2)} m`,
      role: 'truth',
      input: (value) => change({ clearance: value }),
      commit,
    })}
  </fieldset>`;
}

/**
 * @param {object} panel
 * @param {string} panel.map the present one, with its size
 * @param {boolean} panel.own whether it is the reader's own
 * @param {string} panel.complaint about the last one that was refused; empty for none
 * @param {(files: File[]) => void} panel.choose
 * @param {() => void} panel.paste takes what the text field holds
 * @param {() => void} panel.leave back to the apartment
 */
export function ownMap({ map, own, complaint, choose, paste, leave }) {
  const say = words.squeeze.own;
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
          choose([...(input.files ?? [])]);
          // So that choosing the same file again, mended, is a change too.
          input.value = '';
        }}
      />
      <p class="note" role="alert" ?hidden=${complaint === ''}>${complaint}</p>
      <p class="present">${map}.</p>
      ${own ? button(say.leave, leave) : nothing}
    </div>
    <div>
      <label for="map-text">${say.plan}</label>
      <textarea id="map-text" rows="8" spellcheck="false" autocomplete="off" .defaultValue=${EXAMPLE}></textarea>
      ${button(say.use, paste)}
    </div>
  </fieldset>`;
}
