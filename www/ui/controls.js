/**
 * Native inputs with a label, the value with its unit, and one line that says what the parameter
 * does to the picture.
 */

import { css, html, nothing } from 'lit';
import { live } from 'lit/directives/live.js';
import { finger } from './finger.js';

export const controlStyles = css`
  /* The sliders of a group share their columns, each as wide as its widest text in whatever font. */
  fieldset {
    display: grid;
    grid-template-columns: auto minmax(4rem, 1fr) auto;
    column-gap: 0.6rem;
    min-width: 0;
    margin: 0;
    padding: 0;
    border: 0;
    position: relative;
  }

  /* Room for the line of help of the row that has the focus or the pointer. */
  fieldset:has(.slider) {
    padding-bottom: 1.35rem;
  }

  fieldset:has(.picking) {
    grid-template-columns: auto auto minmax(4rem, 1fr) auto;
  }

  fieldset > * {
    grid-column: 1 / -1;
  }

  .slider {
    display: grid;
    grid-template-columns: subgrid;
    align-items: center;
  }

  .slider label {
    min-width: 1.6rem;
    font-size: 1.1rem;
    line-height: 1;
  }

  .slider .value {
    text-align: right;
    white-space: nowrap;
  }

  .effect {
    color: var(--muted);
    font-size: 0.84rem;
    line-height: 1.25;
  }

  .slider .effect {
    position: absolute;
    right: 0;
    bottom: 0;
    left: 0;
    margin: 0;
    visibility: hidden;
  }

  .slider:focus-within .effect,
  fieldset:not(:focus-within) > .slider:hover .effect {
    visibility: visible;
  }

  .slider.off :is(label, .value) {
    color: var(--muted);
  }

  .slider.off input[type='range'] {
    --thumb: var(--paper);
    --thumb-edge: var(--muted);
  }

  input[type='range'] {
    --thumb-edge: var(--thumb);
    appearance: none;
    width: 100%;
    height: 1.75rem;
    margin: 0;
    background: none;
    cursor: pointer;
    touch-action: pan-y;
  }

  input[type='range']::-webkit-slider-runnable-track {
    height: 2px;
    background: var(--muted);
    border-radius: 1px;
  }

  input[type='range']::-moz-range-track {
    height: 2px;
    background: var(--muted);
    border-radius: 1px;
  }

  input[type='range']::-webkit-slider-thumb {
    appearance: none;
    width: 1.05rem;
    height: 1.05rem;
    margin-top: calc(1px - 0.525rem);
    background: var(--thumb);
    border: 2px solid var(--thumb-edge);
    border-radius: 50%;
    box-shadow: 0 0 0 3px var(--paper);
  }

  input[type='range']::-moz-range-thumb {
    box-sizing: border-box;
    width: 1.05rem;
    height: 1.05rem;
    background: var(--thumb);
    border: 2px solid var(--thumb-edge);
    border-radius: 50%;
    box-shadow: 0 0 0 3px var(--paper);
  }

  :is(button, input, textarea, summary, .handle, .chart-marker):focus-visible {
    outline: 2px solid var(--accent);
    outline-offset: 2px;
  }

  summary {
    width: fit-content;
    min-height: 1.75rem;
    cursor: pointer;
  }

  :is(button, textarea, input[type='number']),
  ::file-selector-button {
    background: none;
    border: 1px solid var(--muted);
    border-radius: 3px;
    color: var(--ink);
  }

  button,
  ::file-selector-button {
    min-height: 2rem;
    padding: 0.15rem 0.65rem 0.25rem;
    font: inherit;
    cursor: pointer;
  }

  button:disabled {
    border-color: var(--rule);
    color: var(--muted);
    cursor: default;
  }

  button:enabled:hover {
    border-color: var(--ink);
    box-shadow: inset 0 0 0 1px var(--ink);
  }

  button[aria-pressed='true'] {
    background: var(--ink);
    border-color: var(--ink);
    color: var(--paper);
  }

  @media (forced-colors: active) {
    :is(input[type='range'], svg, .handle) {
      forced-color-adjust: none;
    }

    button[aria-pressed='true'] {
      forced-color-adjust: none;
      background: Highlight;
      border-color: Highlight;
      color: HighlightText;
    }
  }

  /* Text that comes and goes has room for the longest that may come: nothing moves when it does. */
  .roomy::after {
    content: attr(data-room);
    display: block;
    height: 0;
    overflow: hidden;
    visibility: hidden;
  }

  legend {
    width: 100%;
    margin-bottom: 0.5rem;
    padding: 0 0 0.2rem;
    border-bottom: 1px solid var(--rule);
    font-style: italic;
    font-size: 1.05rem;
  }

  .choice,
  .toggle {
    display: inline-flex;
    align-items: center;
    gap: 0.45rem;
    min-height: 1.75rem;
    cursor: pointer;
  }

  .choices,
  .options {
    display: flex;
    flex-wrap: wrap;
    column-gap: 1rem;
  }

  .choices > span {
    flex: 0 0 var(--name, 6.5rem);
    align-self: center;
  }

  .options {
    flex: 1;
    min-width: min-content;
  }

  .options .choice {
    flex: 1 0 0;
    min-width: max-content;
  }

  input:is([type='radio'], [type='checkbox']) {
    flex: none;
    width: 1rem;
    height: 1rem;
    margin: 0.25rem;
    accent-color: var(--ink);
    cursor: pointer;
  }
`;

