/** Dead Reckoning's controls: the recursion, the path, its noise, and the samples. */

import { html } from 'lit';
import { choices, cloudControls, slider, sliders } from '../../figure/controls.js';
import { words } from '../../messages/registry.js';
import { group } from '../../ui/controls.js';
import { fixed } from '../../ui/format.js';
import { COMMAND, NOISE, SAMPLE_COUNTS } from './settings.js';

/** @typedef {import('./dead-reckoning.js').DeadReckoningElement} Figure */

/** Returns the choice of the recursion. @param {Figure} figure */
export function recursionChoice(figure) {
  return choices(figure, 'compounding', words.reckoning.recursions);
}

/** Returns what is changed most: the heading noise, and the number of steps of the same path. @param {Figure} figure */
export function pathControls(figure) {
  return html`<div class="controls" part="controls">
    ${slider(figure, 'headingNoise')} ${slider(figure, 'steps', { input: (steps) => figure.settings.want((wanted) => samePath(wanted, steps)) })}
  </div>`;
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

/** Returns the selected step to be typed, the command, the noise and the samples. @param {Figure} figure */
export function moreControls(figure) {
  const { steps, step, command: { dt } } = figure.settings.told;
  const { settings: { alphas }, walked, per } = words.reckoning;
  const effect = walked(fixed(step * dt, 2), fixed(steps * dt, 2));
  return html`<div class="controls">
    ${group(words.command, html`${sliders(figure, COMMAND)}
      ${slider(figure, 'step', { max: Math.max(2, steps), most: steps, off: steps === 1, effect })}`)}
    ${group(words.noise, html`${Object.keys(NOISE).map((key, i) => slider(figure, key, { effect: alphas.effects[i] }))}
      ${choices(figure, 'per', per)}`)}
    ${cloudControls(figure, SAMPLE_COUNTS)}
  </div>`;
}
