/** Controls of the Alpha Calibrator: the leg that is shown, the model and its fit, and the noise of the reference. */

import { html, nothing } from 'lit';
import { editableSliderHtml, settingRadiosHtml, settingSliderHtml } from '../../figure/controls.ts';
import { words } from '../../messages/registry.ts';
import { buttonHtml, fieldsetHtml, radioGroupHtml } from '../../ui/controls.ts';
import { NO_VALUE, formatEditable, formatFixed, formatInteger } from '../../ui/format.ts';
import { readoutsHtml } from '../../ui/readouts.ts';
import { modelRuleOf, observedCount, settingsOfModelRule } from './settings.ts';
import type { AlphaCalibratorElement as Figure } from './alpha-calibrator.ts';

export function legControlsHtml(figure: Figure) {
  const { viewModel: { legs, worst }, chosen } = figure;
  const texts = words.calibrator.leg;
  // The button selects the leg after the selected one in the list of worst legs, or the first of the list.
  const nextLeg = worst[(worst.indexOf(figure.settings.elementState.leg) + 1) % Math.max(1, worst.length)];
  return html`${editableSliderHtml(figure, texts.name, { min: 1, max: legs.count, type: 'whole' }, {
      id: 'leg',
      name: texts.name,
      value: chosen + 1,
      min: 1,
      max: Math.max(2, legs.count),
      step: 1,
      formatValue: formatInteger,
      effect: undefined,
      role: 'truth',
      hasNoEffect: legs.count < 2,
      onInput: (legNumber) => figure.settings.requestChange({ leg: legNumber - 1 }),
      onCommit: () => figure.gesture.commit(),
    })}
    ${buttonHtml(texts.worst, () => figure.gesture.requestAndCommit({ leg: nextLeg }), { disabled: nextLeg === undefined })}`;
}

export function legReadoutsHtml({ viewModel: { legs }, chosen, predicted: leg }: Figure) {
  const texts = words.calibrator.leg;
  const endError = leg ? Math.hypot(leg.ended[0] - leg.read[0], leg.ended[1] - leg.read[1]) : NaN;
  return readoutsHtml([
    [texts.off, `${formatFixed(endError, 3)} m`],
    [texts.squared(String(observedCount(legs.residuals, chosen))), formatFixed(leg ? legs.squared[chosen] : NaN, 1)],
  ]);
}

export function modelControlsHtml(figure: Figure) {
  const { fit, settings: { model }, kinds, outliers } = words.calibrator;
  const formatDuration = (seconds: number) => (seconds > 0 ? `${formatEditable(seconds, 2)} s` : NO_VALUE);
  const chooseModel = (modelRule: import('./settings.ts').ModelRule) => figure.gesture.requestAndCommit(settingsOfModelRule(modelRule));
  return fieldsetHtml(fit, html`${radioGroupHtml(model.name, 'kind', kinds, modelRuleOf(figure.settings.requested as any), chooseModel)}
    ${settingRadiosHtml(figure, 'outliers', outliers)} ${settingSliderHtml(figure, 'duration', { formatValue: formatDuration })}`, 'fit');
}

/** Returns the controls of the noise of the reference. A sentence says what the simulated log is. */
export function referenceControlsHtml(figure: Figure) {
  const stdSliderHtml = (key: string, unit: string) =>
    settingSliderHtml(figure, key, { formatValue: (std: number) => (std > 0 ? `${formatEditable(std, 3)} ${unit}` : words.calibrator.estimated) });
  return html`${figure.log ? nothing : html`<p>${words.calibrator.own.simulated}</p>`}
    <div class="controls">${stdSliderHtml('positionStd', 'm')} ${stdSliderHtml('yawStd', 'rad')}</div>`;
}
