/**
 * The Banana Machine's controls: the command, the noise, and the growth of the cloud.
 *
 * @module
 */

import { html } from 'lit';
import { live } from 'lit/directives/live.js';
import { button, choice, sliderRow, toggle } from '../ui/controls.js';
import { fixed, whole } from '../ui/format.js';
import { COMMAND_SLIDERS, PRESET_LABELS, alphaName, alphaSymbol, effectOf } from './banana-words.js';

/**
 * @typedef {import('../types.d.ts').Settings} Settings
 * @typedef {import('../types.d.ts').Preset} Preset
 *
 * @typedef {Partial<Settings> | ((wanted: Settings) => Partial<Settings>)} Change settings, or what
 *   makes them from those wanted so far
 *
 * @typedef {object} Actions what the controls ask of the element
 * @property {(settings: Change) => void} change takes effect with the next frame
 * @property {() => void} commit after the last of a row of changes, which it puts into effect
 * @property {(index: number) => void} isolate the α to leave alone in effect, from 0
 */

/** Upper end of the α sliders: a standard deviation of nearly half the command. */
const ALPHA_MAX = 0.2;
const ALPHA_STEP = 0.001;

/** Largest sample count of the slider: beyond it a drag no longer follows the finger. */
const MOST_SAMPLES = 200_000;

/** Sample counts of the slider, in the 1–2–5 steps of a logarithmic scale. */
const SAMPLE_COUNTS = [1, 2, 3, 4, 5]
  .flatMap((decade) => [1, 2, 5].map((step) => step * 10 ** decade))
  .filter((count) => count <= MOST_SAMPLES);

/**
 * @param {Settings} config
 * @param {Preset[]} presets
 * @param {Actions} actions
 */
export function commandControls(config, presets, { change, commit }) {
  const { command } = config;
  return html`
    <fieldset>
      <legend>Command</legend>
      <div class="buttons">
        ${presets.map(({ name, v, omega, dt }) =>
          button(
            PRESET_LABELS[name],
            () => {
              change({ command: { v, omega, dt } });
              commit();
            },
            { pressed: command.v === v && command.omega === omega && command.dt === dt },
          ),
        )}
      </div>
      ${COMMAND_SLIDERS.map(({ key, symbol, unit, effect, ...range }) =>
        sliderRow({
          ...range,
          id: key,
          symbol: html`<i>${symbol}</i>`,
          value: command[key],
          shown: `${fixed(command[key], 2)} ${unit}`,
          effect,
          role: 'prior',
          input: (value) => change(({ command }) => ({ command: { ...command, [key]: value } })),
          commit,
        }),
      )}
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
  return html`
    <fieldset>
      <legend>Model and noise</legend>
      ${radioGroup('Motion model', 'model', ['velocity', 'odometry'], model, (name) => {
        change({ model: name, isolate: null });
        commit();
      })}
      ${radioGroup('Noise', 'noise', ['normal', 'triangular'], noise, (name) => {
        change({ noise: name });
        commit();
      })}
    </fieldset>
    <fieldset class="alphas">
      <legend>Noise parameters</legend>
      ${toggle({
        label: 'Isolate one',
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
          shown: off ? `${fixed(alpha, 3)} off` : fixed(alpha, 3),
          effect: effectOf(model, index),
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
      aria-label="Only ${alphaName(index)}"
      .checked=${live(checked)}
      @change=${() => isolate(index)}
    />
  </label>`;
}

/**
 * @template {string} Name
 * @param {string} label
 * @param {string} group
 * @param {Name[]} names
 * @param {Name} current
 * @param {(name: Name) => void} choose
 */
export function radioGroup(label, group, names, current, choose) {
  return html`<div class="choices" role="radiogroup" aria-label=${label}>
    <span aria-hidden="true">${label}</span>
    ${names.map((name) =>
      choice({ group, label: name, checked: name === current, choose: () => choose(name) }),
    )}
  </div>`;
}

/**
 * @param {object} cloud
 * @param {Settings} cloud.config
 * @param {number} cloud.shown robots there are now
 * @param {boolean} cloud.playing
 * @param {number} cloud.batch robots that one step adds
 * @param {() => void} cloud.play
 * @param {() => void} cloud.step
 * @param {() => void} cloud.reset
 * @param {() => void} cloud.reseed
 * @param {Actions} actions
 */
export function cloudControls({ config, shown, playing, batch, play, step, reset, reseed }, { change, commit }) {
  const nearest = SAMPLE_COUNTS.findIndex((count) => count >= config.samples);
  return html`
    <fieldset class="cloud">
      <legend class="visually-hidden">Cloud</legend>
      <div class="buttons">
        ${button(playing ? 'Pause' : 'Play', play, { title: 'Grow the cloud' })}
        ${button('Step', step, { title: `Add ${whole(batch)} robots`, disabled: shown === config.samples })}
        ${button('Reset', reset, { title: 'Empty the cloud; the same seed sends the same robots' })}
        ${button('New seed', reseed, { title: 'Send other robots' })}
        <span class="seed">seed ${config.seed}</span>
      </div>
      ${sliderRow({
        id: 'samples',
        symbol: html`<i>N</i>`,
        name: 'N, robots in the whole cloud',
        value: nearest < 0 ? SAMPLE_COUNTS.length - 1 : nearest,
        min: 0,
        max: SAMPLE_COUNTS.length - 1,
        step: 1,
        shown: whole(config.samples),
        effect: 'Robots sent: dots with headings while they are few, a density when they are many.',
        role: 'truth',
        input: (value) => change({ samples: SAMPLE_COUNTS[value] }),
        commit,
      })}
    </fieldset>
  `;
}
