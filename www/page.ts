/**
 * Script of the page around the figures: buttons that set the state of a figure, terms that highlight a line in its picture,
 * and predictions.
 *
 * @module
 */

/** Custom element of a figure. */
type Figure = HTMLElement & Record<string, any>;

/** Initial states of the figures, as `getState` returned them. */
const openingStates: WeakMap<Element, Record<string, any>> = new WeakMap();

/** Returns the figure of the article that contains an element. */
const figureOf = (pageElement: Element) => pageElement.closest('article')?.querySelector('.stand') as Figure;

/**
 * Restores the initial state of a figure, and then sets values in their order. The key of a value is a property of the element, or else a
 * field of its state. A preset has to be the first value, because it replaces the others.
 */
async function enterState(figure: Figure, values: Record<string, unknown>) {
  if (!openingStates.has(figure)) await new Promise((resolve) => figure.addEventListener('load', resolve, { once: true }));
  const openingState = openingStates.get(figure) ?? {};
  // All samples are shown at once, because the text of the page describes the complete cloud.
  const completeCloudFields = 'shown' in openingState ? { shown: openingState.samples, playing: false } : {};
  const { widget, version } = openingState;
  figure.setState({ ...openingState, ...completeCloudFields });
  for (const [settingKey, settingValue] of Object.entries(values)) {
    if (settingKey in figure) figure[settingKey] = settingValue;
    else figure.setState({ widget, version, [settingKey]: settingValue });
  }
}

async function enterTriedState(tryButton: HTMLElement) {
  const figure = figureOf(tryButton);
  for (const triedButton of tryButton.closest('article')?.querySelectorAll('[data-try]') ?? []) triedButton.removeAttribute('aria-current');
  await enterState(figure, JSON.parse(tryButton.dataset.try ?? '{}'));
  tryButton.setAttribute('aria-current', 'true');
  figure.addEventListener('input', () => tryButton.removeAttribute('aria-current'), { once: true });
}

/** Highlights the line that a term names while the pointer or the focus is on the term. */
function highlightTerm({ type, target }: Event) {
  const term = target instanceof Element ? (target.closest('[data-line]') as HTMLElement | null) : null;
  if (!term) return;
  figureOf(term).highlight = /over|in$/.test(type) ? term.dataset.line : null;
}

/** Keeps each figure's picture in sight while the reader scrolls through the list of things to try, if the list is below the figure. */
function keepPicturesInSight() {
  const listSizeObserver = new ResizeObserver((listSizeEntries) => {
    for (const { target, borderBoxSize: [{ blockSize }] } of listSizeEntries) {
      (target.parentElement as HTMLElement).style.setProperty('--below', `${blockSize}px`);
    }
  });
  for (const tryList of document.querySelectorAll('.try')) listSizeObserver.observe(tryList);
}

/** Returns the number at a path of keys separated by dots; null if there is none. */
const findNumberAtPath = (stats: Record<string, any>, keyPath: string): number | null => keyPath.split('.').reduce((valueSoFar: any, key) => valueSoFar?.[key], stats) ?? null;

/**
 * Completes a form in which the reader bets on a number by a slider. `data-try` is the state of the figure that has the answer, and `data-answer`
 * the path of the answer in `stats`. `data-hides` names the overlay that shows the answer; it is hidden until the reader submits the bet.
 */
function prepareBet(betForm: HTMLFormElement) {
  const figure = figureOf(betForm);
  const { try: stateText = '{}', answer: answerPath = '', unit = '', hides: hiddenOverlay } = betForm.dataset;
  const answerState = JSON.parse(stateText);
  betForm.insertAdjacentHTML('beforeend', '<span class="value" aria-hidden="true"></span> <button disabled>Reveal</button><p role="status"></p>');
  const slider = betForm.querySelector('input') as HTMLInputElement;
  const [valueOutput, submitButton, answerOutput] = ['.value', 'button', '[role=status]'].map((selector) => betForm.querySelector(selector) as HTMLButtonElement);
  const [sliderMin, sliderMax] = [Number(slider.min), Number(slider.max)];
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
    const overlaysWithoutAnswer = answerState.overlays.filter((name: string) => name !== hiddenOverlay);
    betForm.addEventListener('focusin', () => void enterState(figure, { ...answerState, overlays: overlaysWithoutAnswer }), { once: true });
  }
  betForm.addEventListener('submit', async (submitEvent) => {
    submitEvent.preventDefault();
    await enterState(figure, answerState);
    await figure.settled;
    const answerNumber = findNumberAtPath(figure.stats, answerPath);
    const actualValue = answerNumber === null ? null : isPercent ? 100 * answerNumber : answerNumber;
    betForm.style.setProperty('--truth', String(((actualValue ?? sliderMax) - sliderMin) / (sliderMax - sliderMin)));
    betForm.classList.add('revealed');
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
