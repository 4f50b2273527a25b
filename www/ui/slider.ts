/** Slider with a label, an editable value, and a line of text about its effect on the picture. */

import { css, html, noChange, nothing } from 'lit';
import { live } from 'lit/directives/live.js';
import { inputOf } from './controls.ts';

export const sliderStyles = css`
  /* Name and value above the track, and space for a line of help below it. */
  .slider {
    position: relative;
    display: grid;
    grid-template: 'name value' auto 'track track' auto / 1fr auto;
    align-items: baseline;
    column-gap: 0.5em;
    padding-bottom: 0.9em;
  }

  /* Slider next to a button. */
  .with-button {
    display: grid;
    grid-template-columns: minmax(min-content, 1fr) auto;
    column-gap: 0.75em;
    align-items: center;
  }

  /* The button is centred on the slider's track, not on track and hint together. */
  .playable > button {
    margin-bottom: 0.8em;
  }

  .slider > :first-child {
    grid-area: name;
    line-height: 1.2;
  }

  .slider .symbol {
    margin-inline-end: 0.3em;
    font-size: 1.1em;
  }

  .slider .choice {
    min-height: 0;
  }

  .slider > input[type='range'] {
    grid-area: track;
  }

  .slider .value {
    grid-area: value;
    white-space: nowrap;
  }

  /* The field is as wide as the longest value. */
  .typed {
    box-sizing: content-box;
    width: 0;
    min-width: 100%;
    margin: -0.2em 0 0 -0.4em;
    padding: 0.1em 0.1em 0.1em 0.2em;
    background: none;
    border: 1px solid transparent;
    border-radius: 3px;
    color: inherit;
    text-align: right;
  }

  .typed:hover {
    border-color: var(--muted);
  }

  /* A text that is too long for this space covers the content below. */
  .slider .effect {
    position: absolute;
    top: calc(100% - 1.1em);
    right: 0;
    left: 0;
    z-index: 1;
    margin: 0;
    visibility: hidden;
    background: var(--paper);
  }

  .slider:is(:focus-within, :hover) .effect {
    visibility: visible;
  }

  /* The sentence about a refused value stays until the user types again or changes a setting. */
  .slider.refused .effect {
    visibility: visible;
    color: var(--accent);
  }

  input[type='range'] {
    width: 100%;
    height: 1.75em;
    margin: 0;
    accent-color: var(--role);
    cursor: pointer;
    touch-action: pan-y;
  }

  :is(.slider.off, .slider.off input) {
    accent-color: var(--muted);
    color: var(--muted);
  }

  input[type='range']:focus-visible {
    outline-offset: -2px;
  }

  .typed:focus-visible {
    outline-offset: 0;
    background: var(--paper);
  }
`;

/** Movement (CSS pixels) below which the direction of a touch is undecided. */
const MIN_TOUCH_MOVE = 8;

/**
 * Event that began a touch on a slider, while its direction is undecided. A vertical movement scrolls the page and changes nothing; a
 * horizontal movement or a tap sets the slider.
 */
let undecidedTouch: PointerEvent | undefined;

const beginTouch = (event: PointerEvent) => (undecidedTouch = event.pointerType === 'touch' ? event : undefined);

/** First character of a number that is typed on a slider. */
const NUMBER_START = /^[\d.,+\-\u2212]$/;

/**
 * Returns a slider row. The printed value is also a text field, in which a value beyond the slider may be typed. Tab skips the field. Enter
 * or a digit on the slider moves the focus into the field; Enter and Escape move it back. Arrow keys up and down in the field move the slider.
 */
