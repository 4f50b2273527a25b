/** Definition of a widget: its settings with their sliders, its properties and attributes, and the state of its element. */

import { presets, settings, type Declaration } from '../settings.js';
import { NUMBER_CONVERTER, WORD_LIST_CONVERTER, selectAttributes, fieldProperty, presetPropertyOf, propertiesOf, type Attribute, type Properties, type Property } from './attributes.ts';
import { checkedNumber, checkedSubset, checkedInteger, checkedWord } from './checks.ts';
import type { SliderSpec } from './controls.ts';
import type { LineStyle } from '../scene/draw.ts';
import type { Values } from './settings.ts';

/** Field of the state that the element keeps, because the simulation does not have it. */
export interface ElementField extends Pick<Property, 'converter' | 'words' | 'min' | 'max'> {
  opening: unknown;
  /** True if a preset sets the field to its default. */
  isResetByPreset?: true;
  /** True if the field is a property, but not an attribute. */
  isProperty?: true;
  /** Returns a value after a check; throws if it is invalid. An attribute is checked by its words or its range. */
  check?: (field: string, value: any, selectableCount: number) => any;
}

export interface Definition {
  tag: string;
  messageKey: string;
  declarations: Declaration[];
  properties: Properties;
  attributes: Record<string, Attribute>;
  /** Fields of the state that the element keeps, because the simulation does not have them. */
  elementFields: Record<string, ElementField>;
  sliderSpecs: Record<string, SliderSpec>;
  dependentDefaults?: (config: Values) => Values;
}

interface DefinitionOptions extends Pick<Definition, 'messageKey' | 'sliderSpecs' | 'dependentDefaults'> {
  /** Styles of the lines and marks in the pictures. The keys are the words of the attribute `overlays`. */
  lines: Record<string, LineStyle>;
  opening?: readonly string[];
  /** Attribute of the presets, if it depends on more than the settings. */
  preset?: Attribute;
  /** State fields of the widget, in addition to those of overlays and cloud. */
  elementFields?: Record<string, ElementField>;
}

const cloudFields: Record<string, ElementField> = {
  marked: {
    opening: null,
    isProperty: true,
    check: (field, marked, selectableCount) => (marked === null ? null : checkedInteger(field, marked, 0, selectableCount - 1)),
  },
};

export function definitionOf(tag: string, { lines, opening = Object.keys(lines), preset, elementFields: widgetFields, ...otherOptions }: DefinitionOptions): Definition {
  const declarations = settings[tag];
  const widgetPresets = presets[tag as keyof typeof presets];
  const elementFields: Record<string, ElementField> = {
    ...(declarations.some(({ key }) => key === 'samples') && cloudFields),
    ...widgetFields,
    overlays: { converter: WORD_LIST_CONVERTER, words: Object.keys(lines), opening },
  };
  const properties: Properties = {
    ...(widgetPresets.length > 0 && { preset: preset ?? presetPropertyOf(widgetPresets, declarations) }),
    ...propertiesOf(declarations),
  };
  for (const [key, { converter, isProperty, words, min, max }] of Object.entries(elementFields)) {
    if (converter || isProperty) properties[key] = { ...fieldProperty(key, converter), words, min, max };
  }
  return { ...otherOptions, tag, declarations, properties, attributes: selectAttributes(properties), elementFields };
}

/** Returns a value for a field of the state of the element after a check; throws a TypeError or RangeError if it is invalid. */
export function validatedValue({ converter, words = [], min = -Infinity, max = Infinity, check }: ElementField, field: string, value: unknown, selectableCount: number) {
  if (check) return check(field, value, selectableCount);
  if (converter === NUMBER_CONVERTER) return checkedNumber(field, value, min, max);
  return converter === WORD_LIST_CONVERTER ? checkedSubset(field, value, words) : checkedWord(field, value, words);
}
