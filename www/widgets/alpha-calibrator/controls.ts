/** Controls of the Alpha Calibrator: the leg that is shown, the model, and the length of legs. */

import { html } from 'lit';
import { settingRadios, editableSlider, settingSlider } from '../../figure/controls.ts';
import { words } from '../../messages/registry.ts';
import { button, group, radioGroup } from '../../ui/controls.ts';
import { NO_VALUE, integer, fixed, formatEditable } from '../../ui/format.ts';
import { readoutList } from '../../ui/readouts.ts';
import { observedCount } from './view-model.ts';
import { modelRuleOf, settingsFor } from './settings.ts';
import type { AlphaCalibratorElement as Figure } from './alpha-calibrator.ts';

export function legControls(figure: Figure) {
  const { viewModel: { legs, worst }, chosen } = figure;
  const texts = words.calibrator.leg;
  // The button selects the leg after the selected one in the list of worst legs, or the first of the list.
  const nextLeg = worst[(worst.indexOf(figure.state.elementState.leg) + 1) % Math.max(1, worst.length)];
  return html`<fieldset class="leg">
      <legend class="visually-hidden">${texts.name}</legend>
      ${editableSlider(figure, texts.name, { min: 1, max: legs.count, type: 'whole' }, {
        id: 'leg',
        name: texts.name,
        value: chosen + 1,
        min: 1,
        max: Math.max(2, legs.count),
        step: 1,
        show: integer,
        effect: undefined,
        role: 'truth',
        hasNoEffect: legs.count < 2,
        input: (number) => figure.settings.request({ leg: number - 1 }),
        commit: () => figure.gesture.commit(),
      })}
    </fieldset>
    ${button(texts.worst, () => figure.gesture.decide({ leg: nextLeg }), { disabled: nextLeg === undefined })}`;
}

export function legReadouts({ viewModel: { legs }, chosen, predicted: leg }: Figure) {
  const texts = words.calibrator.leg;
  const off = leg ? Math.hypot(leg.ended[0] - leg.read[0], leg.ended[1] - leg.read[1]) : NaN;
  return readoutList([
    [texts.off, `${fixed(off, 3)} m`],
    [texts.squared(String(observedCount(legs.residuals, chosen))), fixed(leg ? legs.squared[chosen] : NaN, 1)],
    [words.calibrator.overlays.outlier, leg ? texts.isOutlier[legs.outliers[chosen] > 0 ? 'yes' : 'no'] : NO_VALUE],
  ]);
}

export function modelControls(figure: Figure) {
  const { fit, settings: { model }, kinds, outliers } = words.calibrator;
  const formatDuration = (seconds: number) => (seconds > 0 ? `${formatEditable(seconds, 2)} s` : NO_VALUE);
  const chooseModel = (kind: import('./settings.ts').ModelRule) => figure.gesture.decide(settingsFor(kind));
  return group(fit, html`${radioGroup(model.name, 'kind', kinds, modelRuleOf(figure.settings.requested as any), chooseModel)}
    ${settingRadios(figure, 'outliers', outliers)} ${settingSlider(figure, 'duration', { show: formatDuration })}`, 'fit');
}

export function predictionControls(figure: Figure) {
  return group(words.calibrator.prediction, html`${settingRadios(figure, 'noise', words.noises)} ${settingSlider(figure, 'inflation')}`, 'fit');
}

export function legLengthControls(figure: Figure) {
  const off = figure.settings.requested.duration > 0;
  return group(words.calibrator.leg.group, html`<div class="controls">${settingSlider(figure, 'distance', { hasNoEffect: off })} ${settingSlider(figure, 'angle', { hasNoEffect: off })}</div>`);
}

export function referenceNoiseControls(figure: Figure) {
  const stdSlider = (key: string, unit: string) =>
    settingSlider(figure, key, { show: (std: number) => (std > 0 ? `${formatEditable(std, 3)} ${unit}` : words.calibrator.estimated) });
  return html`<div class="controls">${stdSlider('positionStd', 'm')} ${stdSlider('yawStd', 'rad')}</div>`;
}
