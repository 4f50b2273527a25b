/** Settings of the Alpha Calibrator: attributes, shared state and sliders. */

import { checkedInteger, checkedWord } from '../../figure/checks.ts';
import { definitionOf } from '../../figure/definition.ts';
import type { AlphaCalibratorSettings } from '../../types.d.ts';

/** Styles of the lines and marks in the pictures: first the classes of legs, the most usual first, then all others. */
export const LINE_STYLES = {
  likely: { role: 'truth', width: 1.5, dash: [] },
  plausible: { role: 'truth', width: 2, dash: [] },
  unlikely: { role: 'prediction', width: 3.25, dash: [] },
  implausible: { role: 'accent', width: 4.5, dash: [] },
  outlier: { role: 'ink', width: 1.25, mark: 'ring' },
  odometry: { role: 'prior', width: 1.25, dash: [2.5, 3.5] },
  predicted: { role: 'prediction', width: 2, dash: [7, 4] },
  reference: { role: 'ink', width: 2.25, dash: [] },
} satisfies Record<string, import('../../scene/draw.ts').LineStyle>;

export type LineName = keyof typeof LINE_STYLES;

/** Classes of legs, the most usual first. */
export const LEG_CLASSES = ['likely', 'plausible', 'unlikely', 'implausible'] as const satisfies LineName[];

/** Motions that squared residuals are plotted against. */
const REGRESSORS = ['turn', 'distance'] as const;

export type Regressor = (typeof REGRESSORS)[number];

/** Maximum index of a leg in a shared link. The number of legs is not known before the fit, so that it cannot be the limit. */
const MAX_LEG_INDEX = 9_999_999;

export const documentation: import('../../figure/definition.ts').Documentation = {
  state: {
    leg: { type: 'number | null', sentence: 'The leg that is shown, from 0; null, or one that is not there, for the largest residual that is no outlier.' },
    regressor: { type: "'turn' | 'distance'", sentence: 'The motion that squared residuals are drawn against.' },
  },
};

/** Leg length to which the true α's of the simulated log apply, and with which the element opens. */
export const SIMULATED_LEGS = { distance: 0.25, angle: 0.2 };

/** Combination of model and rule, which is one choice on screen but two settings. */
export type ModelRule = keyof typeof import('./en.ts').en.kinds;

export const modelRuleOf = ({ model, rule }: AlphaCalibratorSettings): ModelRule => (model === 'velocity' ? 'velocity' : rule);

export function settingsFor(kind: ModelRule) {
  if (kind === 'velocity') return { model: 'velocity', rule: 'thrun' };
  return { model: kind === 'omni' ? 'omnidirectional' : 'odometry', rule: kind };
}

/** Noise components by model, in the order of the residuals. */
export const NOISE_COMPONENTS = {
  odometry: ['rot1', 'trans', 'rot2'],
  omnidirectional: ['rot2', 'trans', 'strafe'],
  velocity: ['v', 'omega', 'gamma'],
} as const;

export const definition = definitionOf('alpha-calibrator', {
  messageKey: 'calibrator',
  lines: LINE_STYLES,
  sliderSpecs: {
    distance: { symbol: '*d*', role: 'prior', min: 0.05, max: 1, step: 0.01, decimals: 2 },
    angle: { symbol: '*φ*', role: 'prior', min: 0.05, max: 1, step: 0.01, decimals: 2 },
    duration: { symbol: '*T*', role: 'prior', min: 0, max: 5, step: 0.1, decimals: 2 },
    positionStd: { symbol: '*σ*_{xy}', role: 'truth', min: 0, max: 0.05, step: 0.001, decimals: 3 },
    yawStd: { symbol: '*σ*_{θ}', role: 'truth', min: 0, max: 0.05, step: 0.001, decimals: 3 },
    inflation: { symbol: '*f*', role: 'prediction', min: 0.1, max: 5, step: 0.05, decimals: 2 },
  },
  elementFields: {
    leg: { opening: null, check: (field, leg) => (leg === null ? null : checkedInteger(field, leg, 0, MAX_LEG_INDEX)) },
    regressor: { opening: REGRESSORS[0], check: (field, regressor) => checkedWord(field, regressor, REGRESSORS) },
  },
});
