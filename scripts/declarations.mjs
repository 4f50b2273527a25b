// Declarations of the widgets for scripts/manifest.mjs and scripts/types.mjs: from the settings of
// the core, from each widget's settings.js, and from the comments of the elements' classes.

import { presets, settings } from '../www/settings.js';
import { scriptName } from './names.mjs';
import { ROOT, once } from './process.mjs';
import { importTypeScript } from './typescript.mjs';

/**
 * @typedef {import('../www/settings.js').Declaration} Declaration
 *
 * @typedef {object} Named
 * @property {string} name
 * @property {string} type in TypeScript
 * @property {string} description
 * @property {true} [readonly]
 * @property {boolean} [isText] true if a number can be given as text
 *
 * @typedef {Named & { property?: string, opening?: string, allowed?: string, withoutRange: string }} Attribute `property` is the
 *   name of its property if it differs, `opening` the text of its default, `allowed` the range of a number, and `withoutRange` the
 *   description without that range
 *
 * @typedef {object} Widget
 * @property {string} tag
 * @property {string} machine name of its class in the core; the class of its element has the suffix Element
 * @property {Attribute[]} attributes each of which is also a property
 * @property {Named[]} properties without an attribute
 * @property {Named[]} state fields of the state that only this widget has
 */

/** Types in TypeScript of settings other than words and groups. @type {Record<string, string>} */
const TYPES = { number: 'number', whole: 'number', boolean: 'boolean', numbers: 'number[]' };

/** Properties and state of every element with a cloud. @type {import('../www/figure/attributes.ts').Documentation} */
const OF_CLOUDS = {
  properties: {
    marked: { type: 'number | null', sentence: 'The sample that is marked, counted from 0.' },
    poses: { type: 'Float64Array | null', readonly: true, sentence: 'x, y (m), θ (rad) of each sample shown; a copy.' },
  },
  state: {
    shown: { type: 'number', sentence: 'Samples asked for so far, 0 to all of them.' },
    playing: { type: 'boolean', sentence: 'Whether the cloud is growing.' },
  },
};

/** Returns the name of the class or type for a tag or key. @param {string} name */
export const pascal = (name) => scriptName(name.replaceAll(/(?:^|-)(.)/g, (_, letter) => letter.toUpperCase()));

/** @param {readonly string[]} words */
export const union = (words) => words.map((word) => `'${word}'`).join(' | ');

/** @param {Declaration} declaration */
export function typeOf({ key, type, words, nullable }) {
  const text = words ? union(words) : (TYPES[type] ?? pascal(key));
  return nullable ? `${text} | null` : text;
}

/**
 * Returns the description of a setting: its meaning, its allowed values and its default.
 *
 * @param {Declaration} declaration
 * @param {string} [opening]
 */
export function describe(declaration, opening) {
  const { sentence, type } = declaration;
  const range = allowedIn(declaration);
  const kind = { whole: 'a whole number', numbers: 'each' }[/** @type {string} */ (type)] ?? '';
  const allowed = range && `${kind} from ${range}`.trim();
  const all = [allowed, opening && `opens with ${opening}`].filter(Boolean).join('; ');
  return all ? `${sentence} ${all[0].toUpperCase()}${all.slice(1)}.` : sentence;
}

/** @param {Declaration} declaration */
function allowedIn({ min, max, unit }) {
  return min === undefined || max === undefined ? undefined : `${number(min)} to ${number(max)}${unit ? ` ${unit}` : ''}`;
}

/** @param {number} value */
function number(value) {
  if (value === Number.MAX_SAFE_INTEGER) return '2⁵³ − 1';
  const format = new Intl.NumberFormat('en', { maximumSignificantDigits: 7, useGrouping: 'min2' });
  return format.format(value).replaceAll(',', '\u202f').replace('-', '−');
}

/** Returns the comments of the elements' classes by the names of the classes. */
export const comments = once(async () => {
  // @ts-expect-error It comes without types.
  const { cli } = await import('@custom-elements-manifest/analyzer/cli.js');
  // It writes nothing but, into package.json, where the manifest is: in dist.
  const argv = ['analyze', '--litelement', '--quiet', '--outdir', 'dist', '--globs', 'www/figure/figure.ts', 'www/widgets/*/*.ts'];
  const { schemaVersion, modules } = await cli({ argv, cwd: ROOT, noWrite: true });
  /** @type {any[]} */
  const declarations = modules.flatMap((/** @type {any} */ { declarations }) => declarations ?? []);
  return { schemaVersion, classes: new Map(declarations.map((each) => [each.name, each])) };
});

/** Returns a description without the line ends of its comment. @param {string} text */
export const oneLine = (text) => text.replaceAll('\n', ' ');

/** @returns {Promise<Widget[]>} */
export function widgets() {
  return Promise.all(Object.keys(settings).map(widget));
}

