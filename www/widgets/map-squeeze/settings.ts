/** Map Squeeze's settings: their attributes, their part of the state, and their sliders. */

import { WORD_CONVERTER, presetPropertyOf, definitionOf } from '../../figure/definition.ts';
import { presets, settings } from '../../../build/settings.js';
import { COMMAND_DASH, commandSliders } from '../shared/sliders.ts';
import type { SamplerName } from '../../types.d.ts';

const settingDeclarations = settings['map-squeeze'];

/** Presets: positions in the apartment, with settings that show their effect. */
export const PRESET_SETTING = presetPropertyOf(presets['map-squeeze'], settingDeclarations);

/** Pose of the robot where a map has been left. */
export const OPENING_POSE = presets['map-squeeze'][0].start;

/** Marks and lines of the picture. */
export const LINE_STYLES = {
  accepted: { role: 'cloud', mark: 'dot' },
  through: { role: 'accent', mark: 'dot' },
  rejected: { role: 'muted', mark: 'cross', width: 1.5 },
  commanded: { role: 'prior', width: 2.5, dash: COMMAND_DASH },
  unknown: { role: 'muted', mark: 'area' },
} satisfies Record<string, import('../../scene/draw.ts').LineStyle>;

export const COMMAND_SLIDERS = commandSliders(4);

export const definition = definitionOf('map-squeeze', {
  messageKey: 'squeeze',
  lines: LINE_STYLES,
  sliderSpecs: {
    ...COMMAND_SLIDERS,
    noise: { role: 'prediction', min: 0, max: 0.4, step: 0.005, decimals: 3, value: ({ alphas }) => alphas[0] },
    clearance: { symbol: '*r*', role: 'truth', min: 0, max: 0.4, step: 0.01, decimals: 2 },
    steps: { role: 'prediction', min: 1, max: 64, step: 1, decimals: 0 },
  },
  // Presets are places in the apartment.
  preset: { ...PRESET_SETTING, get: (config) => (config.map ? null : PRESET_SETTING.get(config)) },
  elementFields: {
    view: { converter: WORD_CONVERTER, words: ['close', 'whole'], opening: 'close' },
    /** Map of the user; null for the apartment. A simulation has checked it. */
    map: { opening: null, check: (_, map) => map },
  },
});

/** Samplers in the order in which they are offered. */
export const SAMPLERS = settingDeclarations.find(({ key }) => key === 'sampler')?.words as SamplerName[];

/** Sample counts of the slider. The simulation accepts more, but they would not follow a slider. */
export const SAMPLE_COUNTS = [1, 2, 5, 10, 20, 50, 100, 200, 300, 600, 1000, 2000, 5000, 10_000, 20_000, 50_000, 100_000];

/** Maximum number of samples for a command in one step; it is divided by the number of sub-steps. */
export const MAX_SAMPLES = settingDeclarations.find(({ key }) => key === 'samples')?.max ?? 0;
