/** Slider with a label, an editable value, and a line of text about its effect on the picture. */

import { css, html, noChange, nothing } from 'lit';
import { live } from 'lit/directives/live.js';
import { words } from '../messages/registry.ts';
import { inputOf, numberFieldHtml, type AllowedNumbers } from './controls.ts';

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
    position: relative;
    grid-area: value;
    text-align: right;
    white-space: nowrap;
  }

  /* The field covers the printed value while it has the focus. */
  .typed {
    position: absolute;
    inset: 50% 0 auto auto;
    box-sizing: border-box;
    width: 7em;
    max-width: 100%;
    height: max(24px, 1.6em);
    padding: 0 0.2em;
    translate: 0 -50%;
    opacity: 0;
    text-align: inherit;
  }

  .typed:focus {
    z-index: 1;
    max-width: none;
    outline-offset: 0;
    background: var(--paper);
    opacity: 1;
  }

  .value:hover {
    text-decoration: underline var(--muted);
    text-underline-offset: 0.25em;
  }

  /* A text that is too long for this space covers the content below, and does not move it. */
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
`;

/** Movement (CSS pixels) below which the direction of a touch is undecided. */
const MIN_TOUCH_MOVE = 8;

/**
 * Event that began a touch on a slider, while its direction is undecided. A vertical movement scrolls the page and changes nothing; a
 * horizontal movement or a tap sets the slider.
 */
let undecidedTouch: PointerEvent | undefined;

const beginTouch = (pointerEvent: PointerEvent) => (undecidedTouch = pointerEvent.pointerType === 'touch' ? pointerEvent : undefined);

/** First character of a number that is typed on a slider. */
const NUMBER_START = /^[\d.,+-]$/;

/**
 * Returns a slider row. A field over the printed value accepts values beyond the slider too. Tab skips the field. Enter or a digit on the
 * slider moves the focus into the field; Enter and Escape move it back.
 */
export function sliderRowHtml(sliderRow: SliderRow) {
  const { id, value: sliderValue, min: minValue, max: maxValue, step: sliderStep, allowedNumbers, colourRole, symbol: rowSymbol, name: rowName, effect: effectText, formatValue, onInput, onCommit } = sliderRow;
  const printedValue = formatValue(sliderValue);
  const longestText = [formatValue(minValue), formatValue(maxValue)].reduce((longerText, candidateText) => (candidateText.length > longerText.length ? candidateText : longerText), printedValue);
  // If the thumb is at an end of the slider, a text tells the user that values beyond that end can be typed.
  const endAtThumb = sliderValue >= maxValue && maxValue < allowedNumbers.max ? maxValue : sliderValue <= minValue && minValue > allowedNumbers.min ? minValue : undefined;
  const applyTyped = (typedNumber: number, valueField: HTMLInputElement) => {
    onInput(typedNumber);
    onCommit();
    // The slider gets its value at once, because the next key may be pressed before the next rendering.
    controlOfRow(valueField, 'input[type=range]').value = String(rangeOfStops({ ...sliderRow, value: typedNumber }).value ?? typedNumber);
  };
  const focusTrack = (event: Event) => controlOfRow(event.target as Element, 'input[type=range]').focus();
  return html`
    <div class="slider ${sliderRow.hasNoEffect ? 'off' : ''}" part="slider" data-role=${colourRole}>
      <span>
        ${sliderRow.leadingControl ?? nothing}
        <label for=${id} id="${id}-name">${rowSymbol ? html`<bdi class="symbol notranslate" translate="no">${rowSymbol}</bdi>` : nothing}${rowName}</label>
      </span>
      ${sliderTrackHtml({ ...sliderRow, ...rangeOfStops(sliderRow), name: undefined, valueText: printedValue, describedBy: `${id}-effect`, onKeydown: focusField })}
      <form method="dialog" class="value notranslate" translate="no" dir="ltr" data-longest=${longestText} @submit=${focusTrack} @keydown=${(keyEvent: KeyboardEvent) => keyEvent.key === 'Escape' && focusTrack(keyEvent)}>
        <span>${printedValue}</span>
        ${numberFieldHtml({ ...allowedNumbers, value: Number(sliderValue.toPrecision(MAX_FIELD_DIGITS)), arrowKeyRange: { min: minValue, max: maxValue, step: sliderStep }, labelId: `${id}-name`, onChange: applyTyped })}
      </form>
      <p class="effect muted small" id="${id}-effect">${endAtThumb === undefined ? effectText : words.sliderEndNote(formatValue(endAtThumb))}</p>
    </div>
  `;
}

/** Maximum number of significant digits in the field of a value. */
const MAX_FIELD_DIGITS = 8;

interface SliderRange {
  /** Id that is unique in the widget. */
  id: string;
  value: number;
  min: number;
  max: number;
  step: number;
  /** Called while the thumb moves. */
  onInput: (sliderValue: number) => void;
  /** Called when the thumb comes to rest. */
  onCommit: () => void;
}

export interface SliderRow extends SliderRange {
  symbol?: unknown;
  name: unknown;
  /** Values of the slider, if they are not in equal steps. */
  stops?: readonly number[];
  formatValue: (sliderValue: number) => string;
  /** Text on the effect of the setting on the picture. */
  effect: unknown;
  colourRole: 'prior' | 'prediction' | 'truth';
  /** True if the value has no effect on the simulation at present. */
  hasNoEffect?: boolean;
  /** HTML of a control in front of the label. */
  leadingControl?: unknown;
  /** Values that can be typed. */
  allowedNumbers: AllowedNumbers;
}

/** Returns the range of a slider over stops, whose positions are the indices of the stops. A value beyond the last stop has the position after it. */
function rangeOfStops({ stops: sliderStops, value: sliderValue, onInput }: SliderRow): Partial<SliderRange> {
  if (!sliderStops) return {};
  const stopIndex = sliderStops.findIndex((stopValue) => stopValue >= sliderValue);
  return { min: 0, max: sliderStops.length - 1, step: 1, value: stopIndex < 0 ? sliderStops.length : stopIndex, onInput: (newStopIndex) => onInput(sliderStops[newStopIndex]) };
}

interface SliderTrack extends SliderRange {
  /** Accessible name, for a slider without a label that screen readers can read. */
  name?: string;
  valueText: string;
  describedBy?: string;
  onKeydown?: (keyEvent: KeyboardEvent) => void;
}

/** Returns the track of a slider. A finger that moves up or down over it scrolls the page. */
export function sliderTrackHtml({ id, name: accessibleName, min: minValue, max: maxValue, step: sliderStep, value: sliderValue, valueText, describedBy, onKeydown: handleKeydown, onInput, onCommit }: SliderTrack) {
  // A browser changes a slider as soon as it is touched. The change is applied only after the touch proves to be a tap or a sideways move.
  const setValue = (event: Event) => {
    if (!undecidedTouch) onInput(inputOf(event).valueAsNumber);
  };
  const moveTouch = (pointerEvent: PointerEvent) => {
    const horizontalMove = Math.abs(pointerEvent.clientX - (undecidedTouch?.clientX ?? NaN));
    if (horizontalMove > MIN_TOUCH_MOVE && horizontalMove > Math.abs(pointerEvent.clientY - (undecidedTouch?.clientY ?? NaN))) undecidedTouch = undefined;
    if (pointerEvent.pointerType === 'touch') setValue(pointerEvent);
  };
  const endPointer = (pointerEvent: PointerEvent) => {
    if (!undecidedTouch) return;
    undecidedTouch = undefined;
    if (pointerEvent.type === 'pointerup') setValue(pointerEvent);
    else inputOf(pointerEvent).value = String(sliderValue);
  };
  return html`<input
    id=${id}
    type="range"
    min=${minValue}
    max=${maxValue}
    step=${sliderStep}
    .value=${undecidedTouch ? noChange : live(String(sliderValue))}
    aria-label=${accessibleName ?? nothing}
    aria-valuetext=${valueText}
    aria-describedby=${describedBy ?? nothing}
    @keydown=${handleKeydown}
    @pointerdown=${beginTouch}
    @pointermove=${moveTouch}
    @pointerup=${endPointer}
    @pointercancel=${endPointer}
    @input=${setValue}
    @change=${onCommit}
  />`;
}

/** Moves the focus from a slider to its field and selects the field's text, so that the pressed key replaces it. */
function focusField(keyEvent: KeyboardEvent) {
  const { key: pressedKey, ctrlKey, altKey, metaKey } = keyEvent;
  if (ctrlKey || altKey || metaKey || (pressedKey !== 'Enter' && !NUMBER_START.test(pressedKey))) return;
  const slider = inputOf(keyEvent);
  // In a presentation, digits select presets, and are not typed into the field.
  if (/\d/.test(pressedKey) && (slider.getRootNode() as any).host?.presentation) return;
  if (pressedKey === 'Enter') keyEvent.preventDefault();
  keyEvent.stopPropagation();
  controlOfRow(slider, '.typed').focus();
}

const controlOfRow = (element: Element, controlSelector: string) => (element.closest('.slider') as Element).querySelector(controlSelector) as HTMLInputElement;