export function sliderRowHtml(sliderRow: SliderRow) {
  const printedValue = sliderRow.formatValue(sliderRow.value);
  const longestText = [sliderRow.formatValue(sliderRow.min), sliderRow.formatValue(sliderRow.max)].reduce((longerText, candidate) => (candidate.length > longerText.length ? candidate : longerText), printedValue);
  return html`
    <div class="slider ${sliderRow.hasNoEffect ? 'off' : ''} ${sliderRow.refusal ? 'refused' : ''}" part="slider" data-role=${sliderRow.role}>
      <span>
        ${sliderRow.leadingControl ?? nothing}
        <label for=${sliderRow.id} id="${sliderRow.id}-name">${sliderRow.symbol ? html`<bdi class="symbol notranslate" translate="no">${sliderRow.symbol}</bdi>` : nothing}${sliderRow.name}</label>
      </span>
      ${sliderTrackHtml({ ...sliderRow, ...rangeOfStops(sliderRow), name: undefined, valueText: printedValue, describedBy: `${sliderRow.id}-effect`, onKeydown: focusField })}
      <form method="dialog" class="value notranslate" translate="no" dir="ltr" data-longest=${longestText}>
        ${valueFieldHtml(sliderRow, printedValue)}
      </form>
      <p class="effect muted small" id="${sliderRow.id}-effect" role=${sliderRow.refusal ? 'alert' : nothing}>${sliderRow.refusal || sliderRow.effect}</p>
    </div>
  `;
}

interface SliderRange {
  /** Id that is unique in the widget. */
  id: string;
  value: number;
  min: number;
  max: number;
  step: number;
  /** Called while the thumb moves. */
  onInput: (value: number) => void;
  /** Called when the thumb comes to rest. */
  onCommit: () => void;
}

export interface SliderRow extends SliderRange {
  symbol?: unknown;
  name: unknown;
  /** Values of the slider, if they are not in equal steps. */
  stops?: readonly number[];
  formatValue: (value: number) => string;
  /** Text on the effect of the setting on the picture. */
  effect: unknown;
  role: 'prior' | 'prediction' | 'truth';
  /** True if the value has no effect at present. */
  hasNoEffect?: boolean;
  /** HTML of a control in front of the label. */
  leadingControl?: unknown;
  /** Keyboard of a phone for typing the value. */
  inputMode: 'decimal' | 'numeric' | 'text';
  /** Applies a typed text. Returns the number in it, or undefined if it is refused. */
  applyTypedText: (text: string) => number | undefined;
  /** Sentence about a refused text. */
  refusal?: string;
  /** Hides the sentence about a refused text. */
  clearRefusal: () => void;
}

/** Returns the range of a slider over stops, whose positions are the indices of the stops. A value beyond the last stop has the position after it. */
function rangeOfStops({ stops, value, onInput }: SliderRow): Partial<SliderRange> {
  if (!stops) return {};
  const stopIndex = stops.findIndex((stop) => stop >= value);
  return { min: 0, max: stops.length - 1, step: 1, value: stopIndex < 0 ? stops.length : stopIndex, onInput: (index) => onInput(stops[index]) };
}

interface SliderTrack extends SliderRange {
  /** Accessible name, for a slider without a label that screen readers can read. */
  name?: string;
  valueText: string;
  describedBy?: string;
  onKeydown?: (event: KeyboardEvent) => void;
}

/** Returns the track of a slider. A finger that moves up or down over it scrolls the page. */
export function sliderTrackHtml({ id, name, min, max, step, value, valueText, describedBy, onKeydown: keydown, onInput, onCommit }: SliderTrack) {
  // A browser changes a slider as soon as it is touched. The change is applied only after the touch proves to be a tap or a sideways move.
  const setValue = (event: Event) => {
    if (!undecidedTouch) onInput(inputOf(event).valueAsNumber);
  };
  const moveTouch = (event: PointerEvent) => {
    const horizontalMove = Math.abs(event.clientX - (undecidedTouch?.clientX ?? NaN));
    if (horizontalMove > MIN_TOUCH_MOVE && horizontalMove > Math.abs(event.clientY - (undecidedTouch?.clientY ?? NaN))) undecidedTouch = undefined;
    if (event.pointerType === 'touch') setValue(event);
  };
  const endPointer = (event: PointerEvent) => {
    if (!undecidedTouch) return;
    undecidedTouch = undefined;
    if (event.type === 'pointerup') setValue(event);
    else inputOf(event).value = String(value);
  };
  return html`<input
    id=${id}
    type="range"
    min=${min}
    max=${max}
    step=${step}
    .value=${undecidedTouch ? noChange : live(String(value))}
    aria-label=${name ?? nothing}
    aria-valuetext=${valueText}
    aria-describedby=${describedBy ?? nothing}
    @keydown=${keydown}
    @pointerdown=${beginTouch}
    @pointermove=${moveTouch}
    @pointerup=${endPointer}
    @pointercancel=${endPointer}
    @input=${setValue}
    @change=${onCommit}
  />`;
}

