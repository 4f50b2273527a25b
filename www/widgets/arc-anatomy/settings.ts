/** Arc Anatomy's settings: their attributes, their part of the state, and their sliders. */

import { wholeNumber } from '../../figure/checks.ts';
import { definitionOf } from '../../figure/definition.ts';
import { COMMAND_DASH, commandLooks } from '../shared/command.ts';
import { alphaLooks } from '../shared/noise.ts';

/** Number of lines of Table 5.1. */
export const TABLE_LINES = 9;

/** Whole duration, per cent. */
export const WHOLE = 100;

/** Styles of the lines in the picture. */
export const LINES = {
  commanded: { role: 'prior', width: 2.5, dash: COMMAND_DASH },
  inverted: { role: 'prediction', width: 2.75, dash: [] },
  wedge: { role: 'accent', mark: 'area' },
  chord: { role: 'ink', width: 1, dash: [2, 3] },
  twist: { role: 'posterior', width: 2, dash: [7, 3] },
} satisfies Record<string, import('../../figure/overlays.ts').LineStyle>;

export type LineName = keyof typeof LINES;

export const documentation: import('../../figure/attributes.ts').Documentation = {
  state: {
    line: { type: 'number', sentence: 'The line of Table 5.1 that is lit, from 1; 0 for none.' },
    underway: { type: 'number', sentence: 'How much of the time the robot has been underway, in per cent.' },
  },
};

export const COMMAND = commandLooks(4);

export const ALPHAS = alphaLooks(6);

export const definition = definitionOf('arc-anatomy', {
  vocabulary: 'anatomy',
  lines: LINES,
  opening: ['commanded', 'inverted', 'wedge', 'chord'],
  looks: { ...COMMAND, ...ALPHAS },
  own: {
    line: { opening: 0, ofPreset: true, check: (field, line) => wholeNumber(field, line, 0, TABLE_LINES) },
    underway: { opening: WHOLE, ofPreset: true, check: (field, share) => wholeNumber(field, share, 0, WHOLE) },
  },
});

/** Largest coordinates of a pose that is dragged, m. */
export const REACH = 4;
