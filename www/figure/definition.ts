/** Definition of a widget: its settings with their sliders, its properties and attributes, and the state of its element. */

import { presets, settings, type Declaration } from '../../build/settings.js';
import { checkNumber, checkWord, includesFields, type FieldRange } from '../data/checks.ts';
import type { PropertyDeclaration } from 'lit';
import type { LineStyle } from '../ui/theme.ts';
import type { SliderSpec } from './controls.ts';
import type { StateValues } from './settings.ts';

/** Converter of Lit that returns an invalid text unchanged, which the check of the value then refuses. */
interface AttributeConverter {
  fromAttribute: (text: string | null) => unknown;
  /** Converts a value to a text; null removes the attribute. Without this function, the attribute is read but not written. */
  toAttribute?: (value: any) => string | null;
}

/** Reactive property of Lit whose value follows from the configuration. */
interface Property extends PropertyDeclaration {
  converter?: AttributeConverter;
  get: (config: StateValues) => unknown;
  /** Returns the changed part of the configuration for a new value. */
  changesFor: (value: any, config: StateValues) => StateValues;
  /** Name of the setting in errors of the core, if it differs from the property's name. */
  corePath?: string;
  /** Words that are allowed as values of the property, if the declaration of the setting does not list them. */
  words?: readonly string[];
}

/** Properties by name, in the order in which they are applied. */
type Properties = Record<string, Property>;

/** Property that is written to its attribute. */
type Attribute = Property & { converter: Required<AttributeConverter> };

const NUMBER_CONVERTER: AttributeConverter = {
  fromAttribute: (text) => (text?.trim() && !Number.isNaN(Number(text)) ? Number(text) : text),
  toAttribute: (value) => (value === null ? null : String(value)),
};

/** Converter of lists of numbers, such as "0.1,0.2" or "[0.1, 0.2]". */
const NUMBERS_CONVERTER: AttributeConverter = {
  fromAttribute: (text) => {
    const numbers = text?.match(/[^\s,[\]]+/g)?.map(Number);
    return numbers?.every(Number.isFinite) ? numbers : text;
  },
};

const WORD_CONVERTER: Required<AttributeConverter> = { fromAttribute: (text) => text, toAttribute: (value) => value };

/** Converter of boolean attributes. Without a value they are true, as in HTML. The value "false" makes them false. Other values are refused. */
const BOOLEAN_CONVERTER: AttributeConverter = {
  fromAttribute: (text) => text !== 'false' && (text === '' || text === 'true' || text),
  toAttribute: String,
};

/** Converter of lists of words, which are separated by spaces in the text. */
export const WORD_LIST_CONVERTER: AttributeConverter = { fromAttribute: (text) => text?.split(/\s/).filter(Boolean), toAttribute: (value) => value.join(' ') };

/** Converters by type of setting. A group of settings cannot be given as an attribute. */
const CONVERTERS: Record<string, AttributeConverter> = {
  number: NUMBER_CONVERTER, whole: NUMBER_CONVERTER, numbers: NUMBERS_CONVERTER, word: WORD_CONVERTER, words: WORD_LIST_CONVERTER, boolean: BOOLEAN_CONVERTER,
};

export const THEMES = ['auto', 'light', 'dark'] as const;

export const HEADING_LEVELS = ['1', '2', '3', '4', '5', '6'] as const;

/** Reactive property of Lit that every figure has. */
export interface CommonProperty extends PropertyDeclaration {
  words?: readonly string[];
  default: unknown;
}

/** Properties of every figure that are also attributes. */
export const COMMON_PROPERTIES: Record<string, CommonProperty> = {
  theme: { reflect: true, words: THEMES, default: 'auto' },
  share: { reflect: true, type: Boolean, default: false },
  presentation: { reflect: true, type: Boolean, default: false },
  headingLevel: { reflect: true, attribute: 'heading-level', words: HEADING_LEVELS, default: null },
};

/** Returns the checked value of a property that every figure has; null for the default. An empty text is true, as in HTML. */
export function checkCommonValue(name: string, value: unknown, { words, type }: CommonProperty) {
  if (type === Boolean) return value === '' || Boolean(value);
  return words && (value ?? null) !== null ? checkWord(name, String(value), words) : value;
}

export const propertiesOf = (declarations: Declaration[]): Properties => Object.fromEntries(declarations.map((declaration) => [declaration.key, propertyOf(declaration)]));

export const selectAttributes = (properties: Properties) =>
  Object.fromEntries(Object.entries(properties).filter(([, { attribute, converter }]) => attribute !== false && converter?.toAttribute)) as Record<string, Attribute>;

export const createFieldProperty = (key: string, type = ''): Property => ({ converter: CONVERTERS[type], get: (config) => config[key], changesFor: (value) => ({ [key]: value }) });

function propertyOf({ key, in: group, field = key, index, of, weights = [], type, min = -Infinity, max = Infinity }: Declaration): Property {
  const plainProperty = createFieldProperty(key, type);
  // This property is a common factor: the last numbers of the list setting named by `of` are this factor times the `weights`.
  if (of) {
    return {
      ...plainProperty,
      get: (config) => commonFactorOf(config[of], weights),
      changesFor: (commonFactor, { [of]: numbers }) => {
        const scaledNumbers = weights.map((weight) => weight * checkNumber(key, commonFactor, min, max));
        return { [of]: [...numbers.slice(0, -weights.length), ...scaledNumbers] };
      },
    };
  }
  if (!group) return plainProperty;
  const memberKey = index ?? field;
  return {
    ...plainProperty,
    corePath: index !== undefined ? `${group}[${index}]` : field === key ? undefined : `${group}.${field}`,
    get: (config) => config[group][memberKey] ?? null,
    changesFor: (fieldValue, { [group]: groupValue }) => ({ [group]: Object.assign(index === undefined ? { ...groupValue } : [...groupValue], { [memberKey]: fieldValue }) }),
  };
}

