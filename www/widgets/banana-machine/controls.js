/** The Banana Machine's controls: the command, the noise and the overlays. */

import { html, nothing } from 'lit';
import { check, choices, slider, sliders } from '../../figure/controls.js';
import { words } from '../../messages/registry.js';
import { choice, toggle } from '../../ui/controls.js';
import { typed } from '../../ui/format.js';
import { presetButtons } from '../shared/presets.js';
import { presetIn, presetNamed } from './presets.js';
import { alphaName } from './reading.js';
import { COMMAND, DASHES, OVERLAYS } from './settings.js';

/** @typedef {import('./banana-machine.js').BananaMachineElement} Figure */

/** @param {Figure} figure */
export function presets(figure) {
  return presetButtons(figure, {
    names: words.banana.presets,
    present: presetIn(figure.reading.config),
    settings: (name) => (config) => presetNamed(name, /** @type {any} */ (config)),
  });
}

/** @param {Figure} figure */
export function commandControls(figure) {
  return html`<fieldset>
    <legend class="visually-hidden">${words.command}</legend>
    ${sliders(figure, COMMAND)}
  </fieldset>`;
}

/** @param {Figure} figure */
export function modelControls(figure) {
  const { model, alphas, isolate } = figure.reading.config;
  const say = words.banana;
  // From 1; the other model may have fewer.
  const chosen = Math.min(figure.state.own.isolateChoice, alphas.length);
  return html`<fieldset>
    <legend class="visually-hidden">${say.modelAndNoise}</legend>
    ${choices(figure, 'model', say.models)} ${choices(figure, 'noise', say.noises)}
    ${model === 'odometry' ? check(figure, 'reverseAware', say.reverseAware) : nothing}
    ${toggle({
      label: say.isolate,
      checked: isolate !== null,
      change: (on) => figure.gesture.decide({ isolate: on ? chosen : null }),
    })}
  </fieldset>`;
}

/** @param {Figure} figure */
export function alphaControls(figure) {
  const { model, alphas } = figure.reading.config;
  const { name, effects } = words.banana.settings.alphas;
  return html`<fieldset class="alphas">
    <legend class="visually-hidden">${name}</legend>
    ${alphas.map((_, index) => alphaSlider(figure, `alpha${index + 1}`, index + 1, effects[model][index]))}
  </fieldset>`;
}

/**
 * @param {Figure} figure
 * @param {string} key
 * @param {number} number from 1
 * @param {string[]} effect the noise that the α feeds, and what that does to the picture
 */
function alphaSlider(figure, key, number, [path, picture]) {
  const { isolate } = figure.reading.config;
  const off = isolate !== null && isolate !== number;
  const choose = () => figure.leaveAlone(number);
  return slider(figure, key, {
    off,
    pick: isolate === null ? undefined : choice({ group: 'isolate', name: words.banana.only(alphaName(number - 1)), checked: !off, choose }),
    show: (value) => (off ? words.banana.off(typed(value, 3)) : typed(value, 3)),
    effect: html`<span class="path">${path}:</span> ${picture}.`,
    input: (value) => {
      if (off) choose();
      figure.settings.want(({ alphas }) => ({ alphas: alphas.with(number - 1, value) }));
    },
  });
}

/** The legend of the floor, in which each overlay can be turned off. @param {Figure} figure */
export function overlayToggles(figure) {
  const { overlays: shown } = figure.state.own;
  return html`<div class="legend" part="legend" role="group" aria-label=${words.banana.overlaysLabel}>
    ${OVERLAYS.map((name) =>
      toggle({
        label: html`<svg class="swatch ${name}" viewBox="0 0 30 8" aria-hidden="true">
            <line x1="1" x2="29" y1="4" y2="4" stroke-dasharray=${DASHES[name].join(' ')} />
          </svg>
          <span>${words.banana.overlays[name]}</span>`,
        checked: shown.includes(name),
        change: (checked) =>
          figure.gesture.choose('overlays', OVERLAYS.filter((each) => (each === name ? checked : shown.includes(each)))),
      }),
    )}
  </div>`;
}
