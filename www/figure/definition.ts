/** Definition of a widget: its settings with their sliders, its attributes, and the state of its element. */

import { presets, settings, type Declaration } from '../settings.js';
import { WORD_LIST, attributesOf, presetsOf, type Attributes, type Config } from './attributes.ts';
import { subset, wholeNumber } from './checks.ts';
import type { Look } from './controls.ts';
import type { LineStyle } from './overlays.ts';
import type { Owned } from './state.ts';

export interface Definition {
  /** Key of the widget's words in the catalogues. */
  vocabulary: string;
  /** Declared settings. */
  declared: Declaration[];
  attributes: Attributes;
  /** State of the element that the machine does not have. */
  own: Record<string, Owned>;
  /** Appearance of the settings that have a slider. */
  looks: Record<string, Look>;
  /** Returns the defaults that depend on other settings. */
  dependentDefaults?: (config: Config) => Config;
}

interface Parts extends Pick<Definition, 'vocabulary' | 'looks' | 'dependentDefaults'> {
  /** Styles of the lines and marks in the pictures, which are the words of the attribute `overlays`. */
  lines: Record<string, LineStyle>;
  /** Lines that are drawn by default. */
  opening?: readonly string[];
  /** Attributes besides those of settings, presets and overlays. */
  attributes?: Attributes;
  /** State besides that of the overlays and the cloud. */
  own?: Record<string, Owned>;
}

/** State of an element with samples. */
const cloudState: Record<string, Owned> = {
  marked: {
    opening: null,
    check: (field, marked, machine, selectableCount) => (marked === null ? null : wholeNumber(field, marked, 0, selectableCount - 1)),
  },
};

/** Returns the definition of a widget by its tag. */
export function definitionOf(tag: string, { lines, opening = Object.keys(lines), attributes, own, ...parts }: Parts): Definition {
  const declared = settings[tag];
  const widgetPresets = presets[tag as keyof typeof presets];
  const lineNames = Object.keys(lines);
  return {
    ...parts,
    declared,
    attributes: {
      ...(widgetPresets.length > 0 && { preset: presetsOf(widgetPresets, declared) }),
      ...attributesOf(declared),
      ...attributes,
      overlays: { kind: WORD_LIST, own: true, words: lineNames },
    },
    own: {
      ...(declared.some(({ key }) => key === 'samples') && cloudState),
      ...own,
      overlays: { opening, check: (field, overlays) => subset(field, overlays, lineNames) },
    },
  };
}
