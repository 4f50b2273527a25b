/** Attributes and properties derived from a widget's settings, and their conversion from and to text. */

import { checkedNumber, includesFields, checkedWord } from './checks.ts';
import type { Declaration } from '../settings.js';
import type { Values } from './settings.ts';

/** Conversion of a value from and to the text of an attribute. */
export interface Converter {
  /** Converts a text to a value. Returns an invalid text unchanged, which the check of the value then refuses. */
  parse: (text: string) => unknown;
  /** Converts a value to a text; null removes the attribute. */
  print: (value: any) => string | null;
}

export interface Property {
  /** Conversion of a property that is also an attribute. */
  converter?: Converter;
  get: (config: Values) => unknown;
  /** Returns the changed part of the configuration for a new value. */
  change: (value: any, config: Values) => Values;
  /** Name of a setting in the core, if different. */
  path?: string;
  /** Names of the attributes that this one determines, as a preset does. They are written only while this attribute has no value. */
  coveredAttributes?: string[];
  /** Allowed words, if the declarations of www/settings.js do not list them. */
  words?: readonly string[];
  /** Range of a number, if the declarations do not have it. */
  min?: number;
  max?: number;
}

/** Properties by name, in the order in which they are applied. */
export type Properties = Record<string, Property>;

export type Attribute = Property & { converter: Converter };

/** Documentation by name. Types are in TypeScript. */
export type DocumentationTable = Record<string, { type: string, readonly?: true, sentence: string }>;

/** Documentation that is neither in a declaration nor in the comments of a class. */
export interface Documentation {
  /** Properties that have no attribute. */
  properties?: DocumentationTable;
  /** Fields of the state that are neither settings nor attributes. */
  state?: DocumentationTable;
}

export const NUMBER_CONVERTER: Converter = {
  parse: (text) => (text.trim() === '' || Number.isNaN(Number(text)) ? text : Number(text)),
  print: (value) => (value === null ? null : String(value)),
};

export const WORD_CONVERTER: Converter = { parse: (text) => text, print: (value) => value };

/** Boolean attribute. Without a value it is true, as in HTML. The value "false" makes it false. Other values are refused. */
const BOOLEAN_CONVERTER: Converter = {
  parse: (text) => text !== 'false' && (text === '' || text === 'true' || text),
  print: String,
};

/** Conversion of a list of words, which are separated by spaces in the text. */
export const WORD_LIST_CONVERTER: Converter = { parse: (text) => text.split(/\s/).filter(Boolean), print: (value) => value.join(' ') };

/** Conversions of the types that fit into an attribute. Objects and arrays have none. */
const CONVERTERS: Record<string, Converter> = { number: NUMBER_CONVERTER, whole: NUMBER_CONVERTER, word: WORD_CONVERTER, boolean: BOOLEAN_CONVERTER };

export const THEMES = ['auto', 'light', 'dark'] as const;

export const HEADING_LEVELS = ['1', '2', '3', '4', '5', '6'] as const;

/** Attributes of every figure. The default is the first word, or null if `nullable`. */
export const COMMON_ATTRS: Record<string, { words?: readonly string[], nullable?: true, property?: string }> = {
  theme: { words: THEMES },
  share: {},
  presentation: {},
  'heading-level': { words: HEADING_LEVELS, nullable: true, property: 'headingLevel' },
};

export const propertiesOf = (declarations: Declaration[]): Properties => Object.fromEntries(declarations.map((setting) => [setting.key, propertyOf(setting)]));

export const selectAttributes = (properties: Properties) =>
  Object.fromEntries(Object.entries(properties).filter(([, { converter }]) => converter)) as Record<string, Attribute>;

export const fieldProperty = (key: string, converter?: Converter): Property => ({ converter, get: (config) => config[key], change: (value) => ({ [key]: value }) });

function propertyOf({ key, in: group, field = key, index, of, weights = [], type, min = -Infinity, max = Infinity }: Declaration): Property {
  const plainProperty = fieldProperty(key, CONVERTERS[type]);
  // The property is a factor: the last numbers of the array `of` are the `weights` times that factor.
  if (of) {
    return {
      ...plainProperty,
      get: (config) => commonFactorOf(config[of], weights),
      change: (level, { [of]: numbers }) => {
        const scaledNumbers = weights.map((weight) => weight * checkedNumber(key, level, min, max));
        return { [of]: [...numbers.slice(0, -weights.length), ...scaledNumbers] };
      },
    };
  }
  if (!group) return plainProperty;
  const memberKey = index ?? field;
  return {
    ...plainProperty,
    path: index !== undefined ? `${group}[${index}]` : field === key ? undefined : `${group}.${field}`,
    get: (config) => config[group][memberKey] ?? null,
    change: (value, { [group]: groupValue }) => ({ [group]: Object.assign(index === undefined ? { ...groupValue } : [...groupValue], { [memberKey]: value }) }),
  };
}

/** Returns the factor by which the last numbers are multiples of their weights; null if there is none. */
function commonFactorOf(numbers: number[], weights: number[]): number | null {
  const lastNumbers = numbers.slice(-weights.length);
  const commonFactor = lastNumbers[0] / weights[0];
  return lastNumbers.every((number, i) => number === commonFactor * weights[i]) ? commonFactor : null;
}

const KEPT_BY_PRESETS = ['samples', 'seed'];

/** Returns the configuration that a figure opens with: the defaults of its settings. */
export function defaultConfig(declarations: Declaration[]) {
  let config: Values = {};
  for (const setting of declarations) {
    if (!setting.of) config = { ...config, ...propertyOf(setting).change(setting.type === 'group' ? {} : setting.default, config) };
  }
  return config;
}

/** Returns the attribute of a figure's presets. A preset sets all settings except samples and seed. Settings that it does not list get defaults. */
export function presetPropertyOf(presets: readonly ({ name: string } & Record<string, any>)[], declarations: Declaration[]): Attribute {
  const presetNames = presets.map(({ name }) => name);
  const properties = propertiesOf(declarations);
  const presetSettings = presets.map(({ name: _, ...presetValues }) => {
    const presetConfig = Object.entries(presetValues).reduce((config, [key, value]) => ({ ...config, ...properties[key].change(value, config) }), defaultConfig(declarations));
    return Object.fromEntries(Object.entries(presetConfig).filter(([key]) => !KEPT_BY_PRESETS.includes(key)));
  });
  return {
    converter: WORD_CONVERTER,
    coveredAttributes: Object.keys(selectAttributes(properties)).filter((key) => !KEPT_BY_PRESETS.includes(key)),
    words: presetNames,
    get: (config) => presetNames[presetSettings.findIndex((settings) => includesFields(config, settings))] ?? null,
    change: (name) => presetSettings[presetNames.indexOf(checkedWord('preset', name, presetNames))],
  };
}
