/** A setting's control, made of its declaration, of how it looks, and of the words for it. */

import { html, noChange, nothing } from 'lit';
import { live } from 'lit/directives/live.js';
import { words } from '../messages/registry.js';
import { group, inputOf, radioGroup, rich, toggle } from '../ui/controls.js';
import { fold } from '../ui/fold.js';
import { counted, limit, numberIn, typed } from '../ui/format.js';
import { sliderRow } from '../ui/slider.js';
import { exportButtons } from './takeaway/export.js';

/**
 * @import { Setting } from './attributes.js'
 * @import { Figure } from './figure.js'
 *
 * @typedef {object} Look what the eye needs of a setting that is a number
 * @property {string} [symbol] as in the book, in the marks of messages
 * @property {'prior' | 'prediction' | 'truth'} role
 * @property {number} min of the slider, within what is allowed
 * @property {number} max
 * @property {number} step
 * @property {number} decimals
 * @property {(config: any) => number} [value] where several may be shown as one
 * @property {[model: 'velocity' | 'odometry', index: number]} [alpha] noise parameter whose words it has
 *
 * @typedef {Partial<Parameters<typeof sliderRow>[0]> & { most?: number }} Row with the most that is allowed, where that is less than declared
 * @typedef {Parameters<typeof sliderRow>[0]} WholeRow
 */

/**
 * @param {Figure} figure
 * @param {string} key of a setting
 * @param {Row} [otherwise] what is not as in every row
 */
export function slider(figure, key, otherwise) {
  const { looks, attributes } = figure.kind;
  const { symbol, decimals, value, ...look } = looks[key];
  const { name, effect } = wordsFor(figure, key);
  const { unit } = declarationOf(figure, key);
  const config = figure.settings.told;
  const setting = /** @type {Setting} */ (attributes[key]);
  return typeable(figure, key, symbol ?? name, {
    ...look,
    id: key,
    symbol: symbol && rich(symbol),
    name: rich(name),
    value: value ? value(config) : /** @type {number} */ (setting.get({ config, machine: figure.machine })),
    show: (shown) => typed(shown, decimals) + (unit ? ` ${unit}` : ''),
    effect: effect && rich(effect),
    input: (number) => want(figure, key, number),
    commit: () => figure.gesture.commit(),
    ...otherwise,
  });
}

/**
 * A slider whose value can be typed too, as far as the core goes.
 *
 * @param {Figure} figure
 * @param {string} key of its setting
 * @param {string} symbol
 * @param {Omit<WholeRow, 'keys' | 'type' | 'refusal' | 'forget'> & { ends?: number[], most?: number }} row with the values at
 *   which the slider ends, where it has others than these inside, and the most that is allowed, where that is less than declared
 * @param {(number: number) => void} [take] a value that was typed
 * @param {(number: number) => string} [print]
 */
function typeable(figure, key, symbol, row, take = row.input, print = row.show) {
  const { min, max: declared, type, unit } = declarationOf(figure, key);
  const max = row.most ?? declared;
  const [first, last] = row.ends ?? [row.min, row.max];
  const whole = type === 'whole';
  // Some sliders begin or end where the core does.
  const end = row.value >= row.max && last < max ? last : row.value <= row.min && first > min ? first : undefined;
  return sliderRow({
    ...row,
    effect: end === undefined ? row.effect : words.sliderEnds(print(end)),
    keys: min < 0 ? 'text' : whole ? 'numeric' : 'decimal',
    type: (text) => {
      const number = numberIn(text, unit, whole);
      if (number >= min && number <= max && (!whole || Number.isInteger(number))) {
        take(number);
        row.commit();
        return print(number);
      }
      const given = Number.isNaN(number) ? `"${text}"` : text.trim().replace('-', '\u2212');
      figure.typing.refuse(key, words.refused(symbol.replaceAll(/[*_{}]/g, ''), given, limit(min), limit(max), whole));
    },
    refusal: figure.typing.refusalOf(key),
    forget: () => figure.typing.forget(),
  });
}

/**
 * A picture's canvas, on which the pointer marks samples. It gets its pixels when it is known how many the screen has there.
 *
 * @param {Figure} figure
 * @param {import('../scene/picture.js').Picture<any>} picture
 * @param {string} description what it shows, in words
 */
export function canvas(figure, picture, description) {
  const point = (/** @type {PointerEvent} */ event) => figure.cloud?.point(picture, event);
  return html`<canvas
    width="0"
    class=${picture.name}
    role="img"
    aria-label=${description}
    @pointermove=${point}
    @click=${point}
    @contextrestored=${() => figure.stage.wake()}
  ></canvas>`;
}

/**
 * A slider for each of several settings.
 *
 * @param {Figure} figure
 * @param {Record<string, Look>} looks
 */
export function sliders(figure, looks) {
  return Object.keys(looks).map((key) => slider(figure, key));
}

/**
 * Radio buttons for a setting that is a word.
 *
 * @param {Figure} figure
 * @param {string} key
 * @param {Record<string, string>} labels of its words
 */
export function choices(figure, key, labels) {
  return radioGroup(wordsFor(figure, key).name, key, labels, figure.settings.told[key], (word) => figure.gesture.decide({ [key]: word }));
}

/**
 * @param {Figure} figure
 * @param {string} key of a setting that is true or false
 * @param {unknown} label
 */
export function check(figure, key, label) {
  return toggle({ label, checked: figure.settings.told[key], change: (on) => figure.gesture.decide({ [key]: on }) });
}

