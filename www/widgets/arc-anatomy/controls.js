/** Arc Anatomy's controls: where it begins, the command, the noise, what is drawn, and the lines of the table. */

import { html } from 'lit';
import { check, choices, sliders } from '../../figure/controls.js';
import { words } from '../../messages/registry.js';
import { button, rich, toggle } from '../../ui/controls.js';
import { fixed } from '../../ui/format.js';
import { track } from '../../ui/slider.js';
import { lineText } from './readouts.js';
import { ALPHAS, COMMAND, LINES, WHOLE } from './settings.js';

/** @typedef {import('./arc-anatomy.js').ArcAnatomyElement} Figure */

/** @param {Figure} figure */
export function printedCheck(figure) {
  return html`<fieldset class="as-printed">
    <legend class="visually-hidden">${words.anatomy.table.label}</legend>
    ${check(figure, 'printed', rich(words.anatomy.printed))}
  </fieldset>`;
}

/** @param {Figure} figure */
export function commandControls(figure) {
  return html`<fieldset>
    <legend class="visually-hidden">${words.command}</legend>
    ${sliders(figure, COMMAND)}
  </fieldset>`;
}

/** @param {Figure} figure */
export function alphaControls(figure) {
  const say = words.anatomy;
  return html`<fieldset class="alphas">
    <legend class="visually-hidden">${say.noiseLabel}</legend>
    ${choices(figure, 'noise', say.noises)} ${sliders(figure, ALPHAS)}
  </fieldset>`;
}

/** What is drawn besides the arcs. @param {Figure} figure */
export function drawnControls(figure) {
  const say = words.anatomy;
  return html`<fieldset class="drawn">
    <legend class="visually-hidden">${say.drawn}</legend>
    ${choices(figure, 'map', say.maps)}
    ${toggle({
      label: rich(say.twist),
      checked: figure.state.own.twist === 'shown',
      change: (on) => figure.gesture.choose('twist', on ? 'shown' : 'hidden'),
    })}
  </fieldset>`;
}

/**
 * A sign for the eye, words for the ear.
 *
 * @param {string} seen
 * @param {string} heard
 */
const sign = (seen, heard) => html`<span aria-hidden="true">${seen}</span><span class="visually-hidden">${heard}</span>`;

/** The way through Table 5.1: each line lights what it constructs. @param {Figure} figure */
export function lineStepper(figure) {
  const say = words.anatomy.table;
  const { line } = figure.state.own;
  const go = (/** @type {number} */ to) => () => figure.gesture.choose('line', to);
  return html`<div class="stepper" role="group" aria-label=${say.label}>
    ${button(sign('‹', say.back), go(line - 1), { disabled: line === 0, title: say.back })}
    ${button(sign('›', say.on), go(line + 1), { disabled: line === LINES, title: say.on })}
    <p role="status">${line === 0 ? say.begin : rich(lineText(figure.reading, line))}</p>
  </div>`;
}

/** The robot underway: along the arcs by itself, or where the reader puts it. @param {Figure} figure */
export function underwayControl({ player, gesture, reading, state }) {
  const { underway } = state.own;
  const shown = `${fixed((underway / WHOLE) * reading.config.command.dt, 2)} s`;
  return html`<div class="underway">
    ${player.button('underway')}
    <label for="underway">${words.anatomy.underway}</label>
    ${track({ id: 'underway', min: 0, max: WHOLE, step: 1, value: underway, text: shown, input: (at) => player.put('underway', at), commit: () => gesture.commit() })}
    <output for="underway">${shown}</output>
  </div>`;
}
