/**
 * Random states of the elements, from a seed.
 *
 * @module
 */

import { generator } from '../random.js';

export const SEEDS = [1, 2, 3, 4, 5, 6, 7, 8];

/** Returns a random state of each element by its tag, with all fields. @param {number} seed */
export function anyOf(seed) {
  const random = generator(seed);
  const real = (/** @type {number} */ least, /** @type {number} */ most) => least + (most - least) * random();
  const whole = (/** @type {number} */ least, /** @type {number} */ most) => Math.floor(real(least, most + 1));
  const one = (/** @type {unknown[]} */ of) => of[whole(0, of.length - 1)];
  const alphas = (/** @type {number} */ count) => Array.from({ length: count }, () => real(0, 0.2));
  const pose = () => ({ x: real(-4, 4), y: real(-4, 4), theta: real(-4, 4) });
  const samples = whole(2, 3000);
  const shown = one([samples, whole(2, samples)]);
  const cloud = {
    version: 1,
    samples,
    seed: whole(0, 2 ** 53 - 1),
    shown,
    playing: false,
    marked: one([null, whole(0, 1)]),
  };
  const command = { v: real(-1, 2), omega: real(-2, 2), dt: real(0.1, 3) };
  const common = { ...cloud, command };
  const model = one(['velocity', 'odometry']);
  const steps = whole(1, 40);
  return {
    'banana-machine': {
      ...common,
      widget: 'banana-machine',
      model,
      noise: one(['normal', 'triangular']),
      alphas: { velocity: alphas(6), odometry: alphas(4) },
      isolate: one([null, whole(1, 4)]),
      isolateChoice: whole(1, 6),
      pinned: one([
        null,
        { model: 'odometry', noise: 'normal', command: { v: 1, omega: 0.3, dt: 2 }, alphas: [0.1, 0.02, 0.05, 0.01], samples: whole(1, 3000), seed: 9, isolate: null, reverseAware: true },
      ]),
      reverseAware: one([true, false]),
      overlays: ['command', 'ellipse', 'exponential', 'linearized', 'additive'].filter(() => random() < 0.5),
      morph: random() < 0.5 ? 0 : random(),
    },
    'map-squeeze': {
      ...common,
      widget: 'map-squeeze',
      start: { x: real(1, 5), y: real(1, 3), theta: real(-3, 3) },
      alphas: alphas(6),
      clearance: real(0, 0.2),
      conditioned: one([true, false]),
      // The whole-arc sampler never gives up, and its settings are valid in any order.
      sampler: 'whole-arc',
      steps: whole(1, 64),
      unknown: one(['free', 'blocked']),
      view: one(['whole', 'close']),
      overlays: ['accepted', 'through', 'rejected', 'commanded', 'unknown'].filter(() => random() < 0.5),
      map: one([
        null,
        { name: 'room.json', bounds: [0, 0, 6, 4], walls: [[3, 0, 3, 1.5], [0, 0, 6, 0]] },
        { name: 'part.yaml', columns: 8, rows: 2, resolution: 0.5, origin: [0, 0, 0], occupied: 'gQA=', unknown: 'GA8=' },
        { name: 'grid.yaml', columns: 13, rows: 9, resolution: 0.5, origin: [-0.5, 0.25, 0.1], occupied: btoa(Array.from({ length: 15 }, (_, i) => String.fromCharCode(i < 14 ? whole(0, 255) : whole(0, 31) << 3)).join('')) },
      ]),
    },
    'arc-anatomy': {
      version: 1,
      widget: 'arc-anatomy',
      start: pose(),
      next: pose(),
      command,
      alphas: alphas(6),
      noise: one(['normal', 'triangular']),
      printed: one([true, false]),
      map: one(['none', 'prob', 'density']),
      overlays: ['commanded', 'inverted', 'wedge', 'chord', 'twist'].filter(() => random() < 0.5),
      line: whole(0, 9),
      underway: whole(0, 100),
    },
    'odometry-decomposer': {
      ...cloud,
      widget: 'odometry-decomposer',
      from: pose(),
      to: pose(),
      rule: one(['thrun', 'nav2', 'beluga', 'omni']),
      alphas: alphas(5),
      noise: one(['normal', 'triangular']),
      correlation: real(-1, 1),
      drift: real(0, 200),
      phase: real(0, 3),
      overlays: ['legs', 'deviation', 'outcomes', 'prediction', 'odometry', 'difference'].filter(() => random() < 0.5),
    },
    'dead-reckoning': {
      ...common,
      widget: 'dead-reckoning',
      steps,
      step: whole(1, steps),
      alphas: alphas(6),
      per: one(['step', 'path']),
      compounding: one(['chapter', 'first-order', 'fourth-order']),
      overlays: ['lateral', 'along', 'heading', 'tolerance', 'command', 'measured', 'ellipse', 'exponential'].filter(() => random() < 0.5),
    },
    'alpha-calibrator': {
      version: 1,
      widget: 'alpha-calibrator',
      .../** @type {object} */ (one([
        { model: 'odometry', rule: one(['thrun', 'nav2', 'beluga']) },
        { model: 'omnidirectional', rule: 'omni' },
        { model: 'velocity', rule: one(['thrun', 'nav2']) },
      ])),
      noise: one(['normal', 'triangular']),
      outliers: one(['reject', 'keep']),
      distance: real(0.1, 1),
      angle: real(0.1, 1),
      duration: one([0, real(0.2, 2)]),
      positionStd: real(0, 0.02),
      yawStd: real(0, 0.02),
      mountYaw: one([true, false]),
      leverArm: one([true, false]),
      distanceScale: one([true, false]),
      turnScale: one([true, false]),
      clockOffset: one([true, false]),
      inflation: real(0.1, 5),
      seed: whole(0, 2 ** 53 - 1),
      leg: one([null, whole(0, 20)]),
      driver: one(['turn', 'way']),
      overlays: ['likely', 'plausible', 'unlikely', 'implausible', 'outlier', 'odometry', 'predicted', 'reference'].filter(() => random() < 0.5),
    },
  };
}
