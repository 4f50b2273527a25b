/**
 * Script of the page around the figures: buttons that set the state of a figure, terms that highlight a line in its picture,
 * and predictions.
 *
 * @module
 */

/** Element of any of the figures. */
type Figure = HTMLElement & Record<string, any>;

/** Whole state that each figure opened with. */
const openingStates: WeakMap<Element, Record<string, any>> = new WeakMap();

/** Returns the figure that an element of the page is about. */
const figureOf = (element: Element) => element.closest('article')?.querySelector('.stand') as Figure;

/**
 * Returns a figure to the state that it opened with, and then sets values in their order. The key of a value is a property of the element, or else a field
 * of its state. A preset has to be the first value, because it replaces the others.
 */
async function enterState(figure: Figure, values: Record<string, unknown>) {
  if (!openingStates.has(figure)) await new Promise((resolve) => figure.addEventListener('load', resolve, { once: true }));
  const openingState = openingStates.get(figure) ?? {};
  // The page's text describes the complete cloud of samples, so that all samples are shown at once instead of a growing cloud.
  const completeCloudFields = 'shown' in openingState ? { shown: openingState.samples, playing: false } : {};
  const { widget, version } = openingState;
  figure.setState({ ...openingState, ...completeCloudFields });
  for (const [key, value] of Object.entries(values)) {
    if (key in figure) figure[key] = value;
    else figure.setState({ widget, version, [key]: value });
  }
}

async function enterTriedState(button: HTMLElement) {
  const figure = figureOf(button);
  for (const triedButton of button.closest('article')?.querySelectorAll('[data-try]') ?? []) triedButton.removeAttribute('aria-current');
  await enterState(figure, JSON.parse(button.dataset.try ?? '{}'));
  button.setAttribute('aria-current', 'true');
  figure.addEventListener('input', () => button.removeAttribute('aria-current'), { once: true });
}

/** Highlights the line that a term names while the pointer or the focus is on the term. */
function highlightTerm({ type, target }: Event) {
  const term = target instanceof Element ? (target.closest('[data-line]') as HTMLElement | null) : null;
  if (!term) return;
  figureOf(term).highlight = /over|in$/.test(type) ? term.dataset.line : null;
}

/** Keeps each figure's picture in sight while the reader scrolls through the list of things to try, if the list is below the figure. */
function keepPicturesInSight() {
  const observer = new ResizeObserver((entries) => {
    for (const { target, borderBoxSize: [{ blockSize }] } of entries) {
      (target.parentElement as HTMLElement).style.setProperty('--below', `${blockSize}px`);
    }
  });
  for (const tryList of document.querySelectorAll('.try')) observer.observe(tryList);
}

/** Returns the number at a path of keys separated by dots; null if there is none. */
const findNumberAtPath = (stats: Record<string, any>, path: string): number | null => path.split('.').reduce((valueSoFar: any, key) => valueSoFar?.[key], stats) ?? null;

/**
 * Completes a form in which the reader bets on a number by a slider. `data-try` is the state of the figure that has the answer, and `data-answer`
 * the path of the answer in `stats`. `data-hides` names the overlay that shows the answer; it is hidden until the reader submits the bet.
 */
function prepareBet(form: HTMLFormElement) {
  const figure = figureOf(form);
  const { try: stateText = '{}', answer: answerPath = '', unit = '', hides: hiddenOverlay } = form.dataset;
  const state = JSON.parse(stateText);
  form.insertAdjacentHTML('beforeend', '<span class="value" aria-hidden="true"></span> <button disabled>Reveal</button><p role="status"></p>');
  const slider = form.querySelector('input') as HTMLInputElement;
  const [valueOutput, submitButton, answerOutput] = ['.value', 'button', '[role=status]'].map((selector) => form.querySelector(selector) as HTMLButtonElement);
  const [min, max] = [Number(slider.min), Number(slider.max)];
  const isPercent = unit === '%';
  const formatValue = (value: number) => `${isPercent ? value.toFixed(slider.valueAsNumber === value ? 0 : 1) + '\u00a0%' : value}`;
  const showValue = () => (slider.ariaValueText = valueOutput.textContent = formatValue(slider.valueAsNumber));

  // The bet can be submitted only after the slider has been moved.
  slider.addEventListener('input', () => {
    submitButton.disabled = false;
    showValue();
  });
  showValue();
  if (hiddenOverlay) {
    const overlays = state.overlays.filter((name: string) => name !== hiddenOverlay);
    form.addEventListener('focusin', () => void enterState(figure, { ...state, overlays }), { once: true });
  }
  form.addEventListener('submit', async (event) => {
    event.preventDefault();
    await enterState(figure, state);
    await figure.settled;
    const answerNumber = findNumberAtPath(figure.stats, answerPath);
    const actualValue = answerNumber === null ? null : isPercent ? 100 * answerNumber : answerNumber;
    form.style.setProperty('--truth', String(((actualValue ?? max) - min) / (max - min)));
    form.classList.add('revealed');
    answerOutput.textContent = `Your bet: ${formatValue(slider.valueAsNumber)}. The figure’s answer, ▲:\u00a0${actualValue === null ? 'never' : formatValue(actualValue)}.`;
    submitButton.textContent = 'Reveal again';
  });
}

document.addEventListener('load', ({ target }) => {
  const figure = target as Figure;
  if (figure.getState && !openingStates.has(figure)) openingStates.set(figure, figure.getState());
}, { capture: true });
document.addEventListener('click', ({ target }) => {
  const button = target instanceof Element ? target.closest('button[data-try]') : null;
  if (button) void enterTriedState(button as HTMLElement);
});
for (const type of ['pointerover', 'pointerout', 'focusin', 'focusout']) document.addEventListener(type, highlightTerm);
for (const form of document.querySelectorAll('form')) prepareBet(form);
keepPicturesInSight();
