/** The Banana Machine's controls: the command, the noise and the overlays. */

import { html, nothing } from 'lit';
import { cloudButtons, samplesSlider, settingCheckbox, settingRadios, settingSlider, settingSliders } from '../../figure/controls.ts';
import { words } from '../../messages/registry.ts';
import { formatMarkup, radioButton, group, toggle } from '../../ui/controls.ts';
import { formatEditable } from '../../ui/format.ts';
import { alphaName } from './view-model.ts';
import { COMMAND_SLIDERS, SAMPLE_COUNTS } from './settings.ts';
import type { BananaMachineElement as Figure } from './banana-machine.ts';

export function commandControls(figure: Figure) {
  return group(words.command, settingSliders(figure, COMMAND_SLIDERS));
}

export function modelControls(figure: Figure) {
  const { model, alphas, isolate } = figure.viewModel.config;
  const texts = words.banana;
  // The choice counts from 1. It may be larger than the number of α's, because it was made under the other model.
  const isolatedAlpha = Math.min(figure.state.elementState.isolateChoice, alphas.length);
  return group(texts.modelGroup, html`${settingRadios(figure, 'model', texts.models)} ${settingRadios(figure, 'noise', words.noises)}
    ${model === 'odometry' ? settingCheckbox(figure, 'reverseAware', texts.reverseAware) : nothing}
    ${toggle({
      label: texts.isolate,
      checked: isolate !== null,
      change: (on) => figure.gesture.decide({ isolate: on ? isolatedAlpha : null }),
    })}`);
}

/**
 * Indices of the α's that are always visible, by model: those that add noise to the distance and to the turn of a straight drive. The cloud is
 * a banana if the turn has much more.
 */
const VISIBLE_ALPHAS: Record<string, number[]> = { velocity: [0, 2], odometry: [1, 2] };

const isAlwaysVisible = (figure: Figure, index: number) => VISIBLE_ALPHAS[figure.viewModel.config.model].includes(index);

export const visibleAlphaControls = (figure: Figure) => alphaGroup(figure, (index) => isAlwaysVisible(figure, index), 'pair');

export const otherAlphaControls = (figure: Figure) => alphaGroup(figure, (index) => !isAlwaysVisible(figure, index), 'alphas');

export const growthControls = (figure: Figure) => group(words.samples, cloudButtons(figure), 'cloud');

export const samplesControl = (figure: Figure) => group(words.samples, samplesSlider(figure, SAMPLE_COUNTS));

/** Returns a group with the sliders of those α's whose indices `isIn` accepts. */
function alphaGroup(figure: Figure, isIn: (index: number) => boolean, name: string) {
  const { model, alphas } = figure.viewModel.config;
  return group(words.noise, [...alphas.keys()].filter(isIn).map((index) => alphaSlider(figure, index + 1, words.alphas[model as 'velocity' | 'odometry'][index])), name);
}

/** Returns the slider of an α, counted from 1. */
function alphaSlider(figure: Figure, alphaNumber: number, [name, effect]: string[]) {
  const { isolate } = figure.viewModel.config;
  const hasNoEffect = isolate !== null && isolate !== alphaNumber;
  const chooseAlpha = () => figure.gesture.decide({ isolate: alphaNumber, isolateChoice: alphaNumber });
  return settingSlider(figure, `alpha${alphaNumber}`, {
    name,
    effect: formatMarkup(effect),
    hasNoEffect,
    pickControl: isolate === null ? undefined : radioButton({ group: 'isolate', name: words.banana.only(alphaName(alphaNumber - 1)), checked: !hasNoEffect, choose: chooseAlpha }),
    show: (value) => (hasNoEffect ? words.banana.off(formatEditable(value, 3)) : formatEditable(value, 3)),
    input: (value) => {
      if (hasNoEffect) chooseAlpha();
      figure.settings.request(({ alphas }) => ({ alphas: alphas.with(alphaNumber - 1, value) }));
    },
  });
}
