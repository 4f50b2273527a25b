/** Dead Reckoning's controls: the step that is looked at, what the path is made of, and how its covariance is carried. */

import { html } from 'lit';
import { choices, slider, sliders } from '../../figure/controls.js';
import { words } from '../../messages/registry.js';
import { fixed } from '../../ui/format.js';
import { COMMAND, NOISE } from './settings.js';

/** @typedef {import('./dead-reckoning.js').DeadReckoningElement} Figure */

/** @param {Figure} figure */
export function walkControls(figure) {
  const { steps, step, command: { dt } } = figure.settings.told;
  const { settings, walked } = words.reckoning;
  const effect = walked(fixed(step * dt, 2), fixed(steps * dt, 2));
  return html`<fieldset class="walk">
    <legend class="visually-hidden">${settings.step.name}</legend>
    ${slider(figure, 'step', { max: Math.max(2, steps), most: steps, off: steps === 1, effect })}
  </fieldset>`;
}

/** @param {Figure} figure */
export function recursionChoice(figure) {
  return choices(figure, 'compounding', words.reckoning.recursions);
}

/** What is changed most: the heading's noise, and the size of a step on the same path. @param {Figure} figure */
export function pathControls(figure) {
  return html`<fieldset>
    <legend class="visually-hidden">${words.reckoning.commandAndNoise}</legend>
    ${slider(figure, 'headingNoise')} ${slider(figure, 'steps', { input: (steps) => figure.settings.want((wanted) => samePath(wanted, steps)) })}
  </fieldset>`;
}

/**
 * The same way in another number of steps, seen from the same place on it.
 *
 * @param {Record<string, any>} wanted
 * @param {number} steps
 */
function samePath({ command, steps: before, step }, steps) {
  return { steps, step: Math.max(1, Math.round((step * steps) / before)), command: { ...command, dt: (command.dt * before) / steps } };
}

/** @param {Figure} figure */
export function commandAndNoise(figure) {
  const { name, effects } = words.reckoning.settings.alphas;
  return html`<div class="controls">
      <fieldset>
        <legend class="visually-hidden">${words.command}</legend>
        ${sliders(figure, COMMAND)}
      </fieldset>
      <fieldset>
        <legend class="visually-hidden">${name}</legend>
        ${Object.keys(NOISE).map((key, i) => slider(figure, key, { effect: effects[i] }))}
      </fieldset>
    </div>
    ${choices(figure, 'per', words.reckoning.per)}`;
}
