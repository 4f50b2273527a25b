/** Settings of Map Squeeze: their attributes, state fields and sliders. Also line styles, and the data that the figure shows. */

import { SELECTION_FIELD, presetAttributeOf, createDefinition } from '../../figure/definition.ts';
import { words } from '../../messages/registry.ts';
import { presets, settings, verdict as bits } from '../../../build/settings.js';
import { formatInteger, formatFixed, formatPercent } from '../../ui/format.ts';
import { createSamplesSliderSpec } from '../shared/cloud.ts';
import { COMMAND_DASH, createCommandSliderSpecs } from '../shared/sliders.ts';
import type { MapSqueeze, MapSqueezeSettings, SamplerName, SqueezeStats } from '../../types.d.ts';

const settingDeclarations = settings['map-squeeze'];

/** Presets: places in the apartment, each with settings that suit the place. */
export const PRESET_SETTING = presetAttributeOf(presets['map-squeeze']);

/** Pose of the robot when the user returns from another map to the apartment. */
export const OPENING_POSE = presets['map-squeeze'][0].settings.start;

export const LINE_STYLES = {
  accepted: { colourRole: 'cloud', shape: 'dot' },
  through: { colourRole: 'accent', shape: 'dot' },
  rejected: { colourRole: 'muted', shape: 'cross', width: 1.5 },
  commanded: { colourRole: 'prior', width: 2.5, dash: COMMAND_DASH },
  unknown: { colourRole: 'muted', shape: 'area' },
} satisfies Record<string, import('../../ui/theme.ts').LineStyle>;

export const COMMAND_SLIDERS = createCommandSliderSpecs(4);

/** Names of the views: the surroundings of the robot, and the whole map. */
const VIEW_NAMES = ['close', 'whole'];

export const definition = createDefinition('map-squeeze', {
  messageKey: 'squeeze',
  overlayStyles: LINE_STYLES,
  sliderSpecs: {
    ...COMMAND_SLIDERS,
    noise: { colourRole: 'prediction', min: 0, max: 0.4, step: 0.005, decimals: 3, combinedValueOf: ({ alphas }) => alphas[0] },
    clearance: { symbol: '*r*', colourRole: 'truth', min: 0, max: 0.4, step: 0.01, decimals: 2 },
    samples: createSamplesSliderSpec(100_000),
    steps: { colourRole: 'prediction', min: 1, max: 64, step: 1, decimals: 0 },
  },
  // Presets are places in the apartment, so that no preset matches on another map.
  presetAttribute: { ...PRESET_SETTING, getValue: (config) => (config.map ? null : PRESET_SETTING.getValue(config)) },
  elementFields: {
    ...SELECTION_FIELD,
    view: { type: 'word', words: VIEW_NAMES, default: VIEW_NAMES[0], access: 'attribute' },
    /** Map of the user; null for the apartment. Only maps that a simulation has accepted are stored. */
    map: { default: null, access: 'property' },
  },
});

/** Samplers in the order in which the figure offers them. */
export const SAMPLERS = settingDeclarations.find(({ key }) => key === 'sampler')?.words as SamplerName[];

/** Maximum number of samples without sub-steps. With sub-steps, it is divided by their number. */
export const MAX_SAMPLES = settingDeclarations.find(({ key }) => key === 'samples')?.max ?? 0;

export type ViewModel = ReturnType<typeof viewModelOf>;

/** Maximum number of samples drawn as dots. More samples are drawn as a density, because dots would overlap, and take longer than a frame. */
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

/** Returns the outcome of a sample, as a word of the setting `overlays`. `through` means that the sample was accepted although its path goes through a wall. */
export function outcomeOf(verdict: number): 'rejected' | 'accepted' | 'through' {
  if ((verdict & bits.accepted) === 0) return 'rejected';
  return (verdict & bits.pathFree) === 0 ? 'through' : 'accepted';
}

/**
 * Returns a text on accepted motions through a wall: their number, and their share with its confidence interval. The interval is left out if the sampler
 * excludes such motions (`isCertain`), or if the simulation gave up, because giving up depends on chance.
 */
export function formatThroughWallRate({ throughWall, throughWallRate, throughWallInterval: [low, high], gaveUp }: Pick<SqueezeStats, 'throughWall' | 'throughWallRate' | 'throughWallInterval' | 'gaveUp'>, isCertain: boolean) {
  const intervalText = isCertain || gaveUp ? '' : `${formatFixed(100 * low, 1)}\u2060–\u2060${formatPercent(high)}`;
  return words.squeeze.throughWallClause(throughWall, formatInteger(throughWall), formatPercent(throughWallRate), intervalText);
}

/** Returns a sentence that explains why the robot cannot move; empty if it can move. */
function explainStuckRobot(config: MapSqueezeSettings, stats: SqueezeStats, startFree: boolean): string {
  const { wedgedNote, nothingAcceptedNote, startCollisionNote } = words.squeeze;
  const { accepted, drawn } = stats;
  if (stats.gaveUp) return wedgedNote(formatInteger(drawn), formatInteger(accepted), formatInteger(config.samples), formatThroughWallRate(stats, false));
  if (drawn > 0 && accepted === 0) return nothingAcceptedNote(formatInteger(drawn));
  return startFree ? '' : startCollisionNote;
}
