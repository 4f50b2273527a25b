/** Native inputs with a label, buttons, and groups of them. */

import { css, html, nothing } from 'lit';
import { live } from 'lit/directives/live.js';
import { language } from '../messages/registry.ts';
import { MINUS_SIGN } from './format.ts';

export const controlStyles = css`
  fieldset {
    display: grid;
    min-width: 0;
    margin: 0 0 0.5em;
    padding: 0;
    border: 0;
  }

  .muted {
    color: var(--muted);
  }

  .small {
    font-size: 0.84em;
    line-height: 1.25;
  }

  :is(button, input, select, textarea, summary, .handle, .reserved):focus-visible,
  :is(.options .choice, .files):has(:focus-visible) {
    outline: 2px solid var(--accent);
    outline-offset: 2px;
  }

  summary {
    width: fit-content;
    min-height: 1.75em;
    cursor: pointer;
  }

  :where(button, textarea, select, input[type='number'], .files, .options .choice) {
    background: none;
    border: 1px solid var(--muted);
    border-radius: 3px;
    color: var(--ink);
  }

  textarea {
    box-sizing: border-box;
    width: 100%;
    font: 0.85em / 1.4 ui-monospace, monospace;
  }

  /* Controls have the font of the figure instead of the browser's font for controls. */
  :is(button, input) {
    font: inherit;
    font-variant-numeric: inherit;
  }

  button {
    min-height: 2em;
    padding: 0.15em var(--beside, 0.65em) 0.25em;
    cursor: pointer;
  }

  button:disabled {
    border-color: var(--rule);
    color: var(--muted);
    cursor: default;
  }

  :is(button:enabled, .files):hover {
    border-color: var(--ink);
    box-shadow: inset 0 0 0 1px var(--ink);
  }

  :is(button[aria-pressed='true'], .options .choice:has(:checked)) {
    background: var(--ink);
    border-color: var(--ink);
    color: var(--paper);
  }

  @media (forced-colors: active) {
    :is(svg, .handle) {
      forced-color-adjust: none;
    }

    :is(button[aria-pressed='true'], .options .choice:has(:checked)) {
      forced-color-adjust: none;
      background: Highlight;
      border-color: Highlight;
      color: HighlightText;
    }
  }

  /* Reserves the width of the longest text that the element may have. */
  [data-longest]::after {
    content: attr(data-longest);
    display: block;
    height: 0;
    overflow: hidden;
    visibility: hidden;
  }

  :is(legend, .panel-title) {
    font-weight: bold;
    font-size: 0.92em;
  }

  legend {
    margin-bottom: 0.25em;
    padding: 0;
  }

  ul {
    margin: 0;
    padding: 0;
    list-style: none;
  }

  :where(.buttons, .choices, .options, .legend, .plot-key, .readouts, .marked, .marked output) {
    display: flex;
    flex-wrap: wrap;
  }

  .choice,
  .toggle {
    display: inline-flex;
    align-items: center;
    gap: 0.45em;
    min-height: max(24px, 1.75em);
    cursor: pointer;
  }

  .choices {
    align-items: center;
    gap: 0.2em 1em;
    margin-bottom: 0.5em;
  }

  /* Segmented control: the whole label can be pressed, and the selected one is filled. */
  .options {
    gap: 2px;
  }

  .options .choice {
    min-height: 2em;
  }

  :is(.options .choice, .files) {
    position: relative;
    padding: 0 0.65em;
  }

  :is(.options, .files) input {
    position: absolute;
    inset: 0;
    opacity: 0;
  }

  .files {
    min-height: 24px;
  }

  .marked {
    align-items: center;
    min-height: 2.2em;
    margin: 0.3em 0 0;
  }

  :is(.marked, .marked output) {
    gap: 0.1em 1.1em;
  }

  .marked label {
    color: var(--accent);
  }

  .seed {
    display: block;
  }

  :is(.marked, .seed) input {
    width: 5em;
    min-height: 2em;
    padding: 0 0.4em;
  }

  .marked input {
    width: 8em;
  }

  input[type='number'] {
    appearance: textfield;
  }

  ::-webkit-inner-spin-button {
    appearance: none;
  }

  input:user-invalid {
    border-color: var(--accent);
  }

  input:is([type='radio'], [type='checkbox']) {
    flex: none;
    width: 1em;
    height: 1em;
    margin: 0.25em;
    accent-color: var(--ink);
    cursor: pointer;
  }
`;

