/** Bet on a number: the user predicts it, and the figure reveals it. */

import type { Figure } from '../page.ts';

/** Returns the number at a path of keys separated by dots; null if there is none. */
const numberAtPath = (stats: Record<string, any>, path: string): number | null => path.split('.').reduce((part: any, key) => part?.[key], stats) ?? null;

/**
 * Prepares a form with one slider. `enter` puts the figure into the state of `data-try`. `data-answer` is the path of the answer in `stats`,
 * and `data-hides` the overlay that shows it, which is hidden while the user bets.
 */
export function prepareBet(form: HTMLFormElement, enter: (values: Record<string, unknown>) => Promise<void>, figure: Figure) {
  const { try: values = '{}', answer = '', unit = '', hides } = form.dataset;
  const slider = form.querySelector('input') as HTMLInputElement;
  const valueOutput = form.querySelector('.value') as HTMLElement;
  const submitButton = form.querySelector('button') as HTMLButtonElement;
  const answerOutput = form.querySelector('[role=status]') as HTMLElement;
  const [min, max] = [Number(slider.min), Number(slider.max)];
  const isShare = unit === '%';
  const print = (value: number) => `${isShare ? value.toFixed(slider.valueAsNumber === value ? 0 : 1) + '\u00a0%' : value}`;
  const showValue = () => (slider.ariaValueText = valueOutput.textContent = print(slider.valueAsNumber));

  slider.addEventListener('input', showValue);
  showValue();
  if (hides) {
    const { overlays, ...otherValues } = JSON.parse(values);
    form.addEventListener('focusin', () => void enter({ ...otherValues, overlays: overlays.filter((name: string) => name !== hides) }), { once: true });
  }
  form.addEventListener('submit', async (event) => {
    event.preventDefault();
    await enter(JSON.parse(values));
    await figure.settled;
    const number = numberAtPath(figure.stats, answer);
    const actualValue = number === null ? null : isShare ? 100 * number : number;
    form.style.setProperty('--bet', String((slider.valueAsNumber - min) / (max - min)));
    form.style.setProperty('--truth', String(((actualValue ?? max) - min) / (max - min)));
    form.classList.add('revealed');
    answerOutput.textContent = `Your bet: ${print(slider.valueAsNumber)}. The figure’s answer, ▲:\u00a0${actualValue === null ? 'never' : print(actualValue)}.`;
    submitButton.textContent = 'Reveal again';
  });
}
