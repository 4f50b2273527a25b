/** What Dead Reckoning shows of its machine. */

import type { DeadReckoning as Machine, DeadReckoningSettings, StepOutlines } from '../../types.d.ts';

export type Reading = ReturnType<typeof readingOf>;

/** The components of ξ, in the order of every triple. */
export const COMPONENTS = ['along', 'lateral', 'heading'] as const;

/** Where else on the way clouds and outlines are shown: at so many places, the last of them its end. */
const MILESTONES = 4;

/** Everything that the pictures and readouts need of the machine, asked once a change. */
export function readingOf(machine: Machine) {
  const { config, shown, stats, ratios, relativeErrors, commanded, nominal, poses, twists } = machine;
  const { step, steps, compounding } = config;
  const outlines = machine.outlines(step) as StepOutlines;
  const milestones = placesOn(steps).filter((place) => place !== step).map((place) => ({
    poses: machine.posesAfter(place),
    outlines: machine.outlines(place) as StepOutlines,
  }));
  const ratio = ratios[compounding];
  return {
    config,
    shown,
    stats,
    /** Of each component, by step from 1. */
    curves: COMPONENTS.map((_, axis) => curveOf(ratio, relativeErrors, axis)),
    commanded,
    /** The commanded pose after the step. */
    pose: nominal.subarray(3 * (step - 1), 3 * step),
    poses,
    twists,
    outlines,
    milestones,
    condition: conditionOf(config, stats, ratio),
  };
}

function placesOn(steps: number) {
  const places = Array.from({ length: MILESTONES }, (_, i) => Math.max(1, Math.round(((i + 1) * steps) / MILESTONES)));
  return [...new Set(places)];
}

/** @param ratios three a step */
function curveOf(ratios: Float64Array, relativeErrors: Float64Array, axis: number) {
  const ofAxis = (triples: Float64Array) => triples.filter((_, i) => i % 3 === axis);
  const ratio = ofAxis(ratios);
  return { ratio, error: ofAxis(relativeErrors).map((error, i) => error * ratio[i]) };
}

/**
 * Returns the condition that keeps ratios from being told: no robots, no spread at all, no covariance at the end, or too few robots; 'told'
 * if nothing does.
 */
function conditionOf({ compounding }: DeadReckoningSettings, { n, predicted, measured, misses }: Machine['stats'], ratios: Float64Array): 'none' | 'still' | 'lost' | 'few' | 'told' {
  if (n === 0) return 'none';
  // Of a single one there is no variance.
  if (n === 1) return 'few';
  if (measured.cov.every((row) => row.every((entry) => Math.abs(entry) < Number.EPSILON ** 2))) return 'still';
  // One component alone may have no variance, as the heading without noise of its own.
  if (predicted[compounding] === null || ratios.slice(-COMPONENTS.length).every(Number.isNaN)) return 'lost';
  return misses[compounding].some(({ told, end }) => !told && !Number.isNaN(end)) ? 'few' : 'told';
}
