/** Bet on a number: the reader predicts it, and the figure reveals it. */

import type { Figure } from '../page.ts';

/** Returns the number at a path of keys with dots between them; null for none. */
const answerIn = (stats: Record<string, any>, path: string): number | null => path.split('.').reduce((part: any, key) => part?.[key], stats) ?? null;

/** Prepares a form with one slider. `enter` puts the figure into the state of `data-try`. `data-answer` is the path of the answer in `stats`. */
export function prepareBet(form: HTMLFormElement, enter: (values: Record<string, unknown>) => Promise<void>, figure: Figure) {
  const { try: values = '{}', answer = '', unit = '' } = form.dataset;
  const slider = form.querySelector('input') as HTMLInputElement;
  const shown = form.querySelector('.value') as HTMLElement;
  const button = form.querySelector('button') as HTMLButtonElement;
  const answered = form.querySelector('[role=status]') as HTMLElement;
  const [min, max] = [Number(slider.min), Number(slider.max)];
  const isShare = unit === '%';
  const text = (value: number) => `${isShare ? value.toFixed(slider.valueAsNumber === value ? 0 : 1) + '\u00a0%' : value}`;
  const show = () => (slider.ariaValueText = shown.textContent = text(slider.valueAsNumber));

  slider.addEventListener('input', show);
  show();
  form.addEventListener('submit', async (event) => {
    event.preventDefault();
    await enter(JSON.parse(values));
    await figure.settled;
    const number = answerIn(figure.stats, answer);
    const truth = number === null ? null : isShare ? 100 * number : number;
    form.style.setProperty('--bet', String((slider.valueAsNumber - min) / (max - min)));
    form.style.setProperty('--truth', String(((truth ?? max) - min) / (max - min)));
    form.classList.add('revealed');
    answered.textContent = `Your bet: ${text(slider.valueAsNumber)}. The figure:\u00a0${truth === null ? 'never' : text(truth)}.`;
    button.textContent = 'Reveal again';
  });
}