/**
 * Returns the two disclosures below a figure, and the buttons that copy a link to it and present it.
 *
 * @param {Figure} figure
 * @param {object} of
 * @param {() => unknown} of.controls needed less often than those in sight
 * @param {() => unknown} of.numbers tables and charts
 * @param {string | number} [of.mark] what tells the files of this state from those of another
 * @param {string} [of.csvTitle] what is in a CSV file, where that is no samples
 */
export function disclosures(figure, { controls, numbers, mark = figure.reading.config.seed, csvTitle }) {
  return html`<div class="folds">
    ${fold(words.moreControls, controls, 'more')}
    ${fold(words.numbersAndData, () => html`${numbers()} ${exportButtons(figure, mark, csvTitle)} ${figure.copies.codeButton()}`, 'numbers')}
    <div class="begin">${figure.copies.linkButton()} ${figure.presenting.button()}</div>
    ${figure.copies.answer('link')}
  </div>
  <p class="on-paper">${noiseOf(figure)}</p>`;
}

/** Returns the noise parameters with their values, for paper. @param {Figure} figure */
function noiseOf({ kind: { attributes, looks }, machine, settings: { told: config } }) {
  return Object.entries(looks).filter(([, { alpha }]) => alpha).flatMap(([key, { symbol = '', decimals }]) => {
    const value = /** @type {number | null} */ (/** @type {Setting} */ (attributes[key]).get({ config, machine }));
    return value === null ? [] : html`<span>${rich(`${symbol}\u00a0=\u00a0${typed(value, decimals)}`)}</span> `;
  });
}

/**
 * Returns a picture of the figure, with its title above.
 *
 * @param {unknown} title
 * @param {unknown} picture canvas with its handles
 * @param {string} [name] classes
 */
export function panel(title, picture, name) {
  return html`<figure class="panel ${name ?? ''}">
    <p class="panel-title">${title}</p>
    ${picture}
  </figure>`;
}

/**
 * Growth, seed and size of the cloud.
 *
 * @param {Figure & { cloud: import('./cloud.js').Cloud }} figure
 * @param {readonly number[]} counts the sizes that the slider offers
 */
export function cloudControls(figure, counts) {
  const { samples } = figure.settings.told;
  const { name, effect } = wordsFor(figure, 'samples');
  const last = counts.length - 1;
  const nearest = counts.findIndex((count) => count >= samples);
  return group(words.samples, html`${typeable(
      figure,
      'samples',
      'N',
      {
        id: 'samples',
        symbol: html`<i>N</i>`,
        name,
        // Beyond the last there is no index, and the thumb says so.
        value: nearest < 0 ? last + 1 : nearest,
        min: 0,
        max: last,
        step: 1,
        ends: [counts[0], counts[last]],
        show: (index) => counted(index === nearest || index > last ? samples : counts[index]),
        effect,
        role: 'truth',
        input: (index) => want(figure, 'samples', counts[index]),
        commit: () => figure.gesture.commit(),
      },
      (count) => want(figure, 'samples', count),
      counted,
    )}
    ${figure.cloud.buttons()}`, 'cloud');
}

/**
 * Field with the number of the marked sample. It keeps what was typed and is refused until it is right or left.
 *
 * @param {Figure & { cloud: import('./cloud.js').Cloud }} figure
 * @param {object} row
 * @param {string} row.id
 * @param {string} row.label
 * @param {number} row.shown number of samples
 * @param {unknown} row.told text about the marked sample; nothing where none is marked
 * @param {string} row.hint text where none is marked
 */
export function markedField({ cloud, typing }, { id, label, shown, told, hint }) {
  const refusal = typing.refusalOf('marked');
  const type = (/** @type {Event} */ event) => {
    const text = inputOf(event).value;
    const number = Number(text);
    if (text && !(Number.isInteger(number) && number >= 1 && number <= shown)) {
      typing.refuse('marked', words.refused(label, text.replace('-', '\u2212'), '1', counted(shown), true));
      return;
    }
    typing.forget();
    cloud.mark(number - 1);
  };
  return html`<p class="marked">
    <label>
      ${label}
      <input
        id=${id}
        type="number"
        min="1"
        max=${Math.max(1, shown)}
        placeholder=${shown === 0 ? '' : `1–${counted(shown)}`}
        ?disabled=${shown === 0}
        .value=${refusal ? noChange : live(cloud.index < 0 ? '' : String(cloud.index + 1))}
        @input=${type}
        @blur=${() => typing.forget()}
      />
    </label>
    <output for=${id} role=${refusal ? 'alert' : nothing}>${refusal || told || html`<span class="hint">${hint}</span>`}</output>
  </p>`;
}

/**
 * The reader wants another value of a setting, and may go on.
 *
 * @param {Figure} figure
 * @param {string} key
 * @param {unknown} value
 */
function want(figure, key, value) {
  const setting = /** @type {Setting} */ (figure.kind.attributes[key]);
  figure.settings.want((wanted) => setting.change(value, { config: wanted, machine: figure.machine }));
}

/**
 * @param {Figure} figure
 * @param {string} key of a setting that is a number
 * @returns {import('../settings.js').Declaration & { min: number, max: number }}
 */
function declarationOf(figure, key) {
  return /** @type {any} */ (figure.kind.declared.find((setting) => setting.key === key));
}

/** @param {Figure} figure */
function wordsOf(figure) {
  return /** @type {any} */ (words)[figure.kind.vocabulary];
}

/**
 * @param {Figure} figure
 * @param {string} key
 * @returns {{ name: string, effect?: string }} what has no effect explains itself
 */
function wordsFor(figure, key) {
  const [model, index] = figure.kind.looks[key]?.alpha ?? [];
  const ofAlpha = model && { name: words.alphas[model][/** @type {number} */ (index)] };
  return { .../** @type {any} */ (words.settings)[key], ...ofAlpha, ...wordsOf(figure).settings[key] };
}
