/** Definition of a widget: its settings with their sliders, its properties and attributes, and the state of its element. */

import { presets, settings, type Declaration } from '../../build/settings.js';
import { checkNumber, checkWord, includesFields, type FieldRange } from '../data/checks.ts';
import type { PropertyDeclaration } from 'lit';
import type { LineStyle } from '../ui/theme.ts';
import type { SliderSpec } from './controls.ts';
import type { StateValues } from './settings.ts';

/** Lit's converter between attribute and property. It returns an invalid text unchanged, so that the check of the value refuses the text. */
interface AttributeConverter {
  fromAttribute: (attributeText: string | null) => unknown;
  /** Converts a value to a text; null removes the attribute. Without this function, the attribute is read but not written. */
  toAttribute?: (propertyValue: any) => string | null;
}

/** Reactive property of Lit whose value follows from the configuration. */
interface ElementProperty extends PropertyDeclaration {
  converter?: AttributeConverter;
  getValue: (settingValues: StateValues) => unknown;
  /** Returns the changes of the configuration that a new value of the property causes. */
  changesFor: (propertyValue: any, settingValues: StateValues) => StateValues;
  /** Name of the setting in errors of the core, if it differs from the property's name. */
  coreFieldPath?: string;
  /** Words that are allowed as values of the property, if the declaration of the setting does not list them. */
  words?: readonly string[];
}

/** Properties by name, in the order in which they are applied. */
type ElementProperties = Record<string, ElementProperty>;

/** Property that is written to its attribute. */
type ElementAttribute = ElementProperty & { converter: Required<AttributeConverter> };

const NUMBER_CONVERTER: AttributeConverter = {
  fromAttribute: (attributeText) => (attributeText?.trim() && !Number.isNaN(Number(attributeText)) ? Number(attributeText) : attributeText),
  toAttribute: (propertyValue) => (propertyValue === null ? null : String(propertyValue)),
};

/** Converter of lists of numbers, such as "0.1,0.2" or "[0.1, 0.2]". */
const NUMBERS_CONVERTER: AttributeConverter = {
  fromAttribute: (attributeText) => {
    const settingNumbers = attributeText?.match(/[^\s,[\]]+/g)?.map(Number);
    return settingNumbers?.every(Number.isFinite) ? settingNumbers : attributeText;
  },
};

const WORD_CONVERTER: Required<AttributeConverter> = { fromAttribute: (attributeText) => attributeText, toAttribute: (propertyValue) => propertyValue };

/** Converter of boolean attributes. Without a value they are true, as in HTML. The value "false" makes them false. Other values are refused. */
const BOOLEAN_CONVERTER: AttributeConverter = {
  fromAttribute: (attributeText) => attributeText !== 'false' && (attributeText === '' || attributeText === 'true' || attributeText),
  toAttribute: String,
};

/** Converter of lists of words, which are separated by spaces in the text. */
export const WORD_LIST_CONVERTER: AttributeConverter = { fromAttribute: (attributeText) => attributeText?.split(/\s/).filter(Boolean), toAttribute: (propertyValue) => propertyValue.join(' ') };

/** Converters by type of setting. A group of settings cannot be given as an attribute. */
const CONVERTERS_BY_TYPE: Record<string, AttributeConverter> = {
  number: NUMBER_CONVERTER, whole: NUMBER_CONVERTER, numbers: NUMBERS_CONVERTER, word: WORD_CONVERTER, words: WORD_LIST_CONVERTER, boolean: BOOLEAN_CONVERTER,
};

export const THEME_NAMES = ['auto', 'light', 'dark'] as const;

export const HEADING_LEVELS = ['1', '2', '3', '4', '5', '6'] as const;

/** Reactive property of Lit that every figure has. */
export interface CommonProperty extends PropertyDeclaration {
  words?: readonly string[];
  default: unknown;
}

