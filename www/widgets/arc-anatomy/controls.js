/** Controls of Arc Anatomy: the command, the noise, the heat map, the time along the arcs, and the lines of Table 5.1. */

import { html, nothing } from 'lit';
import { check, choices, sliders } from '../../figure/controls.js';
import { swatch } from '../../figure/overlays.js';
import { words } from '../../messages/registry.js';
import { button, group, rich } from '../../ui/controls.js';
import { fixed } from '../../ui/format.js';
import { track } from '../../ui/slider.js';
import { lineText } from './readouts.js';
import { ALPHAS, COMMAND, TABLE_LINES, WHOLE } from './settings.js';
import { CONTOURS } from './surface.js';

/** @typedef {import('./arc-anatomy.js').ArcAnatomyElement} Figure */

/** @param {Figure} figure */
export const commandControls = (figure) => group(words.command, sliders(figure, COMMAND));

/** @param {Figure} figure */
export const noiseControls = (figure) =>
  group(words.noise, html`${choices(figure, 'noise', words.anatomy.noises)} ${sliders(figure, ALPHAS)}`, 'alphas');

/** Returns the controls of the likelihood: the sign of the radius, and the heat map with the names of its contours. @param {Figure} figure */
export function likelihoodControls(figure) {
  const { likelihood, maps, printed } = words.anatomy;
  const { map } = figure.settings.told;
  const contour = (/** @type {'prob' | 'density'} */ name) =>
    html`<span>${swatch({ role: 'ink', width: 1, dash: CONTOURS[name] })} ${maps[name]}</span>`;
  return group(likelihood, html`${check(figure, 'printed', rich(printed))} ${choices(figure, 'map', maps)}
    ${map === 'none' ? nothing : html`<p class="legend contours">${contour('prob')} ${contour('density')}</p>`}`);
}

/**
 * A sign for the eye, words for the ear.
 *
 * @param {string} seen
 * @param {string} heard
 */
const sign = (seen, heard) => html`<span aria-hidden="true">${seen}</span><span class="visually-hidden">${heard}</span>`;

/** Returns the buttons that step through Table 5.1. Each line highlights its construction. @param {Figure} figure */
export function lineStepper(figure) {
  const say = words.anatomy.table;
  const { line } = figure.state.own;
  const go = (/** @type {number} */ to) => () => figure.gesture.choose('line', to);
  return html`<div class="stepper" role="group" aria-label=${say.label}>
    ${button(sign('‹', say.back), go(line - 1), { disabled: line === 0, title: say.back })}
    ${button(sign('›', say.on), go(line + 1), { disabled: line === TABLE_LINES, title: say.on })}
    <p role="status">${line === 0 ? say.begin : rich(lineText(figure.reading, line))}</p>
  </div>`;
}

/** Returns the slider of the time, which moves a robot along each arc, with its Play button. @param {Figure} figure */
export function timeControl({ player, gesture, reading, state }) {
  const { underway } = state.own;
  const { dt } = reading.config.command;
  const shown = words.anatomy.timeOf(fixed((underway / WHOLE) * dt, 2), fixed(dt, 2));
  return group(words.anatomy.time, html`<div class="underway">
    ${player.button('underway', words.play)}
    <div class="slider" part="slider" data-role="truth">
      <label for="underway"><bdi class="symbol notranslate" translate="no"><i>t</i></bdi>${words.anatomy.underway}</label>
      ${track({ id: 'underway', min: 0, max: WHOLE, step: 1, value: underway, text: shown, input: (at) => player.put('underway', at), commit: () => gesture.commit() })}
      <output class="value" for="underway">${shown}</output>
    </div>
  </div>`);
}
