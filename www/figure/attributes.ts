/**
 * Attributes and the properties of the same names: those that follow from a widget's declared settings,
 * and how a text becomes a value and the other way round.
 */

import { includesFields, refusal, word } from './checks.ts';
import { THEMES } from './page/scheme.ts';
import type { Declaration } from '../settings.js';

export interface Kind {
  /** A text that means nothing is returned as it is, for whoever knows what is allowed to refuse. */
  parse: (text: string) => unknown;
  /** Null for no attribute. */
  print: (value: any) => string | null;
}

/** Settings of a machine, with changes that wait for it. */
export type Config = Record<string, any>;

/** Setting of the machine. */
export interface Setting {
  /** Null for none. */
  get: (config: Config) => unknown;
  /** The settings to make of it. */
  change: (value: any, config: Config) => Config;
  /** Name in the core, if it differs. */
  path?: string;
}

/** Something of the element itself, which has a property of that name. */
export interface Own {
  own: true;
  /** Opening where it is no part of the state. */
  opening?: unknown;
}

export interface Attribute {
  kind: Kind;
  /** Attributes that say what this one says by a text, and take over where it says nothing. */
  covers?: (text: string | null) => string[];
  /** Those that are allowed, where no declaration says it. */
  words?: readonly string[];
}

/** Attributes by name; what others depend on comes first. */
export type Attributes = Record<string, Attribute & (Setting | Own)>;

/** Table by name, with types in TypeScript. */
export type Table = Record<string, { type: string, readonly?: true, sentence: string }>;

/** Documentation of what neither a declaration nor the comments of a class say. */
export interface Documentation {
  /** Properties that have no attribute. */
  properties?: Table;
  /** Other fields of states. */
  state?: Table;
}

export const NUMBER: Kind = {
  parse: (text) => (text.trim() === '' || Number.isNaN(Number(text)) ? text : Number(text)),
  print: (value) => (value === null ? null : String(value)),
};

export const WORD: Kind = { parse: (text) => text, print: (value) => value };

/** Boolean attribute: true without a value, as in HTML. The value "false" makes it false, and another one is refused. */
const BOOLEAN: Kind = {
  parse: (text) => text !== 'false' && (text === '' || text === 'true' || text),
  print: String,
};

/** Words with spaces between them. */
export const WORDS: Kind = { parse: (text) => text.split(/\s/).filter(Boolean), print: (value) => value.join(' ') };

/** Conversions of the types that fit into an attribute. */
const KINDS: Record<string, Kind> = { number: NUMBER, whole: NUMBER, word: WORD, boolean: BOOLEAN };

/** Levels of headings in HTML. */
export const HEADING_LEVELS = ['1', '2', '3', '4', '5', '6'] as const;

/** Attributes of every figure. One that is missing stands for the first of its words, unless it may be null. */
export const COMMON: Record<string, { words?: readonly string[], nullable?: true, property?: string }> = {
  theme: { words: THEMES },
  share: {},
  presentation: {},
  'heading-level': { words: HEADING_LEVELS, nullable: true, property: 'headingLevel' },
};

export function isSetting(entry: Setting | Own): entry is Setting {
  return !('own' in entry);
}

/** The attributes of a widget's settings. */
export const attributesOf = (declared: Declaration[]) => settingsIn(declared, ({ type }) => type in KINDS);

/** The settings that are objects or arrays, and have a property alone. */
export const groupsOf = (declared: Declaration[]) => settingsIn(declared, ({ type }) => !(type in KINDS));

function settingsIn(declared: Declaration[], are: (setting: Declaration) => boolean) {
  return Object.fromEntries(declared.filter(are).map((setting) => [setting.key, settingOf(setting)]));
}

function settingOf({ key, in: group, field = key, index, of, weights = [], type }: Declaration): Attribute & Setting {
  const kind = KINDS[type];
  // The machine makes several numbers of it.
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

/** Returns the number that the last of several are shares of; null where they are of none. */
function levelOf(numbers: number[], weights: number[]): number | null {
  const last = numbers.slice(-weights.length);
  const level = last[0] / weights[0];
  return last.every((number, i) => number === level * weights[i]) ? level : null;
}

/** Settings that presets leave as they are. */
const KEPT_BY_PRESETS = ['samples', 'seed'];

/** Returns the configuration that a figure opens with: the defaults of its settings. */
function openingConfig(declared: Declaration[]) {
  const config: Record<string, any> = {};
  for (const { key, in: group, field = key, index, of, type, default: value } of declared) {
    if (group && index === undefined) config[group][field] = value;
    else if (!group && !of) config[key] = type === 'group' ? {} : value;
  }
  return config;
}

/**
 * Returns the attribute of a figure's presets. A preset sets every setting but the samples and the seed: what it does not list gets its default.
 *
 * @param presets each with a name and some settings, by keys of the declarations
 */
export function presetsOf(presets: readonly ({ name: string } & Record<string, any>)[], declared: Declaration[]): Attribute & Setting {
  const words = presets.map(({ name }) => name);
  const settings = presets.map(({ name: _, ...given }) => {
    const config = openingConfig(declared);
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
