/**
 * Random states of the elements, from a seed.
 *
 * @module
 */

import { settings } from '../../build/settings.js';
import { randomGenerator } from '../random.js';

export const STATE_SEEDS = [1, 2, 3, 4, 5, 6, 7, 8];

/** Returns a random state of each element, by tag name. The states have all fields. @param {number} seed */
export function randomStates(seed) {
  const nextRandom = randomGenerator(seed);
  const randomNumber = (/** @type {number} */ minNumber, /** @type {number} */ maxNumber) => minNumber + (maxNumber - minNumber) * nextRandom();
  const randomInteger = (/** @type {number} */ min, /** @type {number} */ max) => Math.floor(randomNumber(min, max + 1));
  const randomItem = (/** @type {readonly unknown[]} */ itemChoices) => itemChoices[randomInteger(0, itemChoices.length - 1)];
  const randomSublist = (/** @type {string} */ itemWords) => itemWords.split(' ').filter(() => nextRandom() < 0.5);
  const randomAlphas = (/** @type {number} */ alphaCount) => Array.from({ length: alphaCount }, () => randomNumber(0, 0.2));
  const randomPose = () => ({ x: randomNumber(-4, 4), y: randomNumber(-4, 4), theta: randomNumber(-4, 4) });
  const sampleCount = randomInteger(2, 3000);
  const cloudFields = {
    samples: sampleCount,
    seed: randomInteger(0, 2 ** 53 - 1),
    shown: randomItem([sampleCount, randomInteger(2, sampleCount)]),
    playing: false,
    marked: randomItem([null, randomInteger(0, 1)]),
  };
  const command = { v: randomNumber(-1, 2), omega: randomNumber(-2, 2), dt: randomNumber(0.1, 3) };
  const stepCount = randomInteger(1, 40);
  const fieldsByTag = {
    'banana-machine': {
      ...cloudFields,
      command,
      alphas: { velocity: randomAlphas(6), odometry: randomAlphas(4) },
      isolate: randomItem([null, randomInteger(1, 4)]),
      isolateChoice: randomInteger(1, 6),
      pinned: randomItem([
        null,
        { model: 'odometry', noise: 'normal', command: { v: 1, omega: 0.3, dt: 2 }, alphas: [0.1, 0.02, 0.05, 0.01], samples: randomInteger(1, 3000), seed: 9, isolate: null, reverseAware: true },
      ]),
      overlays: randomSublist('command ellipse exponential linearized additive'),
      morph: nextRandom() < 0.5 ? 0 : nextRandom(),
    },
    'map-squeeze': {
      ...cloudFields,
      command,
      start: { x: randomNumber(1, 5), y: randomNumber(1, 3), theta: randomNumber(-3, 3) },
      alphas: randomAlphas(6),
      clearance: randomNumber(0, 0.2),
      // The sampler 'whole-arc' draws all samples under any settings, so that each setting can change first.
      sampler: 'whole-arc',
      steps: randomInteger(1, 64),
      view: randomItem(['whole', 'close']),
      overlays: randomSublist('accepted through rejected commanded unknown'),
      map: randomItem([
        null,
        { name: 'room.json', bounds: [0, 0, 6, 4], walls: [[3, 0, 3, 1.5], [0, 0, 6, 0]] },
        { name: 'part.yaml', columns: 8, rows: 2, resolution: 0.5, origin: [0, 0, 0], occupied: 'gQA=', unknown: 'GA8=' },
        { name: 'grid.yaml', columns: 13, rows: 9, resolution: 0.5, origin: [-0.5, 0.25, 0.1], occupied: btoa(Array.from({ length: 15 }, (_, i) => String.fromCharCode(i < 14 ? randomInteger(0, 255) : randomInteger(0, 31) << 3)).join('')) },
      ]),
    },
    'arc-anatomy': {
      start: randomPose(),
      next: randomPose(),
      command,
      alphas: randomAlphas(6),
      overlays: randomSublist('commanded inverted wedge chord twist'),
      line: randomInteger(0, 9),
      underway: randomInteger(0, 100),
    },
    'odometry-decomposer': {
      ...cloudFields,
      from: randomPose(),
      to: randomPose(),
      alphas: randomAlphas(5),
      correlation: randomNumber(-1, 1),
      drift: randomNumber(0, 200),
      phase: randomNumber(0, 3),
      overlays: randomSublist('legs deviation outcomes prediction odometry difference'),
    },
    'dead-reckoning': {
      ...cloudFields,
      command,
      steps: stepCount,
      step: randomInteger(1, stepCount),
      alphas: randomAlphas(6),
      overlays: randomSublist('lateral along heading tolerance command measured ellipse exponential'),
    },
    'alpha-calibrator': {
      .../** @type {object} */ (randomItem([
        { model: 'odometry', rule: randomItem(['thrun', 'nav2', 'beluga']) },
        { model: 'omnidirectional', rule: 'omni' },
        { model: 'velocity', rule: randomItem(['thrun', 'nav2']) },
      ])),
      distance: randomNumber(0.1, 1),
      angle: randomNumber(0.1, 1),
      duration: randomItem([0, randomNumber(0.2, 2)]),
      positionStd: randomNumber(0, 0.02),
      yawStd: randomNumber(0, 0.02),
      inflation: randomNumber(0.1, 5),
      seed: randomInteger(0, 2 ** 53 - 1),
      leg: randomItem([null, randomInteger(0, 20)]),
      regressor: randomItem(['turn', 'distance']),
      overlays: randomSublist('likely plausible unlikely implausible outlier odometry predicted reference'),
    },
  };
  return Object.fromEntries(Object.entries(fieldsByTag).map(([widgetTag, stateFields]) => {
    // Every word of a keyword setting is allowed, and both values of a Boolean setting.
    const settingChoices = settings[widgetTag].flatMap(({ key, type, words = [true, false] }) => (['word', 'boolean'].includes(type) ? [[key, randomItem(words)]] : []));
    return [widgetTag, { version: 1, widget: widgetTag, ...Object.fromEntries(settingChoices), ...stateFields }];
  }));
}