/** Properties of every figure that are also attributes. */
export const COMMON_PROPERTIES: Record<string, CommonProperty> = {
  theme: { reflect: true, words: THEME_NAMES, default: 'auto' },
  share: { reflect: true, type: Boolean, default: false },
  presentation: { reflect: true, type: Boolean, default: false },
  headingLevel: { reflect: true, attribute: 'heading-level', words: HEADING_LEVELS, default: null },
};

/** Returns the checked value of a property that every figure has; null for the default. An empty text is true, as in HTML. */
export function checkCommonValue(propertyName: string, propertyValue: unknown, { words: allowedWords, type: propertyType }: CommonProperty) {
  if (propertyType === Boolean) return propertyValue === '' || Boolean(propertyValue);
  return allowedWords && (propertyValue ?? null) !== null ? checkWord(propertyName, String(propertyValue), allowedWords) : propertyValue;
}

export const propertiesOf = (settingDeclarations: Declaration[]): ElementProperties => Object.fromEntries(settingDeclarations.map((settingDeclaration) => [settingDeclaration.key, propertyOf(settingDeclaration)]));

export const selectAttributes = (elementProperties: ElementProperties) =>
  Object.fromEntries(Object.entries(elementProperties).filter(([, { attribute: attributeName, converter: attributeConverter }]) => attributeName !== false && attributeConverter?.toAttribute)) as Record<string, ElementAttribute>;

export const createFieldProperty = (settingKey: string, fieldType = ''): ElementProperty => ({ converter: CONVERTERS_BY_TYPE[fieldType], getValue: (settingValues) => settingValues[settingKey], changesFor: (propertyValue) => ({ [settingKey]: propertyValue }) });

function propertyOf({ key: settingKey, in: groupKey, field: fieldKey = settingKey, index, of: combinedKey, weights = [], type: fieldType, min: minValue = -Infinity, max: maxValue = Infinity }: Declaration): ElementProperty {
  const plainProperty = createFieldProperty(settingKey, fieldType);
  // This property is a common factor: the last numbers of the list setting named by `of` are this factor times the `weights`.
  if (combinedKey) {
    return {
      ...plainProperty,
      getValue: (settingValues) => commonFactorOf(settingValues[combinedKey], weights),
      changesFor: (commonFactor, { [combinedKey]: settingNumbers }) => {
        const scaledNumbers = weights.map((numberWeight) => numberWeight * checkNumber(settingKey, commonFactor, minValue, maxValue));
        return { [combinedKey]: [...settingNumbers.slice(0, -weights.length), ...scaledNumbers] };
      },
    };
  }
  if (!groupKey) return plainProperty;
  const memberKey = index ?? fieldKey;
  return {
    ...plainProperty,
    coreFieldPath: index !== undefined ? `${groupKey}[${index}]` : fieldKey === settingKey ? undefined : `${groupKey}.${fieldKey}`,
    getValue: (settingValues) => settingValues[groupKey][memberKey] ?? null,
    changesFor: (fieldValue, { [groupKey]: groupValue }) => ({ [groupKey]: Object.assign(index === undefined ? { ...groupValue } : [...groupValue], { [memberKey]: fieldValue }) }),
  };
}

/** Returns the factor f for which the last numbers of a list are f times their weights; null if there is no such factor. */
function commonFactorOf(settingNumbers: number[], weights: number[]): number | null {
  const lastNumbers = settingNumbers.slice(-weights.length);
  const commonFactor = lastNumbers[0] / weights[0];
  return lastNumbers.every((settingNumber, i) => settingNumber === commonFactor * weights[i]) ? commonFactor : null;
}

const KEYS_KEPT_BY_PRESETS = ['samples', 'seed'];

/** Returns the configuration that a figure opens with: the defaults of its settings. */
export function defaultConfigOf(settingDeclarations: Declaration[]): StateValues {
  return Object.fromEntries(settingDeclarations.filter((settingDeclaration) => !settingDeclaration.in && !settingDeclaration.of).map((settingDeclaration) => [settingDeclaration.key, settingDeclaration.default]));
}