/**
 * A slider row.
 *
 * @param {object} row
 * @param {string} row.id unique in the widget
 * @param {unknown} row.symbol
 * @param {string} [row.name] what a screen reader says where the symbol says too little
 * @param {number} row.value
 * @param {number} row.min
 * @param {number} row.max
 * @param {number} row.step
 * @param {(value: number) => string} row.show a value with its unit
 * @param {unknown} row.effect what the parameter does to the picture
 * @param {'prior' | 'prediction' | 'truth'} row.role
 * @param {boolean} [row.off] its value has no effect at present
 * @param {unknown} [row.pick] a control in front of the label
 * @param {(value: number) => void} row.input while it moves
 * @param {() => void} row.commit when it comes to rest
 */
export function sliderRow(row) {
  const classes = `slider${row.pick ? ' picking' : ''}${row.off ? ' off' : ''}`;
  const shown = row.show(row.value);
  const set = (/** @type {Event} */ event) => {
    // A browser sets a slider as soon as a finger comes down on it.
    if (!finger.waits) row.input(inputOf(event).valueAsNumber);
  };
  const room = longest([shown, row.show(row.min), row.show(row.max)]);
  return html`
    <div class=${classes} part="slider" .style=${`--thumb: var(--${row.role})`}>
      ${row.pick ?? nothing}
      <label for=${row.id}>${row.symbol}</label>
      <input
        id=${row.id}
        type="range"
        min=${row.min}
        max=${row.max}
        step=${row.step}
        .value=${live(String(row.value))}
        aria-label=${row.name ?? nothing}
        aria-valuetext=${shown}
        aria-describedby="${row.id}-effect"
        @pointerdown=${finger.comes}
        @pointermove=${(/** @type {PointerEvent} */ event) => {
          finger.moves(event);
          if (event.pointerType === 'touch' && !finger.waits) set(event);
        }}
        @pointerup=${(/** @type {PointerEvent} */ event) => finger.goes() && set(event)}
        @pointercancel=${(/** @type {PointerEvent} */ event) => {
          if (finger.goes()) inputOf(event).value = String(row.value);
        }}
        @input=${set}
        @change=${row.commit}
      />
      <span class="value roomy" data-room=${room}>${shown}</span>
      <p class="effect" id="${row.id}-effect">${row.effect}</p>
    </div>
  `;
}

/**
 * What is folded away until it is asked for.
 *
 * @param {string} name
 * @param {unknown} content
 * @param {(open: boolean) => void} [toggled]
 */
export function fold(name, content, toggled) {
  return html`<details
    part="fold"
    @toggle=${(/** @type {Event} */ event) => toggled?.(/** @type {HTMLDetailsElement} */ (event.target).open)}
  >
    <summary>${name}</summary>
    <div class="folded">${content}</div>
  </details>`;
}

/** A message with its italics and subscripts. @param {string} message as messages/en.js has it */
export function rich(message) {
  return message
    .split(/(\*[^*]+\*|[₀-₉])/)
    .map((part) =>
      part[0] === '*'
        ? html`<i>${part.slice(1, -1)}</i>`
        : /^[₀-₉]$/.test(part)
          ? html`<sub>${part.charCodeAt(0) - 0x2080}</sub>`
          : part,
    );
}

/** @param {string[]} texts */
export function longest(texts) {
  return texts.reduce((one, other) => (other.length > one.length ? other : one), '');
}

/**
 * One of a group of radio buttons.
 *
 * @param {{ group: string, label?: unknown, name?: string, checked: boolean, choose: () => void }} option with a name for
 *   screen readers where it has no label
 */
export function choice({ group, label, name, checked, choose }) {
  return html`<label class="choice">
    <input type="radio" name=${group} aria-label=${name ?? nothing} .checked=${live(checked)} @change=${choose} />
    ${label ? html`<span>${label}</span>` : nothing}
  </label>`;
}

/** @param {{ label: unknown, checked: boolean, change: (checked: boolean) => void }} option */
export function toggle({ label, checked, change }) {
  return html`<label class="toggle">
    <input
      type="checkbox"
      .checked=${live(checked)}
      @change=${(/** @type {Event} */ event) => change(inputOf(event).checked)}
    />
    ${label}
  </label>`;
}

/**
 * @param {string} label
 * @param {() => void} press
 * @param {{ pressed?: boolean, disabled?: boolean, title?: string }} [state]
 */
export function button(label, press, { pressed, disabled = false, title } = {}) {
  return html`<button
    type="button"
    part="button"
    ?disabled=${disabled}
    title=${title ?? nothing}
    aria-pressed=${pressed ?? nothing}
    @click=${press}
  >
    ${label}
  </button>`;
}

/** @param {Event} event */
export function inputOf(event) {
  return /** @type {HTMLInputElement} */ (event.target);
}

/**
 * Radio buttons in a row under one name.
 *
 * @template {string} Name
 * @param {string} label
 * @param {string} group
 * @param {Record<Name, string>} labels in the order shown
 * @param {Name} current
 * @param {(name: Name) => void} choose
 */
export function radioGroup(label, group, labels, current, choose) {
  const names = /** @type {Name[]} */ (Object.keys(labels));
  return html`<div class="choices" role="radiogroup" aria-label=${label}>
    <span aria-hidden="true">${label}</span>
    <div class="options">
      ${names.map((name) =>
        choice({ group, label: labels[name], checked: name === current, choose: () => choose(name) }),
      )}
    </div>
  </div>`;
}
