/** The Odometry Decomposer's controls: the table that compares the noise models, animated sliders, and the distribution of the noise. */

import { html } from 'lit';
import { settingRadios, cloudControls, settingSlider, settingSliders } from '../../figure/controls.ts';
import { words } from '../../messages/registry.ts';
import { radioButton, group, formatMarkup } from '../../ui/controls.ts';
import { fixed } from '../../ui/format.ts';
import { figureTable } from '../../ui/readouts.ts';
import { NOISE_SLIDERS, SAMPLE_COUNTS } from './settings.ts';
import type { OdometryDecomposerElement as Figure } from './odometry-decomposer.ts';

/** Returns the table of standard deviations by noise model. Values that differ from Table 5.6 are bold. */
export function noiseModelTable(figure: Figure) {
  const { rules: names, table: texts, settings } = words.decomposer;
  const { rules } = figure.viewModel;
  const currentRule = figure.settings.requested.rule;
  const printedRows = rules.map(({ deviations, crossTrack, heading }) => [...deviations, crossTrack, heading].map((value) => fixed(value, 3)));
  return html`<div class="rules" role="radiogroup" aria-label=${settings.rule.name}>
    ${figureTable({
      caption: formatMarkup(texts.caption),
      columns: [settings.rule.name, ...texts.columns.map(formatMarkup)],
      rows: rules.map(({ rule }, i) => [
        radioButton({ group: 'rule', label: names[rule], checked: rule === currentRule, choose: () => figure.gesture.decide({ rule }) }),
        ...printedRows[i].map((cell, column) => (cell === printedRows[0][column] ? cell : html`<strong>${cell}</strong>`)),
      ]),
    })}
  </div>`;
}

/** Returns a slider, with a play button unless the user prefers reduced motion. */
export function playableSlider(figure: Figure, key: 'phase' | 'drift', legend: string) {
  const { player } = figure;
  const { plays } = words.decomposer;
  return html`<fieldset class="playable with-button ${key}">
    <legend class="visually-hidden">${legend}</legend>
    ${settingSlider(figure, key, { input: (value) => player.setByUser(key, value) })} ${player.button(key, plays[key])}
  </fieldset>`;
}

export function noiseControls(figure: Figure) {
  return html`<div class="controls">
      ${group(words.noise, html`${settingSliders(figure, NOISE_SLIDERS)} ${settingRadios(figure, 'noise', words.noises)}`, 'alphas')}
      ${cloudControls(figure, SAMPLE_COUNTS)}
    </div>
    <p>${formatMarkup(words.decomposer.hinges)}</p>`;
}