/** Pattern of a piece of a formula in a message: italics between asterisks, or a subscript. */
const FORMULA_PIECE_PATTERN = String.raw`\*(?:\\\*|[^*])+\*|[₀-₉]|_\{[^}]+\}`;
const FORMULA_PIECE = new RegExp(FORMULA_PIECE_PATTERN, 'g');
const FORMULA_REGEXP = new RegExp(`((?:${FORMULA_PIECE_PATTERN})+)`);

/** Returns a message as HTML, with italics and subscripts in its formulas. The text \\* is an asterisk. */
export function formatMarkup(markedUpText: string) {
  // Formulas and other text alternate in the split message. Parts with odd indices are formulas.
  return markedUpText.split(FORMULA_REGEXP).map((proseOrFormula, i) => (i % 2 ? untranslatedHtml(proseOrFormula.match(FORMULA_PIECE)?.map(formulaPieceHtml)) : proseOrFormula));
}

function formulaPieceHtml(formulaPiece: string) {
  if (formulaPiece[0] === '*') return html`<i>${formulaPiece.slice(1, -1).replaceAll('\\*', '*')}</i>`;
  return html`<sub>${formulaPiece[0] === '_' ? formulaPiece.slice(2, -1) : formulaPiece.charCodeAt(0) - 0x2080}</sub>`;
}

/** Returns a value or formula with its own writing direction, which page translators leave unchanged. */
export const untranslatedHtml = (untranslatedContent: unknown) => html`<bdi translate="no" class="notranslate">${untranslatedContent}</bdi>`;

export function fieldsetHtml(heading: unknown, fieldsetContent: unknown, className?: string, cssPart?: string) {
  return html`<fieldset class=${className ?? nothing} part=${cssPart ?? nothing}>
    <legend>${heading}</legend>
    ${fieldsetContent}
  </fieldset>`;
}

/** Returns a radio button of a group. `name` is its name for screen readers, if it has no label. */
export function radioButtonHtml({ groupName, labelContent, name, isChecked, onChoose }: { groupName: string, labelContent?: unknown, name?: string, isChecked: boolean, onChoose: () => void }) {
  return html`<label class="choice">
    <input type="radio" name=${groupName} aria-label=${name ?? nothing} .checked=${live(isChecked)} @change=${onChoose} />
    ${labelContent ? html`<span>${labelContent}</span>` : nothing}
  </label>`;
}

export function checkboxHtml({ labelContent, isChecked, onChange }: { labelContent: unknown, isChecked: boolean, onChange: (isChecked: boolean) => void }) {
  return html`<label class="toggle">
    <input
      type="checkbox"
      .checked=${live(isChecked)}
      @change=${(event: Event) => onChange(inputOf(event).checked)}
    />
    ${labelContent}
  </label>`;
}

/** Returns a button. It is wide enough for `otherLabel`, so that no other control moves when the label changes. */
export function buttonHtml(labelContent: unknown, onPress: () => void, { isPressed, disabled = false, title, className, otherLabel }: { isPressed?: boolean, disabled?: boolean, title?: string, className?: string, otherLabel?: string } = {}) {
  return html`<button
    type="button"
    class=${className ?? nothing}
    data-longest=${otherLabel ?? nothing}
    part="button"
    ?disabled=${disabled}
    title=${title ?? nothing}
    aria-pressed=${isPressed ?? nothing}
    @click=${onPress}
  >
    ${labelContent}
  </button>`;
}

/** Range of the numbers that can be typed, and their type: `whole` for whole numbers. */
export interface AllowedNumbers {
  min: number;
  max: number;
  type?: string;
}

