// Random states of the elements, from a seed.

import { settings } from '../../build/settings.js';
import { createRandomGenerator } from '../random.js';

export const STATE_SEEDS = [1, 2, 3, 4, 5, 6, 7, 8];

/** Returns a random state of each element, by tag name. The states have all fields. @param {number} seed */
export function createRandomStates(seed) {
  const drawUniform = createRandomGenerator(seed);
  const sampleNumber = (/** @type {number} */ minNumber, /** @type {number} */ maxNumber) => minNumber + (maxNumber - minNumber) * drawUniform();
  const sampleInteger = (/** @type {number} */ minValue, /** @type {number} */ maxValue) => Math.floor(sampleNumber(minValue, maxValue + 1));
  const sampleItem = (/** @type {readonly unknown[]} */ itemChoices) => itemChoices[sampleInteger(0, itemChoices.length - 1)];
  const sampleSublist = (/** @type {string} */ itemWords) => itemWords.split(' ').filter(() => drawUniform() < 0.5);
  const sampleAlphas = (/** @type {number} */ alphaCount) => Array.from({ length: alphaCount }, () => sampleNumber(0, 0.2));
  const samplePose = () => ({ x: sampleNumber(-4, 4), y: sampleNumber(-4, 4), theta: sampleNumber(-4, 4) });
  const sampleCount = sampleInteger(2, 3000);
  const cloudFields = {
    samples: sampleCount,
    seed: sampleInteger(0, 2 ** 53 - 1),
    shown: sampleItem([sampleCount, sampleInteger(2, sampleCount)]),
    playing: false,
  };
  const selection = { marked: sampleItem([null, sampleInteger(0, 1)]) };
  const command = { v: sampleNumber(-1, 2), omega: sampleNumber(-2, 2), dt: sampleNumber(0.1, 3) };
  const stepCount = sampleInteger(1, 40);
  const fieldsByTag = {
    'banana-machine': {
      ...cloudFields,
      ...selection,
      command,
      alphas: { velocity: sampleAlphas(6), odometry: sampleAlphas(4) },
      isolate: sampleItem([null, sampleInteger(1, 4)]),
      pinned: sampleItem([
        null,
        { model: 'odometry', noise: 'normal', command: { v: 1, omega: 0.3, dt: 2 }, alphas: [0.1, 0.02, 0.05, 0.01], samples: sampleInteger(1, 3000), seed: 9, isolate: null, reverseAware: true },
      ]),
      overlays: sampleSublist('command ellipse exponential linearized additive'),
      morph: drawUniform() < 0.5 ? 0 : drawUniform(),
    },
    'map-squeeze': {
      ...cloudFields,
      ...selection,
      command,
      start: { x: sampleNumber(1, 5), y: sampleNumber(1, 3), theta: sampleNumber(-3, 3) },
      alphas: sampleAlphas(6),
      clearance: sampleNumber(0, 0.2),
      // With the sampler 'whole-arc' no combination of other settings is refused. Settings can therefore be applied in any order.
      sampler: 'whole-arc',
      steps: sampleInteger(1, 64),
      view: sampleItem(['whole', 'close']),
      overlays: sampleSublist('accepted through rejected commanded unknown'),
      map: sampleItem([
        null,
        { name: 'room.json', bounds: [0, 0, 6, 4], walls: [[3, 0, 3, 1.5], [0, 0, 6, 0]] },
        { name: 'part.yaml', columns: 8, rows: 2, resolution: 0.5, origin: [0, 0, 0], occupied: 'gQA=', unknown: 'GA8=' },
        { name: 'grid.yaml', columns: 13, rows: 9, resolution: 0.5, origin: [-0.5, 0.25, 0.1], occupied: btoa(Array.from({ length: 15 }, (_, i) => String.fromCharCode(i < 14 ? sampleInteger(0, 255) : sampleInteger(0, 31) << 3)).join('')) },
      ]),
    },
    'arc-anatomy': {
      start: samplePose(),
      next: samplePose(),
      command,
      alphas: sampleAlphas(6),
      overlays: sampleSublist('commanded inverted wedge chord twist'),
      line: sampleInteger(0, 9),
      underway: sampleInteger(0, 100),
    },
    'odometry-decomposer': {
      ...cloudFields,
      from: samplePose(),
      to: samplePose(),
      alphas: sampleAlphas(5),
      correlation: sampleNumber(-1, 1),
      drift: sampleNumber(0, 200),
      phase: sampleNumber(0, 3),
      overlays: sampleSublist('legs deviation outcomes prediction odometry difference'),
    },
    'dead-reckoning': {
      ...cloudFields,
      command,
      steps: stepCount,
      step: sampleInteger(1, stepCount),
      alphas: sampleAlphas(6),
      overlays: sampleSublist('lateral along heading tolerance command measured ellipse exponential'),
    },
    'alpha-calibrator': {
      .../** @type {object} */ (sampleItem([
        { model: 'odometry', rule: sampleItem(['thrun', 'nav2', 'beluga']) },
        { model: 'omnidirectional', rule: 'omni' },
        { model: 'velocity', rule: sampleItem(['thrun', 'nav2']) },
      ])),
      distance: sampleNumber(0.1, 1),
      angle: sampleNumber(0.1, 1),
      duration: sampleItem([0, sampleNumber(0.2, 2)]),
      positionStd: sampleNumber(0, 0.02),
      yawStd: sampleNumber(0, 0.02),
      inflation: sampleNumber(0.1, 5),
      seed: sampleInteger(0, 2 ** 53 - 1),
      leg: sampleItem([null, sampleInteger(0, 20)]),
      overlays: sampleSublist('likely plausible unlikely implausible outlier odometry predicted reference'),
    },
  };
  return Object.fromEntries(Object.entries(fieldsByTag).map(([widgetTag, stateFields]) => {
    // Each keyword setting gets one of its allowed words, and each Boolean setting gets true or false.
    const settingChoices = settings[widgetTag].flatMap(({ key: settingKey, type, words = [true, false] }) => (['word', 'boolean'].includes(type) ? [[settingKey, sampleItem(words)]] : []));
    return [widgetTag, { version: 1, widget: widgetTag, ...Object.fromEntries(settingChoices), ...stateFields }];
  }));
}
