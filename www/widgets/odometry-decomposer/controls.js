/** The Odometry Decomposer's controls: readings worth starting from, rules side by side, and sliders that can be played. */

import { html } from 'lit';
import { choices, cloudControls, slider, sliders } from '../../figure/controls.js';
import { words } from '../../messages/registry.js';
import { choice, rich } from '../../ui/controls.js';
import { fixed } from '../../ui/format.js';
import { figureTable } from '../../ui/readouts.js';
import { NOISE, SAMPLE_COUNTS } from './settings.js';

/** @typedef {import('./odometry-decomposer.js').OdometryDecomposerElement} Figure */

/** What each rule makes of the reading, the present one among them chosen by its name. @param {Figure} figure */
export function rulesTable(figure) {
  const { rules: names, table: say, settings } = words.decomposer;
  const { rules } = figure.reading;
  const present = figure.settings.told.rule;
  return html`<div class="rules" role="radiogroup" aria-label=${settings.rule.name}>
    ${figureTable({
      caption: html`<span class="visually-hidden">${rich(say.caption)}</span>`,
      columns: [say.rule, ...say.columns.map(rich)],
      rows: rules.map(({ rule, deviations, crossTrack, heading }) => [
        choice({ group: 'rule', label: names[rule], checked: rule === present, choose: () => figure.gesture.decide({ rule }) }),
        ...[...deviations, crossTrack, heading].map((value) => fixed(value, 3)),
      ]),
    })}
  </div>`;
}

/**
 * A slider that can be played; for who wants less motion it is only moved.
 *
 * @param {Figure} figure
 * @param {'phase' | 'drift'} key
 * @param {string} legend
 */
export function playable(figure, key, legend) {
  const { player } = figure;
  const { playTitles } = words.decomposer;
  return html`<fieldset class="playable ${key}">
    <legend class="visually-hidden">${legend}</legend>
    ${slider(figure, key, { input: (value) => player.put(key, value) })} ${player.button(key, playTitles[key])}
  </fieldset>`;
}

/** The noise, how that of the two rotations goes together, and the outcomes. @param {Figure} figure */
export function noiseControls(figure) {
  const { hinges, noiseParameters, noises } = words.decomposer;
  return html`<div class="controls" part="controls">
      <fieldset class="alphas">
        <legend class="visually-hidden">${noiseParameters}</legend>
        ${sliders(figure, NOISE)} ${choices(figure, 'noise', noises)}
      </fieldset>
      ${cloudControls(figure, SAMPLE_COUNTS)}
    </div>
    <p>${rich(hinges)}</p>`;
}
