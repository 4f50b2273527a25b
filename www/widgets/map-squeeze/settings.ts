/** Map Squeeze's settings: their attributes, their part of the state, and their sliders; line styles, and the view model. */

import { presetAttributeOf, createDefinition } from '../../figure/definition.ts';
import { words } from '../../messages/registry.ts';
import { presets, settings, verdict as bits } from '../../../build/settings.js';
import { formatInteger, formatFixed, formatPercent } from '../../ui/format.ts';
import { createSamplesSliderSpec } from '../shared/cloud.ts';
import { COMMAND_DASH, createCommandSliderSpecs } from '../shared/sliders.ts';
import type { MapSqueeze, MapSqueezeSettings, SamplerName, SqueezeStats } from '../../types.d.ts';

const settingDeclarations = settings['map-squeeze'];

/** Presets: positions in the apartment, with settings that show their effect. */
export const PRESET_SETTING = presetAttributeOf(presets['map-squeeze']);

/** Pose of the robot in the apartment after the user has left a map. */
export const OPENING_POSE = presets['map-squeeze'][0].settings.start;

/** Marks and lines of the picture. */
export const LINE_STYLES = {
  accepted: { role: 'cloud', shape: 'dot' },
  through: { role: 'accent', shape: 'dot' },
  rejected: { role: 'muted', shape: 'cross', width: 1.5 },
  commanded: { role: 'prior', width: 2.5, dash: COMMAND_DASH },
  unknown: { role: 'muted', shape: 'area' },
} satisfies Record<string, import('../../ui/swatch.ts').LineStyle>;

export const COMMAND_SLIDERS = createCommandSliderSpecs(4);

/** Names of the parts of the map that the picture can show. */
const VIEW_NAMES = ['close', 'whole'];

export const definition = createDefinition('map-squeeze', {
  messageKey: 'squeeze',
  overlayStyles: LINE_STYLES,
  sliderSpecs: {
    ...COMMAND_SLIDERS,
    noise: { role: 'prediction', min: 0, max: 0.4, step: 0.005, decimals: 3, combinedValueOf: ({ alphas }) => alphas[0] },
    clearance: { symbol: '*r*', role: 'truth', min: 0, max: 0.4, step: 0.01, decimals: 2 },
    samples: createSamplesSliderSpec(100_000),
    steps: { role: 'prediction', min: 1, max: 64, step: 1, decimals: 0 },
  },
  // Presets are places in the apartment.
  presetAttribute: { ...PRESET_SETTING, get: (config) => (config.map ? null : PRESET_SETTING.get(config)) },
  elementFields: {
    view: { type: 'word', words: VIEW_NAMES, default: VIEW_NAMES[0], access: 'attribute' },
    /** Map of the user; null for the apartment. A simulation has checked it. */
    map: { default: null, access: 'property' },
  },
});

/** Samplers in the order in which they are offered. */
export const SAMPLERS = settingDeclarations.find(({ key }) => key === 'sampler')?.words as SamplerName[];

/** Maximum number of samples for a command in one step; it is divided by the number of sub-steps. */
export const MAX_SAMPLES = settingDeclarations.find(({ key }) => key === 'samples')?.max ?? 0;

export type ViewModel = ReturnType<typeof viewModelOf>;

/** Number of samples above which they are drawn as a density: dots would be indistinguishable, and take longer than a frame. */
const MAX_DOT_COUNT = 1500;

export function viewModelOf(simulation: MapSqueeze) {
  const simulationResults = simulation.read();
  const { config, stats, verdicts, poses, startFree } = simulationResults;
  return {
    ...simulationResults,
    posesByOutcome: stats.attempts > MAX_DOT_COUNT ? undefined : groupByOutcome(poses, verdicts),
    stuckNote: explainStuckRobot(config, stats, startFree),
  };
}

function groupByOutcome(poses: Float64Array, verdicts: Uint8Array) {
  const posesOf = (outcome: ReturnType<typeof outcomeOf>) => {
    const sampleIndices = [...verdicts.keys()].filter((i) => outcomeOf(verdicts[i]) === outcome);
    return Float64Array.from(sampleIndices.flatMap((i) => [poses[3 * i], poses[3 * i + 1], poses[3 * i + 2]]));
  };
  return { rejected: posesOf('rejected'), accepted: posesOf('accepted'), through: posesOf('through') };
}

/** Returns the outcome of a sample, a word of `overlays`: `through` is accepted although its path goes through a wall. */
export function outcomeOf(verdict: number): 'rejected' | 'accepted' | 'through' {
  if ((verdict & bits.accepted) === 0) return 'rejected';
  return (verdict & bits.pathFree) === 0 ? 'through' : 'accepted';
}

/**
 * Returns a text on the accepted motions that went through a wall: their number, and their share with its interval. There is no interval if
 * the sampler excludes such motions (`isCertain`), or if the simulation gave up, because giving up depends on chance.
 */
export function formatThroughWallRate({ throughWall, throughWallRate, throughWallInterval: [low, high], gaveUp }: Pick<SqueezeStats, 'throughWall' | 'throughWallRate' | 'throughWallInterval' | 'gaveUp'>, isCertain: boolean) {
  const intervalText = isCertain || gaveUp ? '' : `${formatFixed(100 * low, 1)}\u2060–\u2060${formatPercent(high)}`;
  return words.squeeze.throughWallClause(throughWall, formatInteger(throughWall), formatPercent(throughWallRate), intervalText);
}

/** Returns a sentence on a robot that cannot move; empty for an ordinary cloud. */
function explainStuckRobot(config: MapSqueezeSettings, stats: SqueezeStats, startFree: boolean): string {
  const { wedgedNote, nothingAcceptedNote, startCollisionNote } = words.squeeze;
  const { accepted, drawn } = stats;
  if (stats.gaveUp) return wedgedNote(formatInteger(drawn), formatInteger(accepted), formatInteger(config.samples), formatThroughWallRate(stats, false));
  if (drawn > 0 && accepted === 0) return nothingAcceptedNote(formatInteger(drawn));
  return startFree ? '' : startCollisionNote;
}
