/**
 * Map Squeeze's controls: where the robot stands, what it is told, how draws are judged, and maps of
 * the reader's own.
 *
 * @module
 */

import { html, nothing } from 'lit';
import { button, choice, inputOf, radioGroup, sliderRow, toggle } from '../ui/controls.js';
import { fixed } from '../ui/format.js';
import { EXTENSIONS } from './map-squeeze-files.js';
import {
  CLEARANCE_SLIDER,
  COMMAND_SLIDERS,
  NOISE_SLIDER,
  PRESET_LABELS,
  SAMPLERS,
  SAMPLER_EFFECTS,
  SAMPLER_LABELS,
  STEPS_SLIDER,
} from './map-squeeze-words.js';

/**
 * @typedef {import('../types.d.ts').SqueezeSettings} Settings
 * @typedef {import('../types.d.ts').MapSqueezeClass} MapSqueezeClass
 *
 * @typedef {Partial<Settings> | ((wanted: Settings) => Partial<Settings>)} Change settings, or what
 *   makes them from those wanted so far
 *
 * @typedef {object} Actions what the controls ask of the element
 * @property {(settings: Change) => void} change takes effect with the next frame
 * @property {() => void} commit after the last of a row of changes, which it puts into effect
 */

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
  return html`<fieldset>
    <legend>Place</legend>
    <div class="buttons">
      ${presets.map((preset) =>
        button(PRESET_LABELS[preset.name], () => go(preset.start), { pressed: there(preset.start) }),
      )}
    </div>
    ${radioGroup('View', 'view', ['whole map', 'close-up'], close ? 'close-up' : 'whole map', (name) =>
      look(name === 'close-up'),
    )}
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
  return html`<fieldset class="judge">
    <legend>
      Map
      ${toggle({ label: 'Condition on it', checked: conditioned, change: (on) => now({ conditioned: on }) })}
    </legend>
    <div class="samplers" role="radiogroup" aria-label="Sampler" aria-describedby="sampler-effect">
      ${SAMPLERS.map((name) =>
        choice({
          group: 'sampler',
          label: SAMPLER_LABELS[name],
          checked: name === sampler,
          choose: () => now({ sampler: name }),
        }),
      )}
    </div>
    <p class="effect" id="sampler-effect">
      ${conditioned ? SAMPLER_EFFECTS[sampler] : 'Off: every draw is kept, wherever it ends.'}
    </p>
    ${sampler === 'sub-stepped'
      ? sliderRow({
          ...STEPS_SLIDER,
          id: 'steps',
          symbol: html`<i>k</i>`,
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
  return html`<fieldset>
    <legend>Command and noise</legend>
    ${COMMAND_SLIDERS.map(({ key, symbol, unit, effect, ...range }) =>
      sliderRow({
        ...range,
        id: key,
        symbol: html`<i>${symbol}</i>`,
        value: command[key],
        show: (value) => `${fixed(value, 2)} ${unit}`,
        effect,
        role: 'prior',
        input: (value) => change(({ command }) => ({ command: { ...command, [key]: value } })),
        commit,
      }),
    )}
    ${sliderRow({
      ...NOISE_SLIDER,
      id: 'noise',
      symbol: html`<i>n</i>`,
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
  return html`<fieldset class="own-map">
    <legend>A map of your own</legend>
    <div>
      <p>
        Drop files anywhere on this figure, or choose them here: a floor plan in JSON, or a map of ROS
        map_server, its YAML file and its PGM or PNG image together. They do not leave this device.
      </p>
      <label for="map-files">Map files</label>
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
      ${own ? button('Back to the apartment', leave) : nothing}
    </div>
    <div>
      <label for="map-text">Or a floor plan here, in metres</label>
      <textarea id="map-text" rows="8" spellcheck="false" autocomplete="off" .defaultValue=${EXAMPLE}></textarea>
      ${button('Use this plan', paste)}
    </div>
  </fieldset>`;
}