/** Returns the field of a value. Its default is the printed value, which a browser shows unless the user has typed another text. */
function valueFieldHtml(sliderRow: SliderRow, printedValue: string) {
  const { id, inputMode, stops, formatValue, applyTypedText, refusal, clearRefusal } = sliderRow;
  /** Applies the typed text; returns true if it became the value. */
  const applyText = (input: HTMLInputElement): boolean => {
    if (input.value === input.defaultValue) return true;
    const number = applyTypedText(input.value);
    if (number !== undefined) {
      input.defaultValue = formatValue(number);
      // The next key may come before the slider is rendered with the new value.
      controlOfRow(input, 'input[type=range]').value = String(rangeOfStops({ ...sliderRow, value: number }).value ?? number);
    }
    input.form?.reset();
    return number !== undefined;
  };
  /** Moves the slider by a step, as an arrow key does, and selects the new text in the field. */
  const stepSlider = (slider: HTMLInputElement, stepCount: number, input: HTMLInputElement) => {
    const valueBefore = slider.value;
    slider.stepUp(stepCount);
    if (slider.value === valueBefore) return;
    for (const eventType of ['input', 'change']) slider.dispatchEvent(new Event(eventType));
    input.defaultValue = formatValue(stops ? stops[slider.valueAsNumber] : slider.valueAsNumber);
    input.select();
  };
  const handleKey = (event: KeyboardEvent) => {
    const input = inputOf(event);
    const slider = controlOfRow(input, 'input[type=range]');
    const isArrow = ['ArrowUp', 'ArrowDown'].includes(event.key);
    if (event.key === 'Escape') input.form?.reset();
    else if (event.key !== 'Enter' && !isArrow) return;
    // A handled Escape does not end a presentation.
    event.preventDefault();
    const isUnchanged = input.value === input.defaultValue;
    if (!applyText(input)) input.select();
    else if (!isArrow) slider.focus();
    else if (isUnchanged) stepSlider(slider, event.key === 'ArrowUp' ? 1 : -1, input);
  };
  return html`<input
    class="typed"
    type="text"
    tabindex="-1"
    inputmode=${inputMode}
    enterkeyhint="done"
    autocomplete="off"
    spellcheck="false"
    aria-labelledby="${id}-name"
    aria-describedby="${id}-effect"
    aria-invalid=${refusal !== undefined}
    value=${printedValue}
    @focus=${(event: Event) => inputOf(event).select()}
    @input=${clearRefusal}
    @keydown=${handleKey}
    @blur=${(event: Event) => applyText(inputOf(event))}
  />`;
}

/** Moves the focus from a slider to its field and selects the field's text, so that the pressed key replaces it. */
function focusField(event: KeyboardEvent) {
  const { key, ctrlKey, altKey, metaKey } = event;
  if (ctrlKey || altKey || metaKey || (key !== 'Enter' && !NUMBER_START.test(key))) return;
  const slider = inputOf(event);
  // Digits select presets in a presentation.
  if (/\d/.test(key) && (slider.getRootNode() as any).host?.presentation) return;
  if (key === 'Enter') event.preventDefault();
  event.stopPropagation();
  controlOfRow(slider, '.typed').focus();
}

const controlOfRow = (element: Element, selector: string) => (element.closest('.slider') as Element).querySelector(selector) as HTMLInputElement;
