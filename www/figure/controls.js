/** A setting's control, made of its declaration, of how it looks, and of the words for it. */

import { html } from 'lit';
import { words } from '../messages/registry.js';
import { radioGroup, rich, sliderRow, toggle } from '../ui/controls.js';
import { counted, fixed } from '../ui/format.js';
import { exportMenu } from './takeaway/export.js';

/**
 * @import { Setting } from './attributes.js'
 * @import { Figure } from './figure.js'
 *
 * @typedef {object} Look what the eye needs of a setting that is a number
 * @property {string} symbol as in the book, in the marks of messages
 * @property {'prior' | 'prediction' | 'truth'} role
 * @property {number} min of the slider, within what is allowed
 * @property {number} max
 * @property {number} step
 * @property {number} decimals
 * @property {(config: any) => number} [value] where several may be shown as one
 *
 * @typedef {Partial<Parameters<typeof sliderRow>[0]>} Row
 */

/**
 * @param {Figure} figure
 * @param {string} key of a setting
 * @param {Row} [otherwise] what is not as in every row
 */
export function slider(figure, key, otherwise) {
  const { looks, declared, attributes } = figure.kind;
  const { symbol, decimals, value, ...look } = looks[key];
  const { name, effect } = wordsFor(figure, key);
  const { unit } = declared.find((setting) => setting.key === key) ?? {};
  const { config } = figure.reading;
  const setting = /** @type {Setting} */ (attributes[key]);
  return sliderRow({
    ...look,
    id: key,
    symbol: rich(symbol),
    name,
    value: value ? value(config) : /** @type {number} */ (setting.get({ config, machine: figure.machine })),
    show: (shown) => fixed(shown, decimals) + (unit ? ` ${unit}` : ''),
    effect: effect && rich(effect),
    input: (number) => want(figure, key, number),
    commit: () => figure.commit(),
    ...otherwise,
  });
}

/**
 * A picture's canvas, on which the pointer marks samples.
 *
 * @param {Figure} figure
 * @param {import('../scene/picture.js').Picture<any>} picture
 * @param {string} description what it shows, in words
 */
export function canvas(figure, picture, description) {
  const point = (/** @type {PointerEvent} */ event) => figure.cloud?.point(picture, event);
  return html`<canvas
    class=${picture.name}
    role="img"
    aria-label=${description}
    @pointermove=${point}
    @click=${point}
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
  return radioGroup(wordsFor(figure, key).name ?? '', key, labels, figure.reading.config[key], (word) => figure.decide({ [key]: word }));
}

/**
 * @param {Figure} figure
 * @param {string} key of a setting that is true or false
 * @param {unknown} label
 */
export function check(figure, key, label) {
  return toggle({ label, checked: figure.reading.config[key], change: (on) => figure.decide({ [key]: on }) });
}

/** What may be taken along of a figure, in folds. @param {Figure} figure */
export function takeAlong(figure) {
  return html`${exportMenu(figure, figure.reading.config.seed)} ${figure.copies.render()}`;
}

/**
 * Growth, seed and size of the cloud.
 *
 * @param {Figure} figure
 * @param {readonly number[]} counts the sizes that the slider offers
 */
export function cloudControls(figure, counts) {
  const { samples } = figure.reading.config;
  const { cloud: say } = wordsOf(figure);
  const { name, effect } = wordsFor(figure, 'samples');
  const above = counts.findIndex((count) => count >= samples);
  const nearest = above < 0 ? counts.length - 1 : above;
  return html`<fieldset class="cloud">
    <legend class="visually-hidden">${say.legend}</legend>
    ${sliderRow({
      id: 'samples',
      symbol: html`<i>N</i>`,
      name,
      value: nearest,
      min: 0,
      max: counts.length - 1,
      step: 1,
      show: (index) => counted(index === nearest ? samples : counts[index]),
      effect,
      role: 'truth',
      input: (index) => want(figure, 'samples', counts[index]),
      commit: () => figure.commit(),
    })}
    ${figure.cloud?.buttons(say)}
  </fieldset>`;
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

/** @param {Figure} figure */
function wordsOf(figure) {
  return /** @type {any} */ (words)[figure.kind.vocabulary];
}

/**
 * @param {Figure} figure
 * @param {string} key
 * @returns {{ name?: string, effect?: string }}
 */
function wordsFor(figure, key) {
  return { .../** @type {any} */ (words.settings)[key], ...wordsOf(figure).settings[key] };
}
