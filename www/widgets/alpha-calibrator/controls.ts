/** Controls of the Alpha Calibrator: the leg that is shown, the model and its fit, and the noise of the reference. */

import { html, nothing } from 'lit';
import { settingRadiosHtml, settingSliderHtml } from '../../figure/controls.ts';
import { words } from '../../messages/registry.ts';
import { buttonHtml, fieldsetHtml, radioGroupHtml } from '../../ui/controls.ts';
import { NO_VALUE, formatEditable, formatFixed, formatInteger } from '../../ui/format.ts';
import { readoutsHtml } from '../../ui/readouts.ts';
import { sliderRowHtml } from '../../ui/slider.ts';
import { modelRuleOf, countObservedResiduals, settingsOfModelRule } from './settings.ts';
import type { AlphaCalibratorElement as Figure } from './alpha-calibrator.ts';

export function legControlsHtml(figure: Figure) {
  const { viewModel: { legs, worstLegs }, chosenLegIndex } = figure;
  const texts = words.calibrator.leg;
  // The button selects the next leg in the list of the worst legs. After the last leg, or if the selected leg is not in the list, it selects the first.
  const nextWorstLeg = worstLegs[(worstLegs.indexOf(figure.settings.elementState.leg) + 1) % Math.max(1, worstLegs.length)];
  return html`${sliderRowHtml({
      id: 'leg',
      allowedNumbers: { min: 1, max: legs.count, type: 'whole' },
      name: texts.name,
      value: chosenLegIndex + 1,
      min: 1,
      max: Math.max(2, legs.count),
      step: 1,
      formatValue: formatInteger,
      effect: undefined,
      colourRole: 'truth',
      hasNoEffect: legs.count < 2,
      onInput: (legNumber) => figure.settings.requestChange({ leg: legNumber - 1 }),
      onCommit: () => figure.gesture.commitChange(),
    })}
    ${buttonHtml(texts.nextWorstLegLabel, () => figure.gesture.requestAndCommit({ leg: nextWorstLeg }), { disabled: nextWorstLeg === undefined })}`;
}

export function legReadoutsHtml({ viewModel: { legs }, chosenLegIndex, predictedLeg: leg }: Figure) {
  const texts = words.calibrator.leg;
  const endError = leg ? Math.hypot(leg.ended[0] - leg.read[0], leg.ended[1] - leg.read[1]) : NaN;
  return readoutsHtml([
    [texts.endErrorLabel, `${formatFixed(endError, 3)} m`],
    [texts.squaredDistanceLabel(String(countObservedResiduals(legs.residuals, chosenLegIndex))), formatFixed(leg ? legs.squared[chosenLegIndex] : NaN, 1)],
  ]);
}

export function modelControlsHtml(figure: Figure) {
  const { modelAndFitTitle, settings: { model }, modelRuleNames, outlierTreatments } = words.calibrator;
  const formatDuration = (seconds: number) => (seconds > 0 ? `${formatEditable(seconds, 2)} s` : NO_VALUE);
  const chooseModel = (modelRule: import('./settings.ts').ModelRule) => figure.gesture.requestAndCommit(settingsOfModelRule(modelRule));
  return fieldsetHtml(modelAndFitTitle, html`${radioGroupHtml(model.name, 'kind', modelRuleNames, modelRuleOf(figure.settings.requestedValues as any), chooseModel)}
    ${settingRadiosHtml(figure, 'outliers', outlierTreatments)} ${settingSliderHtml(figure, 'duration', { formatValue: formatDuration })}`, 'fit');
}

/** Returns the controls for the noise of the reference; before them, a note on a simulated log. */
export function referenceControlsHtml(figure: Figure) {
  const stdSliderHtml = (stdSettingKey: string, unit: string) =>
    settingSliderHtml(figure, stdSettingKey, { formatValue: (std: number) => (std > 0 ? `${formatEditable(std, 3)} ${unit}` : words.calibrator.estimatedLabel) });
  return html`${figure.log ? nothing : html`<p>${words.calibrator.logControls.simulatedLogNote}</p>`}
    <div class="controls">${stdSliderHtml('positionStd', 'm')} ${stdSliderHtml('yawStd', 'rad')}</div>`;
}
