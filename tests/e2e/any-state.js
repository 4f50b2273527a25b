/**
 * Random states of the elements, from a seed.
 *
 * @module
 */

import { randomGenerator } from '../random.js';

export const STATE_SEEDS = [1, 2, 3, 4, 5, 6, 7, 8];

/** Returns a random state of each element, by its tag name. The states have all fields. @param {number} seed */
export function randomStates(seed) {
  const random = randomGenerator(seed);
  const realNumber = (/** @type {number} */ min, /** @type {number} */ max) => min + (max - min) * random();
  const wholeNumber = (/** @type {number} */ min, /** @type {number} */ max) => Math.floor(realNumber(min, max + 1));
  const oneOf = (/** @type {unknown[]} */ choices) => choices[wholeNumber(0, choices.length - 1)];
  const alphas = (/** @type {number} */ count) => Array.from({ length: count }, () => realNumber(0, 0.2));
  const pose = () => ({ x: realNumber(-4, 4), y: realNumber(-4, 4), theta: realNumber(-4, 4) });
  const samples = wholeNumber(2, 3000);
  const shown = oneOf([samples, wholeNumber(2, samples)]);
  const cloud = {
    version: 1,
    samples,
    seed: wholeNumber(0, 2 ** 53 - 1),
    shown,
    playing: false,
    marked: oneOf([null, wholeNumber(0, 1)]),
  };
  const command = { v: realNumber(-1, 2), omega: realNumber(-2, 2), dt: realNumber(0.1, 3) };
  const common = { ...cloud, command };
  const model = oneOf(['velocity', 'odometry']);
  const steps = wholeNumber(1, 40);
  return {
    'banana-machine': {
      ...common,
      widget: 'banana-machine',
      model,
      noise: oneOf(['normal', 'triangular']),
      alphas: { velocity: alphas(6), odometry: alphas(4) },
      isolate: oneOf([null, wholeNumber(1, 4)]),
      isolateChoice: wholeNumber(1, 6),
      pinned: oneOf([
        null,
        { model: 'odometry', noise: 'normal', command: { v: 1, omega: 0.3, dt: 2 }, alphas: [0.1, 0.02, 0.05, 0.01], samples: wholeNumber(1, 3000), seed: 9, isolate: null, reverseAware: true },
      ]),
      reverseAware: oneOf([true, false]),
      overlays: ['command', 'ellipse', 'exponential', 'linearized', 'additive'].filter(() => random() < 0.5),
      morph: random() < 0.5 ? 0 : random(),
    },
    'map-squeeze': {
      ...common,
      widget: 'map-squeeze',
      start: { x: realNumber(1, 5), y: realNumber(1, 3), theta: realNumber(-3, 3) },
      alphas: alphas(6),
      clearance: realNumber(0, 0.2),
      conditioned: oneOf([true, false]),
      // The whole-arc sampler never gives up, and its settings are valid in any order.
      sampler: 'whole-arc',
      steps: wholeNumber(1, 64),
      unknown: oneOf(['free', 'blocked']),
      view: oneOf(['whole', 'close']),
      overlays: ['accepted', 'through', 'rejected', 'commanded', 'unknown'].filter(() => random() < 0.5),
      map: oneOf([
        null,
        { name: 'room.json', bounds: [0, 0, 6, 4], walls: [[3, 0, 3, 1.5], [0, 0, 6, 0]] },
        { name: 'part.yaml', columns: 8, rows: 2, resolution: 0.5, origin: [0, 0, 0], occupied: 'gQA=', unknown: 'GA8=' },
        { name: 'grid.yaml', columns: 13, rows: 9, resolution: 0.5, origin: [-0.5, 0.25, 0.1], occupied: btoa(Array.from({ length: 15 }, (_, i) => String.fromCharCode(i < 14 ? wholeNumber(0, 255) : wholeNumber(0, 31) << 3)).join('')) },
      ]),
    },
    'arc-anatomy': {
      version: 1,
      widget: 'arc-anatomy',
      start: pose(),
      next: pose(),
      command,
      alphas: alphas(6),
      noise: oneOf(['normal', 'triangular']),
      printed: oneOf([true, false]),
      map: oneOf(['none', 'prob', 'density']),
      overlays: ['commanded', 'inverted', 'wedge', 'chord', 'twist'].filter(() => random() < 0.5),
      line: wholeNumber(0, 9),
      underway: wholeNumber(0, 100),
    },
    'odometry-decomposer': {
      ...cloud,
      widget: 'odometry-decomposer',
      from: pose(),
      to: pose(),
      rule: oneOf(['thrun', 'nav2', 'beluga', 'omni']),
      alphas: alphas(5),
      noise: oneOf(['normal', 'triangular']),
      correlation: realNumber(-1, 1),
      drift: realNumber(0, 200),
      phase: realNumber(0, 3),
      overlays: ['legs', 'deviation', 'outcomes', 'prediction', 'odometry', 'difference'].filter(() => random() < 0.5),
    },
    'dead-reckoning': {
      ...common,
      widget: 'dead-reckoning',
      steps,
      step: wholeNumber(1, steps),
      alphas: alphas(6),
      per: oneOf(['step', 'path']),
      compounding: oneOf(['chapter', 'first-order', 'fourth-order']),
      overlays: ['lateral', 'along', 'heading', 'tolerance', 'command', 'measured', 'ellipse', 'exponential'].filter(() => random() < 0.5),
    },
    'alpha-calibrator': {
      version: 1,
      widget: 'alpha-calibrator',
      .../** @type {object} */ (oneOf([
        { model: 'odometry', rule: oneOf(['thrun', 'nav2', 'beluga']) },
        { model: 'omnidirectional', rule: 'omni' },
        { model: 'velocity', rule: oneOf(['thrun', 'nav2']) },
      ])),
      noise: oneOf(['normal', 'triangular']),
      outliers: oneOf(['reject', 'keep']),
      distance: realNumber(0.1, 1),
      angle: realNumber(0.1, 1),
      duration: oneOf([0, realNumber(0.2, 2)]),
      positionStd: realNumber(0, 0.02),
      yawStd: realNumber(0, 0.02),
      mountYaw: oneOf([true, false]),
      leverArm: oneOf([true, false]),
      distanceScale: oneOf([true, false]),
      turnScale: oneOf([true, false]),
      clockOffset: oneOf([true, false]),
      inflation: realNumber(0.1, 5),
      seed: wholeNumber(0, 2 ** 53 - 1),
      leg: oneOf([null, wholeNumber(0, 20)]),
      regressor: oneOf(['turn', 'distance']),
      overlays: ['likely', 'plausible', 'unlikely', 'implausible', 'outlier', 'odometry', 'predicted', 'reference'].filter(() => random() < 0.5),
    },
  };
}
