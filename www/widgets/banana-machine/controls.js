/**
 * The Banana Machine's controls: the command, the noise and the overlays.
 *
 * @module
 */

import { html } from 'lit';
import { live } from 'lit/directives/live.js';
import { words } from '../../messages/registry.js';
import { button, radioGroup, sliderRow, toggle } from '../../ui/controls.js';
import { DASHES } from '../../scene/draw.js';
import { fixed } from '../../ui/format.js';
import { alphaName, alphaSymbol } from '../shared/command.js';
import { COMMAND_SLIDERS, OVERLAYS } from './settings.js';

/**
 * @typedef {import('../../types.d.ts').Settings} Settings
 * @typedef {import('../../types.d.ts').Preset} Preset
 * @typedef {import('../../types.d.ts').OverlayName} Overlay
 *
 * @typedef {Partial<Settings> | ((wanted: Settings) => Partial<Settings>)} Change settings, or what
 *   makes them from those wanted so far
 *
 * @typedef {object} Actions what the controls ask of the element
 * @property {(settings: Change) => void} change takes effect with the next frame
 * @property {() => void} commit after the last of a row of changes, which it puts into effect
 * @property {(index: number) => void} isolate the α to leave alone in effect, from 0
 */

const COMMAND_KEYS = /** @type {const} */ (['v', 'omega', 'dt']);

/** Upper end of the α sliders: a standard deviation of nearly half the command. */
const ALPHA_MAX = 0.2;
const ALPHA_STEP = 0.001;

/**
 * @param {Settings} config
 * @param {Preset[]} presets
 * @param {Actions} actions
 */
export function commandControls(config, presets, { change, commit }) {
  const { command } = config;
  return html`
    <fieldset>
      <legend>${words.command}</legend>
      <div class="buttons">
        ${presets.map(({ name, v, omega, dt }) =>
          button(
            words.banana.presets[name],
            () => {
              change({ command: { v, omega, dt } });
              commit();
            },
            { pressed: command.v === v && command.omega === omega && command.dt === dt },
          ),
        )}
      </div>
      ${COMMAND_KEYS.map((key) => {
        const { symbol, unit, ...range } = COMMAND_SLIDERS[key];
        return sliderRow({
          ...range,
          id: key,
          symbol: html`<i>${symbol}</i>`,
          name: words.settings[key].name,
          value: command[key],
          show: (value) => `${fixed(value, 2)} ${unit}`,
          effect: words.banana.settings[key].effect,
          role: 'prior',
          input: (value) => change(({ command }) => ({ command: { ...command, [key]: value } })),
          commit,
        });
      })}
    </fieldset>
  `;
}

/**
 * @param {Settings} config
 * @param {number} chosen the α that Isolate would leave, from 0
 * @param {Actions} actions
 */
export function noiseControls(config, chosen, { change, commit, isolate }) {
  const { model, noise, alphas } = config;
  const isolated = config.isolate !== null;
  const say = words.banana;
  return html`
    <fieldset>
      <legend>${say.modelAndNoise}</legend>
      ${radioGroup(say.settings.model.name, 'model', say.models, model, (name) => {
        change({ model: name, isolate: null });
        commit();
      })}
      ${radioGroup(say.settings.noise.name, 'noise', say.noises, noise, (name) => {
        change({ noise: name });
        commit();
      })}
    </fieldset>
    <fieldset class="alphas">
      <legend>${say.settings.alphas.name}</legend>
      ${toggle({
        label: say.isolate,
        checked: isolated,
        change: (on) => {
          change({ isolate: on ? chosen + 1 : null });
          commit();
        },
      })}
      ${alphas.map((alpha, index) => {
        const off = isolated && config.isolate !== index + 1;
        return sliderRow({
          id: `alpha${index + 1}`,
          symbol: alphaSymbol(index),
          value: alpha,
          min: 0,
          max: ALPHA_MAX,
          step: ALPHA_STEP,
          show: (value) => (off ? say.off(fixed(value, 3)) : fixed(value, 3)),
          effect: effectOf(say.settings.alphas.effects[model][index]),
          role: 'prediction',
          off,
          pick: isolated ? isolateButton(index, !off, isolate) : undefined,
          input: (value) => {
            if (off) isolate(index);
            change(({ alphas }) => ({ alphas: alphas.with(index, value) }));
          },
          commit,
        });
      })}
    </fieldset>
  `;
}

/** @param {string[]} effect the noise that an α feeds, and what that does to the picture */
function effectOf([path, picture]) {
  return html`<span class="path">${path}:</span> ${picture}.`;
}

/**
 * @param {number} index
 * @param {boolean} checked
 * @param {(index: number) => void} isolate
 */
function isolateButton(index, checked, isolate) {
  return html`<label class="choice">
    <input
      type="radio"
      name="isolate"
      aria-label=${words.banana.only(alphaName(index))}
      .checked=${live(checked)}
      @change=${() => isolate(index)}
    />
  </label>`;
}

/**
 * The legend of the floor, in which each overlay can be turned off.
 *
 * @param {readonly Overlay[]} shown
 * @param {(shown: Overlay[]) => void} change
 */
export function overlayToggles(shown, change) {
  return html`<div class="legend" part="legend" role="group" aria-label=${words.banana.overlaysLabel}>
    ${OVERLAYS.map((name) =>
      toggle({
        label: html`<svg class="swatch ${name}" viewBox="0 0 30 8" aria-hidden="true">
            <line x1="1" x2="29" y1="4" y2="4" stroke-dasharray=${DASHES[name].join(' ')} />
          </svg>
          <span>${words.banana.overlays[name]}</span>`,
        checked: shown.includes(name),
        change: (checked) => change(OVERLAYS.filter((each) => (each === name ? checked : shown.includes(each)))),
      }),
    )}
  </div>`;
}
