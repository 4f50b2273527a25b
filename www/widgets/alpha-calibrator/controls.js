/** Controls of the Alpha Calibrator: the leg that is shown, the model, and the length of legs. */

import { html } from 'lit';
import { check, choices, slider } from '../../figure/controls.js';
import { words } from '../../messages/registry.js';
import { button, group, radioGroup } from '../../ui/controls.js';
import { NOTHING, counted, fixed, numberIn, percent, typed } from '../../ui/format.js';
import { readoutList } from '../../ui/readouts.js';
import { sliderRow } from '../../ui/slider.js';
import { kindOf, settingsFor } from './settings.js';

/** @typedef {import('./alpha-calibrator.js').AlphaCalibratorElement} Figure */

/** Slider of the leg that is shown. @param {Figure} figure */
export function legControls(figure) {
  const { reading: { legs, stats }, chosen } = figure;
  const say = words.calibrator.leg;
  const { worst } = stats.doubts;
  // The leg that is shown may be one of the worst.
  const next = worst[(worst.indexOf(figure.state.own.leg) + 1) % Math.max(1, worst.length)];
  const take = (/** @type {number} */ number) => figure.look(number - 1);
  return html`<fieldset class="leg">
      <legend class="visually-hidden">${say.name}</legend>
      ${sliderRow({
        id: 'leg',
        name: say.name,
        value: chosen + 1,
        min: 1,
        max: Math.max(2, legs.count),
        step: 1,
        show: counted,
        effect: undefined,
        role: 'truth',
        off: legs.count < 2,
        keys: 'numeric',
        input: take,
        commit: () => figure.gesture.commit(),
        type: (text) => {
          const number = numberIn(text, '', true);
          if (Number.isInteger(number) && number >= 1 && number <= legs.count) {
            take(number);
            figure.gesture.commit();
            return counted(number);
          }
          figure.typing.refuse('leg', words.refused(say.name, Number.isNaN(number) ? `"${text}"` : text.trim(), '1', counted(legs.count), true));
        },
        refusal: figure.typing.refusalOf('leg'),
        forget: () => figure.typing.forget(),
      })}
    </fieldset>
    ${button(say.worst, () => figure.choose(next), { disabled: next === undefined, title: say.worstTitle })}`;
}

/** Readouts of the error of the leg that is shown. @param {Figure} figure */
export function legReadouts({ reading: { legs, stats }, chosen, predicted: leg }) {
  const say = words.calibrator.leg;
  const off = leg ? Math.hypot(leg.ended[0] - leg.read[0], leg.ended[1] - leg.read[1]) : NaN;
  const told = legs.residuals.subarray(3 * chosen, 3 * chosen + 3).filter((residual) => !Number.isNaN(residual)).length;
  const [squared, bad] = leg ? [legs.squaredError[chosen], legs.bad[chosen]] : [NaN, NaN];
  return readoutList([
    [say.off, `${fixed(off, 3)} m`],
    [say.squared(String(told)), fixed(squared, 1)],
    // Without a fitted share of bad legs, no leg has a probability.
    [say.bad, percent(stats.outliers === null ? NaN : bad)],
  ]);
}

/** The model with its rule, the robust fit, and legs of a duration. @param {Figure} figure */
export function modelControls(figure) {
  const { fit, settings: { model }, kinds, robust, noises } = words.calibrator;
  const show = (/** @type {number} */ seconds) => (seconds > 0 ? `${typed(seconds, 2)} s` : NOTHING);
  const choose = (/** @type {import('./settings.js').Kind} */ kind) => figure.gesture.decide(settingsFor(kind));
  return group(fit, html`${radioGroup(model.name, 'kind', kinds, kindOf(/** @type {any} */ (figure.settings.told)), choose)}
    ${choices(figure, 'noise', noises)} ${check(figure, 'robust', robust)} ${slider(figure, 'duration', { show })}`, 'fit');
}

/** Sliders of the length of a leg. @param {Figure} figure */
export function legLengths(figure) {
  const off = figure.settings.told.duration > 0;
  return group(words.calibrator.leg.group, html`<div class="controls">${slider(figure, 'distance', { off })} ${slider(figure, 'angle', { off })}</div>`);
}

/** Sliders of the noise of the reference. @param {Figure} figure */
export const deviations = (figure) => html`<div class="controls">${slider(figure, 'positionDeviation')} ${slider(figure, 'headingDeviation')}</div>`;
