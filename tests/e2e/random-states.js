// Random states of the elements, from a seed.

import { settings } from '../../build/settings.js';
import { createRandomGenerator } from '../random.js';

export const STATE_SEEDS = [1, 2, 3, 4, 5, 6, 7, 8];

/** Returns a random state of each element, by tag name. The states have all fields. @param {number} seed */
export function createRandomStates(seed) {
  const drawUniform = createRandomGenerator(seed);
  const drawNumber = (/** @type {number} */ minNumber, /** @type {number} */ maxNumber) => minNumber + (maxNumber - minNumber) * drawUniform();
  const drawInteger = (/** @type {number} */ min, /** @type {number} */ max) => Math.floor(drawNumber(min, max + 1));
  const drawItem = (/** @type {readonly unknown[]} */ itemChoices) => itemChoices[drawInteger(0, itemChoices.length - 1)];
  const drawSublist = (/** @type {string} */ itemWords) => itemWords.split(' ').filter(() => drawUniform() < 0.5);
  const drawAlphas = (/** @type {number} */ alphaCount) => Array.from({ length: alphaCount }, () => drawNumber(0, 0.2));
  const drawPose = () => ({ x: drawNumber(-4, 4), y: drawNumber(-4, 4), theta: drawNumber(-4, 4) });
  const sampleCount = drawInteger(2, 3000);
  const cloudFields = {
    samples: sampleCount,
    seed: drawInteger(0, 2 ** 53 - 1),
    shown: drawItem([sampleCount, drawInteger(2, sampleCount)]),
    playing: false,
    marked: drawItem([null, drawInteger(0, 1)]),
  };
  const command = { v: drawNumber(-1, 2), omega: drawNumber(-2, 2), dt: drawNumber(0.1, 3) };
  const stepCount = drawInteger(1, 40);
  const fieldsByTag = {
    'banana-machine': {
      ...cloudFields,
      command,
      alphas: { velocity: drawAlphas(6), odometry: drawAlphas(4) },
      isolate: drawItem([null, drawInteger(1, 4)]),
      pinned: drawItem([
        null,
        { model: 'odometry', noise: 'normal', command: { v: 1, omega: 0.3, dt: 2 }, alphas: [0.1, 0.02, 0.05, 0.01], samples: drawInteger(1, 3000), seed: 9, isolate: null, reverseAware: true },
      ]),
      overlays: drawSublist('command ellipse exponential linearized additive'),
      morph: drawUniform() < 0.5 ? 0 : drawUniform(),
    },
    'map-squeeze': {
      ...cloudFields,
      command,
      start: { x: drawNumber(1, 5), y: drawNumber(1, 3), theta: drawNumber(-3, 3) },
      alphas: drawAlphas(6),
      clearance: drawNumber(0, 0.2),
      // With the sampler 'whole-arc' no combination of other settings is refused. Settings can therefore be applied in any order.
      sampler: 'whole-arc',
      steps: drawInteger(1, 64),
      view: drawItem(['whole', 'close']),
      overlays: drawSublist('accepted through rejected commanded unknown'),
      map: drawItem([
        null,
        { name: 'room.json', bounds: [0, 0, 6, 4], walls: [[3, 0, 3, 1.5], [0, 0, 6, 0]] },
        { name: 'part.yaml', columns: 8, rows: 2, resolution: 0.5, origin: [0, 0, 0], occupied: 'gQA=', unknown: 'GA8=' },
        { name: 'grid.yaml', columns: 13, rows: 9, resolution: 0.5, origin: [-0.5, 0.25, 0.1], occupied: btoa(Array.from({ length: 15 }, (_, i) => String.fromCharCode(i < 14 ? drawInteger(0, 255) : drawInteger(0, 31) << 3)).join('')) },
      ]),
    },
    'arc-anatomy': {
      start: drawPose(),
      next: drawPose(),
      command,
      alphas: drawAlphas(6),
      overlays: drawSublist('commanded inverted wedge chord twist'),
      line: drawInteger(0, 9),
      underway: drawInteger(0, 100),
    },
    'odometry-decomposer': {
      ...cloudFields,
      from: drawPose(),
      to: drawPose(),
      alphas: drawAlphas(5),
      correlation: drawNumber(-1, 1),
      drift: drawNumber(0, 200),
      phase: drawNumber(0, 3),
      overlays: drawSublist('legs deviation outcomes prediction odometry difference'),
    },
    'dead-reckoning': {
      ...cloudFields,
      command,
      steps: stepCount,
      step: drawInteger(1, stepCount),
      alphas: drawAlphas(6),
      overlays: drawSublist('lateral along heading tolerance command measured ellipse exponential'),
    },
    'alpha-calibrator': {
      .../** @type {object} */ (drawItem([
        { model: 'odometry', rule: drawItem(['thrun', 'nav2', 'beluga']) },
        { model: 'omnidirectional', rule: 'omni' },
        { model: 'velocity', rule: drawItem(['thrun', 'nav2']) },
      ])),
      distance: drawNumber(0.1, 1),
      angle: drawNumber(0.1, 1),
      duration: drawItem([0, drawNumber(0.2, 2)]),
      positionStd: drawNumber(0, 0.02),
      yawStd: drawNumber(0, 0.02),
      inflation: drawNumber(0.1, 5),
      seed: drawInteger(0, 2 ** 53 - 1),
      leg: drawItem([null, drawInteger(0, 20)]),
      overlays: drawSublist('likely plausible unlikely implausible outlier odometry predicted reference'),
    },
  };
  return Object.fromEntries(Object.entries(fieldsByTag).map(([widgetTag, stateFields]) => {
    // Each keyword setting gets one of its allowed words, and each Boolean setting gets true or false.
    const settingChoices = settings[widgetTag].flatMap(({ key, type, words = [true, false] }) => (['word', 'boolean'].includes(type) ? [[key, drawItem(words)]] : []));
    return [widgetTag, { version: 1, widget: widgetTag, ...Object.fromEntries(settingChoices), ...stateFields }];
  }));
}
