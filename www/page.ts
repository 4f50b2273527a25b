/**
 * Script of the page around the figures: buttons that set the state of a figure, terms that highlight a line in its picture,
 * and predictions.
 *
 * @module
 */

type FigureElement = HTMLElement & Record<string, any>;

/** Initial states of the figures, as `getState` returned them. */
const openingStates: WeakMap<Element, Record<string, any>> = new WeakMap();

/** Returns the figure of the article that contains an element. */
const figureOf = (pageElement: Element) => pageElement.closest('article')?.querySelector('.stand') as FigureElement;

/**
 * Restores the initial state of a figure, and then sets values in their order. The key of a value is a property of the element, or else a
 * field of its state. A preset has to be the first value, because it replaces the others.
 */
async function enterState(figureElement: FigureElement, settingValues: Record<string, unknown>) {
  if (!openingStates.has(figureElement)) await new Promise((resolveLoad) => figureElement.addEventListener('load', resolveLoad, { once: true }));
  const openingState = openingStates.get(figureElement) ?? {};
  // All samples are shown at once, because the text of the page describes the complete cloud.
  const completeCloudFields = 'shown' in openingState ? { shown: openingState.samples, playing: false } : {};
  const { widget, version: stateVersion } = openingState;
  figureElement.setState({ ...openingState, ...completeCloudFields });
  for (const [settingKey, settingValue] of Object.entries(settingValues)) {
    if (settingKey in figureElement) figureElement[settingKey] = settingValue;
    else figureElement.setState({ widget, version: stateVersion, [settingKey]: settingValue });
  }
}

async function enterStateOfButton(tryButton: HTMLElement) {
  const figureElement = figureOf(tryButton);
  for (const siblingButton of tryButton.closest('article')?.querySelectorAll('[data-try]') ?? []) siblingButton.removeAttribute('aria-current');
  await enterState(figureElement, JSON.parse(tryButton.dataset.try ?? '{}'));
  tryButton.setAttribute('aria-current', 'true');
  figureElement.addEventListener('input', () => tryButton.removeAttribute('aria-current'), { once: true });
}

/** Highlights the line that a term names while the pointer or the focus is on the term. */
function highlightTerm({ type: eventType, target }: Event) {
  const highlightedTerm = target instanceof Element ? (target.closest('[data-line]') as HTMLElement | null) : null;
  const figureElement = highlightedTerm && figureOf(highlightedTerm);
  // Another script may have removed the figure.
  if (figureElement) figureElement.highlight = /over|in$/.test(eventType) ? highlightedTerm.dataset.line : null;
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
const findNumberAtPath = (stats: Record<string, any>, keyPath: string): number | null => keyPath.split('.').reduce((valueSoFar: any, pathKey) => valueSoFar?.[pathKey], stats) ?? null;

/**
 * Completes a form in which the reader bets on a number by a slider. `data-try` is the state of the figure that has the answer, and `data-answer`
 * the path of the answer in `stats`. `data-hides` names the overlay that shows the answer; it is hidden until the reader submits the bet.
 */
function prepareBetForm(betForm: HTMLFormElement) {
  const figureElement = figureOf(betForm);
  const { try: stateText = '{}', answer: answerPath = '', unit: answerUnit = '', hides: hiddenOverlay } = betForm.dataset;
  const answerState = JSON.parse(stateText);
  betForm.insertAdjacentHTML('beforeend', '<span class="value" aria-hidden="true"></span> <button disabled>Reveal</button><p role="status"></p>');
  const slider = betForm.querySelector('input') as HTMLInputElement;
  const [valueOutput, submitButton, answerOutput] = ['.value', 'button', '[role=status]'].map((elementSelector) => betForm.querySelector(elementSelector) as HTMLButtonElement);
  const [sliderMin, sliderMax] = [Number(slider.min), Number(slider.max)];
  const isPercent = answerUnit === '%';
  const formatValue = (printedValue: number) => `${isPercent ? printedValue.toFixed(slider.valueAsNumber === printedValue ? 0 : 1) + '\u00a0%' : printedValue}`;
  const showValue = () => (slider.ariaValueText = valueOutput.textContent = formatValue(slider.valueAsNumber));

  // The bet can be submitted only after the slider has been moved.
  slider.addEventListener('input', () => {
    submitButton.disabled = false;
    showValue();
  });
  showValue();
  if (hiddenOverlay) {
    const overlaysWithoutAnswer = answerState.overlays.filter((overlayName: string) => overlayName !== hiddenOverlay);
    betForm.addEventListener('focusin', () => void enterState(figureElement, { ...answerState, overlays: overlaysWithoutAnswer }), { once: true });
  }
  betForm.addEventListener('submit', async (submitEvent) => {
    submitEvent.preventDefault();
    await enterState(figureElement, answerState);
    await figureElement.settled;
    const answerNumber = findNumberAtPath(figureElement.stats, answerPath);
    const actualValue = answerNumber === null ? null : isPercent ? 100 * answerNumber : answerNumber;
    betForm.style.setProperty('--truth', String(((actualValue ?? sliderMax) - sliderMin) / (sliderMax - sliderMin)));
    betForm.classList.add('revealed');
    answerOutput.textContent = `Your bet: ${formatValue(slider.valueAsNumber)}. The figure’s answer, ▲:\u00a0${actualValue === null ? 'never' : formatValue(actualValue)}.`;
    submitButton.textContent = 'Reveal again';
  });
}

document.addEventListener('load', ({ target }) => {
  const figureElement = target as FigureElement;
  if (figureElement.getState && !openingStates.has(figureElement)) openingStates.set(figureElement, figureElement.getState());
}, { capture: true });
document.addEventListener('click', ({ target }) => {
  const tryButton = target instanceof Element ? target.closest('button[data-try]') : null;
  if (tryButton) void enterStateOfButton(tryButton as HTMLElement);
});
for (const eventType of ['pointerover', 'pointerout', 'focusin', 'focusout']) document.addEventListener(eventType, highlightTerm);
for (const betForm of document.querySelectorAll('form')) prepareBetForm(betForm);
keepPicturesInSight();