/** Returns the declarations of a widget. @param {string} tag @returns {Promise<Widget>} */
async function widget(tag) {
  // They import libraries, which a bare clone does not have yet.
  const { COMMON_ATTRS, NUMBER_CONVERTER: NUMBER, WORD_LIST_CONVERTER: WORD_LIST } = await importTypeScript('www/figure/attributes.ts');
  const { definition: { attributes, declared, own }, documentation } = await importTypeScript(`www/widgets/${tag}/settings.ts`);
  /** @type {import('../www/figure/attributes.ts').Documentation[]} */
  const documents = [...('marked' in own ? [OF_CLOUDS] : []), ...(documentation ? [documentation] : [])];
  const { classes } = await comments();
  const element = classes.get(`${pascal(tag)}Element`);
  /** @type {Record<string, string>} */
  const sentences = Object.fromEntries(element.attributes.map((/** @type {any} */ { name, description }) => [name, description]));
  const propertyTable = Object.assign({}, ...documents.map(({ properties }) => properties));
  const stateTable = Object.assign({}, ...documents.map(({ state }) => state));
  const setting = (/** @type {string} */ name) => declared.find((/** @type {Declaration} */ { key }) => key === name);

  /** @returns {Attribute} */
  const attribute = (/** @type {[string, any]} */ [name, entry]) => {
    const declaration = setting(name);
    if (declaration) {
      const given = declaration.default;
      const opening = given === null ? undefined : String(given);
      const shown = typeof given === 'number' ? number(given) : opening;
      const withoutRange = describe({ ...declaration, min: undefined }, shown);
      return { name, type: typeOf(declaration), description: describe(declaration, shown), opening, allowed: allowedIn(declaration), withoutRange };
    }
    const { words, covers, converter, property } = entry;
    const nullable = covers || entry.nullable;
    const opening = own[name]?.opening ?? (covers ? openingPreset(tag) : nullable ? undefined : words?.[0]);
    const type = converter === NUMBER ? 'number' : words === undefined ? 'boolean' : converter === WORD_LIST ? `(${union(words)})[]` : union(words);
    const text = Array.isArray(opening) ? opening.join(' ') : opening;
    const description = describe({ ...entry, sentence: sentences[name] }, text);
    return { name, property, type: nullable ? `${type} | null` : type, description, opening: text, allowed: allowedIn(entry), withoutRange: description };
  };
  const documented = (/** @type {[string, any]} */ [name, { sentence, ...rest }]) => ({ name, description: sentence, ...rest });

  const attributeList = Object.entries({ ...attributes, ...COMMON_ATTRS }).map(attribute);
  /** @type {Declaration[]} */
  const whole = declared.filter((/** @type {Declaration} */ declaration) => !declaration.in && !declaration.of);
  const groups = whole.filter(({ key }) => !(key in attributes)).map(plain);
  const ofClass = element.members
    .filter((/** @type {any} */ { kind, privacy, inheritedFrom }) => kind === 'field' && privacy === 'public' && !inheritedFrom)
    .map((/** @type {any} */ { name, description, readonly, type }) => ({ name, description: oneLine(description), readonly, type: type.text }));
  const properties = [...groups, ...Object.entries(propertyTable).map(documented), ...ofClass];
  const ofElement = Object.keys(own).map((name) => {
    const { type, description } = /** @type {Named} */ ([...attributeList, ...properties].find((each) => each.name === name) ?? {});
    return { name, type, description };
  });
  const state = new Map([...whole.map(plain), ...ofElement, ...Object.entries(stateTable).map(documented)].map((each) => [each.name, each]));
  for (const { name, type } of state.values()) if (!type) throw new Error(`${tag}: nothing says what ${name} is in its state.`);
  return { tag, machine: pascal(tag), attributes: attributeList, properties, state: [...state.values()] };
}

/** @param {Declaration} declaration */
function plain(declaration) {
  return { name: declaration.key, type: typeOf(declaration), description: describe(declaration) };
}

/** Returns the preset that the widget opens with, if there is one. @param {string} tag */
function openingPreset(tag) {
  const opening = Object.fromEntries(settings[tag].map(({ key, in: group, field, default: value }) => [field ? `${group}.${field}` : key, value]));
  /** @returns {boolean} */
  const same = (/** @type {object} */ fields, group = '') =>
    Object.entries(fields).every(
      ([key, value]) => key === 'name' || value === null || (typeof value === 'object' ? same(value, key) : value === (opening[`${group}.${key}`] ?? opening[key])),
    );
  return presetsOf(tag).find((preset) => same(preset))?.name;
}

/** Returns the presets of a widget. @param {string} tag @returns {(Record<string, unknown> & { name: string })[]} */
function presetsOf(tag) {
  return /** @type {Record<string, any[]>} */ (presets)[tag] ?? [];
}
