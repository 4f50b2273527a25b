// What the widgets declare of themselves, as scripts/manifest.mjs and scripts/types.mjs tell it: from the settings of
// the core, and from each widget's settings.js.

import { presets, settings } from '../www/settings.js';

/**
 * @typedef {import('../www/settings.js').Declaration} Declaration
 *
 * @typedef {object} Named
 * @property {string} name
 * @property {string} type in TypeScript
 * @property {string} description
 * @property {true} [readonly]
 * @property {string} [opening] the text of an attribute when the widget opens
 *
 * @typedef {object} Widget
 * @property {string} tag
 * @property {string} machine its class in the core; that of its element ends in Element
 * @property {Named[]} attributes each of them is a property too
 * @property {Named[]} properties the others
 * @property {Named[]} state without what every state has
 */

/** Of the settings that are no words and no groups. @type {Record<string, string>} */
const TYPES = { number: 'number', whole: 'number', boolean: 'boolean', numbers: 'number[]' };

/** @param {string} name of a tag or key */
export const pascal = (name) => name.replaceAll(/(?:^|-)(.)/g, (_, letter) => letter.toUpperCase());

/** @param {readonly string[]} words */
export const union = (words) => words.map((word) => `'${word}'`).join(' | ');

/** @param {Declaration} declaration */
export function typeOf({ key, type, words, nullable }) {
  const text = words ? union(words) : (TYPES[type] ?? pascal(key));
  return nullable ? `${text} | null` : text;
}

/**
 * What a setting is, and what it may be.
 *
 * @param {Declaration} declaration
 * @param {string} [opening]
 */
export function describe({ sentence, type, min, max, unit }, opening) {
  const kind = { whole: 'A whole number from', numbers: 'Each from' }[/** @type {string} */ (type)] ?? 'From';
  const range = min === undefined || max === undefined ? [] : [`${kind} ${number(min)} to ${number(max)}${unit ? ` ${unit}` : ''}`];
  if (opening !== undefined) range.push(range.length ? `opens with ${opening}` : `Opens with ${opening}`);
  return [sentence, ...(range.length ? [`${range.join('; ')}.`] : [])].join(' ');
}

/** @param {number} value */
function number(value) {
  if (value === Number.MAX_SAFE_INTEGER) return '2⁵³ − 1';
  const format = new Intl.NumberFormat('en', { maximumSignificantDigits: 7, useGrouping: 'min2' });
  return format.format(value).replaceAll(',', '\u202f').replace('-', '−');
}

/** @returns {Promise<Widget[]>} */
export function widgets() {
  return Promise.all(Object.keys(settings).map(widget));
}

/**
 * @param {string} tag
 * @returns {Promise<Widget>}
 */
async function widget(tag) {
  // They import libraries, which a bare clone does not have yet.
  const { COMMON, WORDS, documentation: ofFigures } = await import('../www/figure/attributes.js');
  const { documentation: ofClouds } = await import('../www/figure/cloud.js');
  const { attributes, declared, documentation, own } = await import(`../www/widgets/${tag}/settings.js`);
  /** @type {import('../www/figure/attributes.js').Documentation[]} */
  const documents = [ofFigures, ...('marked' in own ? [ofClouds] : []), documentation];
  /** @type {Record<string, string>} */
  const sentences = Object.assign({}, ...documents.map(({ attributes }) => attributes));
  const propertyTable = Object.assign({}, ...documents.map(({ properties }) => properties));
  const stateTable = Object.assign({}, ...documents.map(({ state }) => state));
  const setting = (/** @type {string} */ name) => declared.find((/** @type {Declaration} */ { key }) => key === name);

  /** @returns {Named} */
  const attribute = (/** @type {[string, any]} */ [name, entry]) => {
    const declaration = setting(name);
    if (declaration) {
      const given = declaration.default;
      const opening = given === null ? undefined : String(given);
      return { name, type: typeOf(declaration), description: describe(declaration, typeof given === 'number' ? number(given) : opening), opening };
    }
    const { words, covers, kind } = entry;
    const opening = entry.opening ?? own[name]?.opening ?? (covers && openingPreset(tag));
    const type = words === undefined ? 'boolean' : kind === WORDS ? `(${union(words)})[]` : union(words);
    const text = Array.isArray(opening) ? opening.join(' ') : opening;
    return { name, type: covers ? `${type} | null` : type, description: describe({ ...entry, sentence: sentences[name] }, text), opening: text };
  };
  const told = (/** @type {[string, any]} */ [name, { sentence, ...rest }]) => ({ name, description: sentence, ...rest });

  const attributeList = Object.entries({ ...attributes, ...COMMON }).map(attribute);
  /** @type {Declaration[]} */
  const whole = declared.filter((/** @type {Declaration} */ declaration) => !declaration.in && !declaration.of);
  const groups = whole.filter(({ key }) => !(key in attributes)).map(plain);
  const properties = [...groups, ...Object.entries(propertyTable).map(told)];
  const ofElement = Object.keys(own).map((name) => {
    const { type, description } = /** @type {Named} */ ([...attributeList, ...properties].find((each) => each.name === name) ?? {});
    return { name, type, description };
  });
  const state = new Map([...whole.map(plain), ...ofElement, ...Object.entries(stateTable).map(told)].map((each) => [each.name, each]));
  for (const { name, type } of state.values()) if (!type) throw new Error(`${tag}: nothing says what ${name} is in its state.`);
  return { tag, machine: pascal(tag), attributes: attributeList, properties, state: [...state.values()] };
}

/** @param {Declaration} declaration */
function plain(declaration) {
  return { name: declaration.key, type: typeOf(declaration), description: describe(declaration) };
}

/**
 * The preset that the widget opens with, if it is one.
 *
 * @param {string} tag
 */
function openingPreset(tag) {
  const opening = Object.fromEntries(settings[tag].map(({ key, default: value }) => [key, value]));
  /** @returns {boolean} */
  const same = (/** @type {object} */ fields) =>
    Object.entries(fields).every(([key, value]) => key === 'name' || (typeof value === 'object' ? same(value) : value === opening[key]));
  return presetsOf(tag).find(same)?.name;
}

/**
 * @param {string} tag
 * @returns {(Record<string, unknown> & { name: string })[]}
 */
export function presetsOf(tag) {
  return /** @type {Record<string, any[]>} */ (presets)[tag] ?? [];
}