interface NumberField extends AllowedNumbers {
  /** Number in the field, or null for an empty field. */
  value: number | null;
  /** Range and step for the arrow keys, if not every allowed number can be reached with them. */
  arrowKeyRange?: { min: number, max: number, step: number };
  id?: string;
  /** Id of the element that labels the field, if no `label` does. The Tab key then skips the field. */
  labelId?: string;
  /** True if the field may be empty. */
  isOptional?: boolean;
  placeholder?: string;
  isDisabled?: boolean;
  /** Called for each allowed number that the user has entered, with NaN for an empty field. */
  onChange: (newValue: number, numberField: HTMLInputElement) => void;
}

/**
 * Returns a number field, which must be in a form of its own. The browser checks what the user types, and says on Enter why it is not
 * allowed. Escape, or leaving the field, restores the number.
 */
export function numberFieldHtml({ value: fieldValue, min: minValue, max: maxValue, type: numberType, arrowKeyRange, id, labelId, isOptional = false, placeholder, isDisabled = false, onChange }: NumberField) {
  const typingRange = { min: minValue, max: maxValue, step: numberType === 'whole' ? '1' : 'any' };
  const handleKey = (keyEvent: KeyboardEvent) => {
    const numberField = inputOf(keyEvent);
    // Arrow keys step in units of `step` from `min`, and need another range than typed numbers.
    Object.assign(numberField, keyEvent.key.startsWith('Arrow') ? arrowKeyRange : typingRange);
    if (keyEvent.key !== 'Escape') return;
    numberField.form?.reset();
    // Without this call, Escape would also end a presentation.
    keyEvent.preventDefault();
  };
  const groupSeparator = language === 'de' ? '.' : ',';
  // Browsers drop characters that are not in the notation of the browser's language: 0,35 would become 35. Such characters are replaced.
  const replaceSigns = (inputEvent: InputEvent) => {
    const typedText = inputEvent.data ?? '';
    const replacedText = (numberType === 'whole' ? typedText.replaceAll(groupSeparator, '') : typedText).replace(MINUS_SIGN, '-').replace(',', '.');
    if (replacedText === typedText) return;
    inputEvent.preventDefault();
    if (replacedText) document.execCommand('insertText', false, replacedText);
  };
  const enterNumber = (event: Event) => {
    const numberField = Object.assign(inputOf(event), typingRange);
    if (!numberField.validity.valid) return;
    onChange(numberField.valueAsNumber, numberField);
    // After typing, browsers ignore the attribute `value` until the form is reset. The typed number is first made the default, which the reset restores.
    numberField.defaultValue = numberField.value;
    numberField.form?.reset();
  };
  return html`<input
    type="number"
    class=${labelId ? 'typed' : nothing}
    id=${id ?? nothing}
    tabindex=${labelId ? -1 : nothing}
    min=${minValue}
    max=${maxValue}
    step=${typingRange.step}
    value=${live(String(fieldValue ?? ''))}
    placeholder=${placeholder ?? nothing}
    aria-labelledby=${labelId ?? nothing}
    autocomplete="off"
    ?required=${!isOptional}
    ?disabled=${isDisabled}
    @focus=${(event: Event) => inputOf(event).select()}
    @beforeinput=${replaceSigns}
    @keydown=${handleKey}
    @change=${enterNumber}
    @blur=${(event: Event) => inputOf(event).form?.reset()}
  />`;
}

export const inputOf = (event: Event) => event.target as HTMLInputElement;

/** Returns radio buttons in a row under one name, in the order of the labels. */
export function radioGroupHtml<Name extends string>(groupLabel: string, groupName: string, labelsByName: Record<Name, string>, checkedName: Name, onChoose: (name: Name) => void) {
  const choiceNames = Object.keys(labelsByName) as Name[];
  return html`<div class="choices" role="radiogroup" aria-label=${groupLabel}>
    <span aria-hidden="true">${groupLabel}</span>
    <div class="options">
      ${choiceNames.map((choiceName) =>
        radioButtonHtml({ groupName, labelContent: labelsByName[choiceName], isChecked: choiceName === checkedName, onChoose: () => onChoose(choiceName) }),
      )}
    </div>
  </div>`;
}
