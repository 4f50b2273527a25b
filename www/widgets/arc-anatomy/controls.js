/** Arc Anatomy's controls: where it begins, the command, the noise, what is drawn, and the lines of the table. */

import { html } from 'lit';
import { check, choices, sliders } from '../../figure/controls.js';
import { words } from '../../messages/registry.js';
import { button, longest, rich, toggle } from '../../ui/controls.js';
import { lineText } from './readouts.js';
import { ALPHAS, COMMAND, LINES, PRESETS, presetIn, presetNamed } from './settings.js';

/** @typedef {import('./arc-anatomy.js').ArcAnatomyElement} Figure */

/** @param {Figure} figure */
export function presetButtons(figure) {
  const say = words.anatomy;
  const present = presetIn(/** @type {any} */ (figure.settings.told));
  const buttons = PRESETS.map(({ name }) =>
    button(say.presets[/** @type {keyof typeof say.presets} */ (name)], () => figure.gesture.decide(presetNamed(name)), {
      pressed: name === present,
    }),
  );
  return html`<div class="buttons" role="group" aria-label=${say.presetsLabel}>${buttons}</div>`;
}

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

/** The way through Table 5.1: each line lights what it constructs. @param {Figure} figure */
export function lineStepper(figure) {
  const say = words.anatomy.table;
  const { line } = figure.state.own;
  const go = (/** @type {number} */ to) => () => figure.gesture.choose('line', to);
  const texts = Array.from({ length: LINES }, (_, i) => lineText(figure.reading, i + 1));
  return html`<div class="stepper" role="group" aria-label=${say.label}>
    ${button('‹', go(line - 1), { disabled: line === 0, title: say.back })}
    ${button('›', go(line + 1), { disabled: line === LINES, title: say.on })}
    <p class="roomy" data-room=${longest(texts).replaceAll('*', '')} role="status"><span>${line === 0 ? say.begin : rich(texts[line - 1])}</span></p>
  </div>`;
}