/** Returns the factor f for which the last numbers of a list are f times their weights; null if there is no such factor. */
function commonFactorOf(numbers: number[], weights: number[]): number | null {
  const lastNumbers = numbers.slice(-weights.length);
  const commonFactor = lastNumbers[0] / weights[0];
  return lastNumbers.every((number, i) => number === commonFactor * weights[i]) ? commonFactor : null;
}

const KEYS_KEPT_BY_PRESETS = ['samples', 'seed'];

/** Returns the configuration that a figure opens with: the defaults of its settings. */
export function defaultConfigOf(declarations: Declaration[]): StateValues {
  return Object.fromEntries(declarations.filter((declaration) => !declaration.in && !declaration.of).map((declaration) => [declaration.key, declaration.default]));
}

/** Returns the attribute `preset`, which selects one of a figure's presets. A preset sets all settings except samples and seed. */
export function presetAttributeOf(presets: readonly { name: string, settings: StateValues }[]): Attribute {
  const presetNames = presets.map(({ name }) => name);
  const presetSettings = presets.map(({ settings }) => Object.fromEntries(Object.entries(settings).filter(([key]) => !KEYS_KEPT_BY_PRESETS.includes(key))));
  return {
    converter: WORD_CONVERTER,
    words: presetNames,
    get: (config) => presetNames[presetSettings.findIndex((settings) => includesFields(config, settings))] ?? null,
    changesFor: (name) => presetSettings[presetNames.indexOf(checkWord('preset', name, presetNames))],
  };
}

/** Field of the state that the element keeps, because the simulation does not have it. */
interface ElementField extends FieldRange {
  default: unknown;
  unit?: string;
  /** True if a preset sets the field to its default. */
  isResetByPreset?: true;
  /** Attribute or property by which a page sets the field. Without it, a page sets the field by `setState` only. */
  access?: 'attribute' | 'property';
  /** Returns the field's maximum for a state, if the maximum depends on other fields. */
  maxInState?: (state: StateValues) => number;
}

export interface WidgetDefinition {
  tag: string;
  messageKey: string;
  declarations: Declaration[];
  properties: Properties;
  attributes: Record<string, Attribute>;
  /** Fields of the state that the element keeps, because the simulation does not have them. */
  elementFields: Record<string, ElementField>;
  elementDefaults: StateValues;
  sliderSpecs: Record<string, SliderSpec>;
  dependentDefaultsOf?: (config: StateValues) => StateValues;
}

interface DefinitionOptions extends Pick<WidgetDefinition, 'messageKey' | 'sliderSpecs' | 'dependentDefaultsOf'> {
  /** Styles of the lines and marks in the pictures. The keys are the words of the attribute `overlays`. */
  overlayStyles: Record<string, LineStyle>;
  openingOverlays?: readonly string[];
  /** Attribute `preset`, if a preset also depends on fields of the element. */
  presetAttribute?: Attribute;
  /** State fields of the widget, in addition to those of overlays and cloud. */
  elementFields?: Record<string, ElementField>;
}

const CLOUD_FIELDS: Record<string, ElementField> = {
  /** True while the cloud grows. */
  playing: { type: 'boolean', default: false },
  /** Number of samples to show; Infinity for all, also if their number changes. */
  shown: { type: 'whole', default: Infinity, min: 0, maxInState: ({ samples }) => samples },
  /** Index of the selected sample. */
  marked: { type: 'whole', default: null, nullable: true, min: 0, maxInState: ({ playing, samples, shown }) => (playing ? samples : shown) - 1, access: 'property' },
};

export function createDefinition(tag: string, { overlayStyles, openingOverlays = Object.keys(overlayStyles), presetAttribute, elementFields: widgetFields, ...otherOptions }: DefinitionOptions): WidgetDefinition {
  const declarations = settings[tag];
  const widgetPresets = presets[tag as keyof typeof presets];
  const overlays = Object.keys(overlayStyles);
  const elementFields: Record<string, ElementField> = {
    ...(declarations.some(({ key }) => key === 'samples') && CLOUD_FIELDS),
    ...widgetFields,
    overlays: { type: 'words', words: overlays, default: openingOverlays, access: 'attribute' },
  };
  const properties: Properties = {
    ...(widgetPresets.length > 0 && { preset: presetAttribute ?? presetAttributeOf(widgetPresets) }),
    ...propertiesOf(declarations),
  };
  for (const [key, { type, words, access }] of Object.entries(elementFields)) {
    if (access) properties[key] = { ...createFieldProperty(key, type), attribute: access === 'attribute', words };
  }
  const elementDefaults = Object.fromEntries(Object.entries(elementFields).map(([key, field]) => [key, field.default]));
  return { ...otherOptions, tag, declarations, properties, attributes: selectAttributes(properties), elementFields, elementDefaults };
}
