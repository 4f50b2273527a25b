/** Attributes and properties derived from a widget's settings, and their conversion from and to text. */

import { includesFields, refusal, word } from './checks.ts';
import { THEMES } from './page/scheme.ts';
import type { Declaration } from '../settings.js';

export interface Kind {
  /** Returns an invalid text unchanged; the check of the value refuses it. */
  parse: (text: string) => unknown;
  /** Returns null for no attribute. */
  print: (value: any) => string | null;
}

/** Settings of a machine, with pending changes. */
export type Config = Record<string, any>;

/** Setting of the machine. */
export interface Setting {
  get: (config: Config) => unknown;
  /** Returns the settings to configure. */
  change: (value: any, config: Config) => Config;
  /** Name in the core, if different. */
  path?: string;
}

/** Property of the element itself. */
export interface Own {
  own: true;
  /** Default of a property that is not part of the state. */
  opening?: unknown;
  /** Range of a number, for its documentation. */
  min?: number;
  max?: number;
}

export interface Attribute {
  kind: Kind;
  /** Returns the names of attributes whose values follow from a text of this one. They are only written while this one has no text. */
  covers?: (text: string | null) => string[];
  /** Allowed words, if no declaration lists them. */
  words?: readonly string[];
}

/** Attributes by name, in the order in which they are applied. */
export type Attributes = Record<string, Attribute & (Setting | Own)>;

/** Documentation by name. Types are in TypeScript. */
export type Table = Record<string, { type: string, readonly?: true, sentence: string }>;

/** Documentation that is neither in a declaration nor in the comments of a class. */
export interface Documentation {
  /** Properties that have no attribute. */
  properties?: Table;
  /** Fields of the state that are neither settings nor attributes. */
  state?: Table;
}

export const NUMBER: Kind = {
  parse: (text) => (text.trim() === '' || Number.isNaN(Number(text)) ? text : Number(text)),
  print: (value) => (value === null ? null : String(value)),
};

export const WORD: Kind = { parse: (text) => text, print: (value) => value };

/** Boolean attribute. Without a value it is true, as in HTML. The value "false" makes it false. Other values are refused. */
const BOOLEAN: Kind = {
  parse: (text) => text !== 'false' && (text === '' || text === 'true' || text),
  print: String,
};

/** Words separated by spaces. */
export const WORD_LIST: Kind = { parse: (text) => text.split(/\s/).filter(Boolean), print: (value) => value.join(' ') };

/** Conversions of the types that fit into an attribute. */
const KINDS: Record<string, Kind> = { number: NUMBER, whole: NUMBER, word: WORD, boolean: BOOLEAN };

/** Levels of headings in HTML. */
export const HEADING_LEVELS = ['1', '2', '3', '4', '5', '6'] as const;

/** Attributes of every figure. The default is the first word, or null if `nullable`. */
export const COMMON: Record<string, { words?: readonly string[], nullable?: true, property?: string }> = {
  theme: { words: THEMES },
  share: {},
  presentation: {},
  'heading-level': { words: HEADING_LEVELS, nullable: true, property: 'headingLevel' },
};

export const isSetting = (entry: Setting | Own): entry is Setting => !('own' in entry);

export const attributesOf = (declared: Declaration[]) => settingsIn(declared, ({ type }) => type in KINDS);

/** Returns the settings that are objects or arrays, which have no attribute. */
export const groupsOf = (declared: Declaration[]) => settingsIn(declared, ({ type }) => !(type in KINDS));

const settingsIn = (declared: Declaration[], includes: (setting: Declaration) => boolean) =>
  Object.fromEntries(declared.filter(includes).map((setting) => [setting.key, settingOf(setting)]));

function settingOf({ key, in: group, field = key, index, of, weights = [], type }: Declaration): Attribute & Setting {
  const kind = KINDS[type];
  // This setting is a level, which scales several settings of the machine.
  if (of) return { kind, get: (config) => levelOf(config[of], weights), change: (value) => ({ [key]: value }) };
  if (!group) return { kind, get: (config) => config[key], change: (value) => ({ [key]: value }) };
  if (index === undefined) {
    return {
      kind,
      path: field === key ? undefined : `${group}.${field}`,
      get: (config) => config[group][field],
      change: (value, config) => ({ [group]: { ...config[group], [field]: value } }),
    };
  }
  return {
    kind,
    path: `${group}[${index}]`,
    get: (config) => config[group][index] ?? null,
    change: (value, config) => {
      const { length } = config[group];
      if (index < length) return { [group]: config[group].with(index, value) };
      throw refusal(key, value, `none, as the last one at present is ${key.replace(/\d/, '')}${length}`);
    },
  };
}

/** Returns the common factor of the last numbers and their weights; null if there is none. */
function levelOf(numbers: number[], weights: number[]): number | null {
  const last = numbers.slice(-weights.length);
  const level = last[0] / weights[0];
  return last.every((number, i) => number === level * weights[i]) ? level : null;
}

/** Settings that presets leave as they are. */
const KEPT_BY_PRESETS = ['samples', 'seed'];

/** Returns the configuration that a figure opens with: the defaults of its settings. */
export function defaultConfig(declared: Declaration[]) {
  const config: Record<string, any> = {};
  for (const { key, in: group, field = key, index, of, type, default: value } of declared) {
    if (group && index === undefined) config[group][field] = value;
    else if (!group && !of) config[key] = type === 'group' ? {} : value;
  }
  return config;
}

/** Returns the attribute of a figure's presets. A preset sets all settings except samples and seed. Settings that it does not list get defaults. */
export function presetsOf(presets: readonly ({ name: string } & Record<string, any>)[], declared: Declaration[]): Attribute & Setting {
  const words = presets.map(({ name }) => name);
  const settings = presets.map(({ name: _, ...given }) => {
    const config = defaultConfig(declared);
    for (const [key, value] of Object.entries(given)) {
      const { in: group, field = key } = declared.find((setting) => setting.key === key) as Declaration;
      (group ? config[group] : config)[field] = value;
    }
    return Object.fromEntries(Object.entries(config).filter(([key]) => !KEPT_BY_PRESETS.includes(key)));
  });
  const covered = Object.keys(attributesOf(declared)).filter((key) => !KEPT_BY_PRESETS.includes(key));
  return {
    kind: WORD,
    covers: () => covered,
    words,
    get: (config) => words[settings.findIndex((each) => includesFields(config, each))] ?? null,
    change: (name) => settings[words.indexOf(word('preset', name, words))],
  };
}