/** Returns the attribute `preset`, which selects one of a figure's presets. A preset sets all settings except samples and seed. */
export function presetAttributeOf(widgetPresetList: readonly { name: string, settings: StateValues }[]): ElementAttribute {
  const presetNames = widgetPresetList.map(({ name: presetName }) => presetName);
  const presetSettings = widgetPresetList.map(({ settings: presetValues }) => Object.fromEntries(Object.entries(presetValues).filter(([settingKey]) => !KEYS_KEPT_BY_PRESETS.includes(settingKey))));
  return {
    converter: WORD_CONVERTER,
    words: presetNames,
    getValue: (settingValues) => presetNames[presetSettings.findIndex((presetValues) => includesFields(settingValues, presetValues))] ?? null,
    changesFor: (presetName) => presetSettings[presetNames.indexOf(checkWord('preset', presetName, presetNames))],
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
  maxInState?: (figureState: StateValues) => number;
}

export interface WidgetDefinition {
  widgetTag: string;
  messageKey: string;
  settingDeclarations: Declaration[];
  elementProperties: ElementProperties;
  attributes: Record<string, ElementAttribute>;
  /** Fields of the state that the element keeps, because the simulation does not have them. */
  elementFields: Record<string, ElementField>;
  elementDefaults: StateValues;
  sliderSpecs: Record<string, SliderSpec>;
  dependentDefaultsOf?: (settingValues: StateValues) => StateValues;
}

interface DefinitionOptions extends Pick<WidgetDefinition, 'messageKey' | 'sliderSpecs' | 'dependentDefaultsOf'> {
  /** Styles of the lines and marks in the pictures. The keys are the words of the attribute `overlays`. */
  overlayStyles: Record<string, LineStyle>;
  openingOverlays?: readonly string[];
  /** Attribute `preset` of a widget whose presets also depend on fields of the element. */
  presetAttribute?: ElementAttribute;
  /** State fields of the widget, in addition to those of overlays and cloud. */
  elementFields?: Record<string, ElementField>;
}

const CLOUD_FIELDS: Record<string, ElementField> = {
  /** True while the cloud grows. */
  playing: { type: 'boolean', default: false },
  /** Number of samples to show; Infinity for all, also if their number changes. */
  shown: { type: 'whole', default: Infinity, min: 0, maxInState: ({ samples }) => samples },
};

/** Index of the selected sample, for clouds of which the user can select a sample. */
export const SELECTION_FIELD: Record<string, ElementField> = {
  marked: { type: 'whole', default: null, nullable: true, min: 0, maxInState: ({ playing, samples, shown }) => (playing ? samples : shown) - 1, access: 'property' },
};

export function createDefinition(widgetTag: string, { overlayStyles, openingOverlays = Object.keys(overlayStyles), presetAttribute, elementFields: widgetFields, ...otherOptions }: DefinitionOptions): WidgetDefinition {
  const settingDeclarations = settings[widgetTag];
  const widgetPresets = presets[widgetTag as keyof typeof presets];
  const overlayNames = Object.keys(overlayStyles);
  const elementFields: Record<string, ElementField> = {
    ...(settingDeclarations.some(({ key: settingKey }) => settingKey === 'samples') && CLOUD_FIELDS),
    ...widgetFields,
    overlays: { type: 'words', words: overlayNames, default: openingOverlays, access: 'attribute' },
  };
  const elementProperties: ElementProperties = {
    ...(widgetPresets.length > 0 && { preset: presetAttribute ?? presetAttributeOf(widgetPresets) }),
    ...propertiesOf(settingDeclarations),
  };
  for (const [fieldName, { type: fieldType, words: fieldWords, access: pageAccess }] of Object.entries(elementFields)) {
    if (pageAccess) elementProperties[fieldName] = { ...createFieldProperty(fieldName, fieldType), attribute: pageAccess === 'attribute', words: fieldWords };
  }
  const elementDefaults = Object.fromEntries(Object.entries(elementFields).map(([fieldName, elementField]) => [fieldName, elementField.default]));
  return { ...otherOptions, widgetTag, settingDeclarations, elementProperties, attributes: selectAttributes(elementProperties), elementFields, elementDefaults };
}
