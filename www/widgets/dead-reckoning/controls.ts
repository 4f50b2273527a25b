/** Dead Reckoning's controls: the recursion, the path, its noise, and the samples. */

import { html } from 'lit';
import { settingRadios, cloudControls, settingSlider, settingSliders } from '../../figure/controls.ts';
import { words } from '../../messages/registry.ts';
import { group } from '../../ui/controls.ts';
import { fixed } from '../../ui/format.ts';
import { COMMAND_SLIDERS, NOISE_SLIDERS, SAMPLE_COUNTS } from './settings.ts';
import type { DeadReckoningElement as Figure } from './dead-reckoning.ts';

export function pathControls(figure: Figure) {
  return html`<div class="controls" part="controls">
    ${settingSlider(figure, 'headingNoise')} ${settingSlider(figure, 'steps', { input: (steps) => figure.settings.request((requested) => settingsForSteps(requested, steps)) })}
  </div>`;
}

/** Returns the settings for the same path in another number of steps, with the selected step at the same point of the path. */
function settingsForSteps({ command, steps: previousSteps, step }: Record<string, any>, steps: number) {
  return { steps, step: Math.max(1, Math.round((step * steps) / previousSteps)), command: { ...command, dt: (command.dt * previousSteps) / steps } };
}

export function moreControls(figure: Figure) {
  const { steps, step, command: { dt } } = figure.settings.requested;
  const { walked, per } = words.reckoning;
  const drivenTimeText = walked(fixed(step * dt, 2), fixed(steps * dt, 2));
  return html`<div class="controls">
    ${group(words.command, html`${settingSliders(figure, COMMAND_SLIDERS)}
      ${settingSlider(figure, 'step', { max: Math.max(2, steps), maxEntered: steps, hasNoEffect: steps === 1, effect: drivenTimeText })}`)}
    ${group(words.noise, html`${settingSliders(figure, NOISE_SLIDERS)} ${settingRadios(figure, 'per', per)}`)}
    ${cloudControls(figure, SAMPLE_COUNTS)}
  </div>`;
}
