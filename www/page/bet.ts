/** Bet form: the reader predicts a number by a slider, and the figure then reveals the number. */

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
