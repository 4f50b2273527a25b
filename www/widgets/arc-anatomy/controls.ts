/** Controls of Arc Anatomy: the command, the noise, the heat map, the time along the arcs, and the lines of Table 5.1. */

import { html, nothing } from 'lit';
import { settingCheckbox, settingRadios, settingSliders } from '../../figure/controls.ts';
import { swatchHtml } from '../../figure/overlays.ts';
import { words } from '../../messages/registry.ts';
import { button, group, formatMarkup } from '../../ui/controls.ts';
import { fixed } from '../../ui/format.ts';
import { track } from '../../ui/slider.ts';
import { lineText } from './readouts.ts';
import { CONTOUR_STYLES, ALPHA_SLIDERS, COMMAND_SLIDERS, TABLE_LINES, UNDERWAY_AT_END } from './settings.ts';
import type { ArcAnatomyElement as Figure } from './arc-anatomy.ts';

export const commandControls = (figure: Figure) => group(words.command, settingSliders(figure, COMMAND_SLIDERS));

export const noiseControls = (figure: Figure) =>
  group(words.noise, html`${settingRadios(figure, 'noise', words.noises)} ${settingSliders(figure, ALPHA_SLIDERS)}`, 'alphas');

/** Returns the controls of the likelihood: the sign of the radius, and the heat map with the names of its contours. */
export function likelihoodControls(figure: Figure) {
  const { likelihood, maps, printed } = words.anatomy;
  const { map } = figure.settings.requested;
  const contourEntry = (name: 'prob' | 'density') => html`<span>${swatchHtml(CONTOUR_STYLES[name])} ${maps[name]}</span>`;
  return group(likelihood, html`${settingCheckbox(figure, 'printed', formatMarkup(printed))} ${settingRadios(figure, 'map', maps)}
    ${map === 'none' ? nothing : html`<p class="legend">${contourEntry('prob')} ${contourEntry('density')}</p>`}`);
}

/** Returns an icon, with a text for screen readers. */
const iconWithText = (visibleSymbol: string, spokenText: string) => html`<span aria-hidden="true">${visibleSymbol}</span><span class="visually-hidden">${spokenText}</span>`;

export function lineStepper(figure: Figure) {
  const texts = words.anatomy.table;
  const { line } = figure.state.elementState;
  const chooseLine = (to: number) => () => figure.gesture.choose('line', to);
  return html`<div class="stepper" role="group" aria-label=${texts.label}>
    ${button(iconWithText('‹', texts.back), chooseLine(line - 1), { disabled: line === 0, title: texts.back })}
    ${button(iconWithText('›', texts.on), chooseLine(line + 1), { disabled: line === TABLE_LINES, title: texts.on })}
    <p role="status">${line === 0 ? texts.begin : formatMarkup(lineText(figure.viewModel, line))}</p>
  </div>`;
}

export function timeControl({ player, gesture, viewModel, state }: Figure) {
  const { underway } = state.elementState;
  const { dt } = viewModel.config.command;
  const timeText = words.anatomy.timeOf(fixed((underway / UNDERWAY_AT_END) * dt, 2), fixed(dt, 2));
  return group(words.anatomy.time, html`<div class="underway">
    ${player.button('underway', words.play)}
    <div class="slider" part="slider" data-role="truth">
      <label for="underway"><bdi class="symbol notranslate" translate="no"><i>t</i></bdi>${words.anatomy.underway}</label>
      ${track({ id: 'underway', min: 0, max: UNDERWAY_AT_END, step: 1, value: underway, text: timeText, input: (at) => player.setByUser('underway', at), commit: () => gesture.commit() })}
      <output class="value" for="underway">${timeText}</output>
    </div>
  </div>`);
}
