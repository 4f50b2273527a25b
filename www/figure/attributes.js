/**
 * Attributes and the properties of the same names: those that follow from a widget's declared settings,
 * and how a text becomes a value and the other way round.
 */

import { has, refusal, word } from './checks.js';
import { THEMES } from './page/scheme.js';

/**
 * @import { Declaration } from '../settings.js'
 *
 * @typedef {object} Kind
 * @property {(text: string) => unknown} parse a text that means nothing is returned as it is, for whoever
 *   knows what is allowed to refuse
 * @property {(value: any) => string | null} print null for no attribute
 *
 * @typedef {object} Present what a setting is read of, and changed from
 * @property {Record<string, any>} config the machine's settings, with changes that wait for it
 * @property {any} machine
 *
 * @typedef {object} Setting of the machine
 * @property {(present: Present) => unknown} get null for none
 * @property {(value: any, present: Present) => Record<string, unknown>} change the settings to make of it
 * @property {string} [path] what the core calls it, where that is not its own name
 *
 * @typedef {object} Own something of the element itself, which has a property of that name
 * @property {true} own
 * @property {unknown} [opening] where it is no part of the state
 *
 * @typedef {object} Attribute
 * @property {Kind} kind
 * @property {(text: string | null) => string[]} [covers] attributes that say what this one says by a text, and take over where
 *   it says nothing
 * @property {readonly string[]} [words] those that are allowed, where no declaration says it
 *
 * @typedef {Record<string, Attribute & (Setting | Own)>} Attributes by name; what others depend on comes first
 *
 * @typedef {Record<string, { type: string, readonly?: true, sentence: string }>} Table by name, with types in TypeScript
 *
 * @typedef {object} Documentation of what neither a declaration nor the comments of a class say
 * @property {Table} [properties] that have no attribute
 * @property {Table} [state] what is otherwise in states
 */

/** @type {Kind} */
export const NUMBER = {
  parse: (text) => (text.trim() === '' || Number.isNaN(Number(text)) ? text : Number(text)),
  print: (value) => (value === null ? null : String(value)),
};

/** @type {Kind} */
export const WORD = { parse: (text) => text, print: (value) => value };

/** Without a text it is true, as boolean attributes of HTML are; but "false" is false. @type {Kind} */
const TRUTH = {
  parse: (text) => text !== 'false' && (text === '' || text === 'true' || text),
  print: String,
};

/** Words with spaces between them. @type {Kind} */
export const WORDS = { parse: (text) => text.split(/\s/).filter(Boolean), print: (value) => value.join(' ') };

/** Of the types that fit into an attribute. @type {Record<string, Kind>} */
const KINDS = { number: NUMBER, whole: NUMBER, word: WORD, boolean: TRUTH };

/** Of headings in HTML. */
export const HEADING_LEVELS = /** @type {const} */ (['1', '2', '3', '4', '5', '6']);

/**
 * What every figure heeds besides. One that is not there says the first of its words, unless it may be null.
 *
 * @type {Record<string, { words?: readonly string[], nullable?: true, property?: string }>}
 */
export const COMMON = {
  theme: { words: THEMES },
  share: {},
  presentation: {},
  'heading-level': { words: HEADING_LEVELS, nullable: true, property: 'headingLevel' },
};

/**
 * @param {Setting | Own} entry
 * @returns {entry is Setting}
 */
export function isSetting(entry) {
  return !('own' in entry);
}

/** The attributes of a widget's settings. @param {Declaration[]} declared */
export const attributesOf = (declared) => settingsIn(declared, ({ type }) => type in KINDS);

/** The settings that are objects or arrays, and have a property alone. @param {Declaration[]} declared */
export const groupsOf = (declared) => settingsIn(declared, ({ type }) => !(type in KINDS));

/**
 * @param {Declaration[]} declared
 * @param {(setting: Declaration) => boolean} are
 */
function settingsIn(declared, are) {
  return Object.fromEntries(declared.filter(are).map((setting) => [setting.key, settingOf(setting)]));
}

/**
 * @param {Declaration} setting
 * @returns {Attribute & Setting}
 */
function settingOf({ key, in: group, field = key, index, of, type }) {
  const kind = KINDS[type];
  // One of several that stand for a setting of another form, which the machine makes of it.
  if (of) return { kind, get: ({ machine }) => machine[key], change: (value) => ({ [key]: value }) };
  if (!group) return { kind, get: ({ config }) => config[key], change: (value) => ({ [key]: value }) };
  if (index === undefined) {
    return {
      kind,
      path: field === key ? undefined : `${group}.${field}`,
      get: ({ config }) => config[group][field],
      change: (value, { config }) => ({ [group]: { ...config[group], [field]: value } }),
    };
  }
  return {
    kind,
    path: `${group}[${index}]`,
    get: ({ config }) => config[group][index] ?? null,
    change: (value, { config }) => {
      const { length } = config[group];
      if (index < length) return { [group]: config[group].with(index, value) };
      throw refusal(key, value, `none, as the last one at present is ${key.replace(/\d/, '')}${length}`);
    },
  };
}

/** Settings that presets leave as they are. */
const KEPT_BY_PRESETS = ['samples', 'seed'];

/**
 * Returns the configuration that a figure opens with: the defaults of its settings.
 *
 * @param {Declaration[]} declared
 */
function openingConfig(declared) {
  /** @type {Record<string, any>} */
  const config = {};
  for (const { key, in: group, field = key, index, of, type, default: value } of declared) {
    if (group && index === undefined) config[group][field] = value;
    else if (!group && !of) config[key] = type === 'group' ? {} : value;
  }
  return config;
}

/**
 * Returns the attribute of a figure's presets. A preset sets every setting but the samples and the seed: what it does not list gets its default.
 *
 * @param {readonly ({ name: string } & Record<string, any>)[]} presets each with a name and some settings, by keys of the declarations
 * @param {Declaration[]} declared
 * @returns {Attribute & Setting}
 */
export function presetsOf(presets, declared) {
  const words = presets.map(({ name }) => name);
  const settings = presets.map(({ name: _, ...given }) => {
    const config = openingConfig(declared);
    for (const [key, value] of Object.entries(given)) {
      const { in: group, field = key } = /** @type {Declaration} */ (declared.find((setting) => setting.key === key));
      (group ? config[group] : config)[field] = value;
    }
    return Object.fromEntries(Object.entries(config).filter(([key]) => !KEPT_BY_PRESETS.includes(key)));
  });
  const covered = Object.keys(attributesOf(declared)).filter((key) => !KEPT_BY_PRESETS.includes(key));
  return {
    kind: WORD,
    covers: () => covered,
    words,
    get: ({ config }) => words[settings.findIndex((each) => has(config, each))] ?? null,
    change: (name) => settings[words.indexOf(word('preset', name, words))],
  };
}
