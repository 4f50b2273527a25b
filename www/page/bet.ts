/** Bet forms: the reader predicts a number by a slider or the shape of a cloud by a radio button, and the figure then reveals it. */

import { deviation } from 'd3-array';
import type { Figure } from '../page.ts';

/** Returns the number at a path of keys separated by dots; null if there is none. */
const findNumberAtPath = (stats: Record<string, any>, path: string): number | null => path.split('.').reduce((valueSoFar: any, key) => valueSoFar?.[key], stats) ?? null;

/**
 * Completes a form that has one slider. `enterState` puts the figure into the state of `data-try`. `data-answer` is the path of the answer in
 * `stats`. `data-hides` names the overlay that shows the answer; it is hidden until the reader submits the bet.
 */
export function prepareBet(form: HTMLFormElement, enterState: (values: Record<string, unknown>) => Promise<void>, figure: Figure) {
  const { try: stateText = '{}', answer: answerPath = '', unit = '', hides: hiddenOverlay } = form.dataset;
  form.insertAdjacentHTML('beforeend', '<span class="value" aria-hidden="true"></span> <button disabled>Reveal</button><p role="status"></p>');
  const slider = form.querySelector('input') as HTMLInputElement;
  const valueOutput = form.querySelector('.value') as HTMLElement;
  const submitButton = form.querySelector('button') as HTMLButtonElement;
  const answerOutput = form.querySelector('[role=status]') as HTMLElement;
  const [min, max] = [Number(slider.min), Number(slider.max)];
  const isPercent = unit === '%';
  const formatValue = (value: number) => `${isPercent ? value.toFixed(slider.valueAsNumber === value ? 0 : 1) + '\u00a0%' : value}`;
  const showValue = () => (slider.ariaValueText = valueOutput.textContent = formatValue(slider.valueAsNumber));

  // A bet is made by moving the slider.
  slider.addEventListener('input', () => {
    submitButton.disabled = false;
    showValue();
  });
  showValue();
  if (hiddenOverlay) {
    const { overlays, ...otherValues } = JSON.parse(stateText);
    form.addEventListener('focusin', () => void enterState({ ...otherValues, overlays: overlays.filter((name: string) => name !== hiddenOverlay) }), { once: true });
  }
  form.addEventListener('submit', async (event) => {
    event.preventDefault();
    await enterState(JSON.parse(stateText));
    await figure.settled;
    const answerNumber = findNumberAtPath(figure.stats, answerPath);
    const actualValue = answerNumber === null ? null : isPercent ? 100 * answerNumber : answerNumber;
    form.style.setProperty('--truth', String(((actualValue ?? max) - min) / (max - min)));
    form.classList.add('revealed');
    answerOutput.textContent = `Your bet: ${formatValue(slider.valueAsNumber)}. The figure’s answer, ▲:\u00a0${actualValue === null ? 'never' : formatValue(actualValue)}.`;
    submitButton.textContent = 'Reveal again';
  });
}

/** Smallest standard deviation that counts as a spread. */
const MIN_SPREAD = 1e-6;

/** Returns sentences on whether the expected shape is right, and on where the robots stop (`poses`: x, y, θ triples). */
function describeOutcome(poses: Float64Array, expectedShape: string) {
  const deviationAlong = (axis: number) => deviation(poses.filter((_, i) => i % 3 === axis)) ?? 0;
  const [positionStd, headingStd] = [Math.hypot(deviationAlong(0), deviationAlong(1)), deviationAlong(2)];
  const verdictText = expectedShape === (positionStd > MIN_SPREAD ? 'band' : 'point') ? 'Right. ' : 'Not what you expected. ';
  if (positionStd > MIN_SPREAD) return `${verdictText}The robots spread over a curved band, by ${positionStd.toFixed(2)}\u00a0m (1σ), their headings by ${headingStd.toFixed(2)}\u00a0rad.`;
  if (headingStd > MIN_SPREAD) return `${verdictText}Every robot stops at the same point. Only the headings differ, by ${headingStd.toFixed(2)}\u00a0rad (1σ).`;
  return `${verdictText}Every robot stops at the same point, with the same heading. There is no cloud.`;
}

/** Prepares a form with radio buttons for the state of the figure (`case`) and for the expected shape of the cloud (`shape`). */
export function prepareShapeBet(form: HTMLFormElement, enterState: (values: Record<string, unknown>) => Promise<void>, figure: Figure) {
  const answerOutput = form.querySelector('[role=status]') as HTMLElement;
  form.addEventListener('change', () => (answerOutput.textContent = ''));
  form.addEventListener('submit', async (event) => {
    event.preventDefault();
    const choices = new FormData(form);
    await enterState(JSON.parse(String(choices.get('case'))));
    form.classList.add('revealed');
    answerOutput.textContent = describeOutcome(figure.poses, String(choices.get('shape')));
  });
}
