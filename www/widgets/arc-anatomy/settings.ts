/** Settings of Arc Anatomy: their attributes, state fields and sliders. Also line styles, and the data that the figure shows. */

import { createDefinition } from '../../figure/definition.ts';
import { COMMAND_DASH, createAlphaSliderSpecs, createCommandSliderSpecs } from '../shared/sliders.ts';
import type { ArcAnatomy } from '../../types.d.ts';

/** Results of a simulation that the picture and the readouts show. */
export type ViewModel = ReturnType<ArcAnatomy['read']>;

export const TABLE_LINES = 9;

/** Value of the setting `underway` (per cent of the command's duration) when the command ends. */
export const UNDERWAY_AT_END = 100;

export const LINE_STYLES = {
  commanded: { colourRole: 'prior', width: 2.5, dash: COMMAND_DASH },
  inverted: { colourRole: 'prediction', width: 2.75, dash: [] },
  wedge: { colourRole: 'accent', shape: 'area' },
  chord: { colourRole: 'ink', width: 1, dash: [2, 3] },
  twist: { colourRole: 'posterior', width: 2, dash: [7, 3] },
} satisfies Record<string, import('../../ui/theme.ts').LineStyle>;

/** Styles of the contours. They are the same whether the heat map shows the density or the probability. */
export const CONTOUR_STYLES = {
  prob: { colourRole: 'ink', width: 1, dash: [5, 4] },
  density: { colourRole: 'ink', width: 1, dash: [] },
} satisfies Record<string, import('../../ui/theme.ts').LineStyle>;

export type LineName = keyof typeof LINE_STYLES;

export const documentation = {
  state: {
    line: { type: 'number', sentence: 'The highlighted line of Table 5.1, from 1; 0 for none.' },
    underway: { type: 'number', sentence: 'Share of the command’s duration that the robot has driven, in per cent.' },
  },
};

export const COMMAND_SLIDERS = createCommandSliderSpecs(4);

export const ALPHA_SLIDERS = createAlphaSliderSpecs(6);

export const definition = createDefinition('arc-anatomy', {
  messageKey: 'anatomy',
  overlayStyles: LINE_STYLES,
  openingOverlays: ['commanded', 'inverted', 'wedge', 'chord'],
  sliderSpecs: { ...COMMAND_SLIDERS, ...ALPHA_SLIDERS, underway: { symbol: '*t*', colourRole: 'truth', min: 0, max: UNDERWAY_AT_END, step: 1, decimals: 0 } },
  elementFields: {
    line: { type: 'whole', default: 0, min: 0, max: TABLE_LINES, isResetByPreset: true },
    underway: { type: 'number', unit: '%', default: UNDERWAY_AT_END, min: 0, max: UNDERWAY_AT_END, isResetByPreset: true },
  },
});
