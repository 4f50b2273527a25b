/** The Banana Machine's settings: their attributes, their part of the state, and their sliders. */

import { NUMBER_CONVERTER, definitionOf } from '../../figure/definition.ts';
import { checkedInteger } from '../../figure/checks.ts';
import { openingAlphas } from '../../../build/settings.js';
import { COMMAND_DASH, alphaSliders, commandSliders } from '../shared/sliders.ts';

/** Styles of the lines in the pictures. */
export const LINE_STYLES = {
  command: { role: 'prior', width: 2.5, dash: COMMAND_DASH },
  ellipse: { role: 'prediction', width: 2, dash: [7, 4] },
  exponential: { role: 'posterior', width: 2.25, dash: [] },
  linearized: { role: 'prediction', width: 1.75, dash: [9, 3, 2, 3] },
  additive: { role: 'prediction', width: 2.5, dash: [1.5, 5] },
} satisfies Record<string, import('../../scene/draw.ts').LineStyle>;

export type LineName = keyof typeof LINE_STYLES;

export const OVERLAY_NAMES = Object.keys(LINE_STYLES) as LineName[];

export const documentation: import('../../figure/definition.ts').Documentation = {
  state: {
    alphas: { type: '{ velocity: number[]; odometry: number[] }', sentence: 'Six of the velocity model, and four of the odometry model.' },
    pinned: { type: 'BananaMachineSettings | null', sentence: 'Settings whose outlines and numbers are pinned.' },
    isolateChoice: { type: 'number', sentence: 'The α that remains when Isolate is turned on, from 1.' },
  },
};

export const COMMAND_SLIDERS = commandSliders(3);

export const sliderSpecs = { ...COMMAND_SLIDERS, ...alphaSliders(6) };

export const definition = definitionOf('banana-machine', {
  messageKey: 'banana',
  lines: LINE_STYLES,
  opening: ['command', 'ellipse', 'exponential'],
  sliderSpecs,
  elementFields: {
    isolateChoice: { opening: 4, check: (field, number) => checkedInteger(field, number, 1, openingAlphas.velocity.length) },
    /** Settings of the simulation whose outlines are pinned; null for none. `BananaMachineElement.createSimulation` checks them. */
    pinned: { opening: null, check: (_, pinned) => pinned },
    morph: { converter: NUMBER_CONVERTER, min: 0, max: 1, opening: 0, isResetByPreset: true },
  },
  dependentDefaults: ({ model }) => ({ alphas: openingAlphas[model as keyof typeof openingAlphas] }),
});

/** Sample counts that the slider offers, in the steps 1–2–5 of a logarithmic scale. Clouds beyond a million would lag behind the finger. */
export const SAMPLE_COUNTS = [1, 2, 3, 4, 5].flatMap((decade) => [1, 2, 5].map((step) => step * 10 ** decade)).concat(1_000_000);
