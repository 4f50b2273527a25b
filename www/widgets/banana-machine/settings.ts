/** Settings of the Banana Machine: their attributes, state fields and sliders. Also line styles, and the data that the figure shows. */

import { renameErrorField } from '../../data/checks.ts';
import { SELECTION_FIELD, createDefinition } from '../../figure/definition.ts';
import { words } from '../../messages/registry.ts';
import { openingAlphas } from '../../../build/settings.js';
import { createSamplesSliderSpec } from '../shared/cloud.ts';
import { COMMAND_DASH, createAlphaSliderSpecs, createCommandSliderSpecs } from '../shared/sliders.ts';
import type { BananaMachine as Simulation, BananaMachineSettings as Settings, Motion, Stats, Table } from '../../types.d.ts';

export const LINE_STYLES = {
  command: { colourRole: 'prior', width: 2.5, dash: COMMAND_DASH },
  ellipse: { colourRole: 'prediction', width: 2, dash: [7, 4] },
  exponential: { colourRole: 'posterior', width: 2.25, dash: [] },
  linearized: { colourRole: 'prediction', width: 1.75, dash: [9, 3, 2, 3] },
  additive: { colourRole: 'prediction', width: 2.5, dash: [1.5, 5] },
} satisfies Record<string, import('../../ui/theme.ts').LineStyle>;

export type LineName = keyof typeof LINE_STYLES;

export const OVERLAY_NAMES = Object.keys(LINE_STYLES) as LineName[];

export const documentation = {
  state: {
    alphas: { type: '{ velocity: number[]; odometry: number[] }', sentence: 'Six of the velocity model, and four of the odometry model.' },
    pinned: { type: 'BananaMachineSettings | null', sentence: 'Settings whose outlines and numbers are pinned.' },
  },
};

export const COMMAND_SLIDERS = createCommandSliderSpecs(3);

export const sliderSpecs = { ...COMMAND_SLIDERS, ...createAlphaSliderSpecs(6) };

export const definition = createDefinition('banana-machine', {
  messageKey: 'banana',
  overlayStyles: LINE_STYLES,
  openingOverlays: ['command', 'ellipse', 'exponential'],
  sliderSpecs: { ...sliderSpecs, morph: { colourRole: 'truth', min: 0, max: 1, step: 0.01, decimals: 2 }, samples: createSamplesSliderSpec(1_000_000) },
  elementFields: {
    ...SELECTION_FIELD,
    /** Settings that the user has pinned (saved for comparison); null for none. `BananaMachineElement.enterState` checks them. */
    pinned: { default: null },
    morph: { type: 'number', default: 0, min: 0, max: 1, isResetByPreset: true, access: 'attribute' },
  },
  dependentDefaultsOf: ({ model }) => ({ alphas: openingAlphas[model as keyof typeof openingAlphas] }),
});

export type ViewModel = ReturnType<typeof viewModelOf>;

/** Standard deviation (m or rad) up to which poses count as equal. The quadrature has rounding errors of this size. */
const MIN_SPREAD = 1e-9;

export function viewModelOf(simulation: Simulation) {
  const simulationResults = simulation.read();
  const { config, stats, contours, table, chartHolds } = simulationResults;
  return {
    ...simulationResults,
    unusualCloudNote: explainUnusualCloud(config, table, stats, chartHolds),
    exactSkew: table.exact.crossTrackSkew,
    exponentialGain: exponentialGainOf(stats, table),
    /** Odometry reading of the command; null for the velocity model. */
    odometryReading: config.model === 'odometry' ? simulationResults.reading : null,
    /** End of the commanded arc, metres. */
    arcEnd: [...contours.command.slice(-2)] as [number, number],
  };
}

/** Returns the results of a new simulation with the given settings. Throws a TypeError or RangeError that names a field of `state.pinned`. */
export function viewModelOfSettings(motion: Motion, settings: Settings): ViewModel {
  let simulation;
  try {
    simulation = new motion.BananaMachine(settings);
    return viewModelOf(simulation);
  } catch (error) {
    throw renameErrorField(error, 'state.pinned.', '');
  } finally {
    simulation?.free();
  }
}

/**
 * Returns the gain in log-likelihood of the Gaussian in exponential coordinates over the Gaussian in (x, y, θ). If the covariance in (x, y, θ) is singular,
 * that gain is unbounded. The gain of arc coordinates over (x, y) is returned instead.
 */
function exponentialGainOf({ n, likelihoodGain, likelihoodGainError }: Stats, { exact }: Table) {
  const isUnbounded = exact.likelihoodGain.pose === Infinity;
  const gainKind = isUnbounded ? 'floor' : 'pose';
  return { n, unbounded: isUnbounded, value: likelihoodGain[gainKind], error: likelihoodGainError[gainKind], exact: exact.likelihoodGain[gainKind], wrapsHeadings: 4 * Math.sqrt(exact.cov[2][2]) > Math.PI };
}

/** Returns the standard deviation for a variance. A slightly negative variance, due to rounding, counts as 0. */
export function stdOfVariance(variance: number) {
  return Math.sqrt(Math.max(0, variance));
}

/** Returns the kind of cloud by its exact covariance: one pose, one position with many headings, or an extended cloud. */
function spreadKindOf({ exact: { cov } }: Table): 'point' | 'headings' | 'cloud' {
  if (stdOfVariance(Math.max(cov[0][0], cov[1][1])) > MIN_SPREAD) return 'cloud';
  return stdOfVariance(cov[2][2]) > MIN_SPREAD ? 'headings' : 'point';
}

/**
 * Returns a sentence about an unusual cloud and the settings that cause it; empty for a usual cloud. `isChartDefined` is false if robots turn so far that
 * exponential coordinates are undefined.
 */
function explainUnusualCloud({ model, command, reverseAware }: Settings, table: Table, stats: Stats, isChartDefined: boolean): string {
  const { notes } = words.banana;
  const spreadKind = spreadKindOf(table);
  const { v, omega } = command;
  if (spreadKind === 'point') return v === 0 && omega === 0 ? notes.standingStill : notes.noNoise;
  if (spreadKind === 'headings') return notes.onlyHeadings;
  if (!isChartDefined) return notes.fullTurns;
  if (model === 'odometry' && v < 0 && !reverseAware) return notes.reverseDrive;
  return stats.n > 2 && Object.values(stats.coverage).some(Number.isNaN) ? notes.onLine : '';
}
