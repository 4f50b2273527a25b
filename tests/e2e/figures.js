/**
 * Facts about all elements for the tests, and the choice of the figure on which a test about all of them runs.
 *
 * @module
 */

/**
 * Facts about an element that tests use.
 *
 * @typedef {object} FigureFacts
 * @property {boolean} [cloud] true if the figure has a cloud that grows, by Play, Step and Clear
 * @property {string[]} [handles] selectors of the handles in its pictures
 * @property {string} slider id of a slider that is visible when the figure opens
 * @property {string[]} at path of the slider's setting in a state
 * @property {[number, number]} values two values of the slider that are not the default
 * @property {[string, number]} other name of another setting that the first picture shows, and a value that is not the default
 * @property {string} button label of a visible button that changes the state
 * @property {{ at: number, field: string, value: string }} fold index of a disclosure with a field, and a value to type there
 * @property {{ at: number, part: string }} paper index of a disclosure with a part that is printed, and its selector
 */

/** @satisfies {Partial<FigureFacts>} */
const SPEED_FACTS = { slider: 'v', at: ['command', 'v'], values: /** @type {[number, number]} */ ([0.7, 0.4]), other: /** @type {[string, number]} */ (['omega', 1.25]) };
const MARKED_SAMPLE_FIELD = { at: 1, field: 'input[type=number]', value: '7' };

/** @typedef {'banana-machine' | 'map-squeeze' | 'arc-anatomy' | 'odometry-decomposer' | 'dead-reckoning' | 'alpha-calibrator'} Name */

/** @type {Record<Name, FigureFacts>} */
export const FIGURE_FACTS = {
  'banana-machine': {
    ...SPEED_FACTS, cloud: true, handles: ['.handle'], button: 'New seed',
    fold: MARKED_SAMPLE_FIELD, paper: { at: 1, part: 'table' },
  },
  'map-squeeze': {
    ...SPEED_FACTS, cloud: true, handles: ['.handle.body', '.handle.turn'], button: 'New seed',
    fold: MARKED_SAMPLE_FIELD, paper: { at: 1, part: 'table' },
  },
  'arc-anatomy': {
    ...SPEED_FACTS, handles: ['.handle.body.start', '.handle.turn.start', '.handle.body.next', '.handle.turn.next'], button: 'Right turn',
    fold: { at: 0, field: '.slider:has(#alpha1) .typed', value: '0.070' }, paper: { at: 1, part: '.lines' },
  },
  'odometry-decomposer': {
    cloud: true, handles: ['.handle.body.from', '.handle.turn.from', '.handle.body.to', '.handle.turn.to'],
    slider: 'drift', at: ['drift'], values: [70, 20], other: ['toY', -0.75], button: 'Drive, turn',
    fold: { at: 0, field: '.slider:has(#alpha1) .typed', value: '0.070' }, paper: { at: 1, part: '.readouts' },
  },
  'dead-reckoning': {
    cloud: true, slider: 'headingNoise', at: ['alphas', '2'], values: [0.07, 0.04], other: ['omega', 1.25], button: 'Straight',
    fold: MARKED_SAMPLE_FIELD, paper: { at: 1, part: 'table' },
  },
  'alpha-calibrator': {
    slider: 'distance', at: ['distance'], values: [0.4, 0.3], other: ['angle', 0.35], button: 'Next largest residual',
    fold: { at: 0, field: '.slider:has(#inflation) .typed', value: '2.50' }, paper: { at: 1, part: 'table' },
  },
};

/** Names of all elements. */
export const ALL_NAMES = /** @type {Name[]} */ (Object.keys(FIGURE_FACTS));

/** Names of two elements, for tests of several figures on one page. */
export const TWO_NAMES = /** @type {const} */ (['banana-machine', 'map-squeeze']);

/** Names of the elements with a cloud. */
export const CLOUD_NAMES = ALL_NAMES.filter((name) => FIGURE_FACTS[name].cloud);

/** Names of the elements with a handle. */
export const NAMES_WITH_HANDLES = ALL_NAMES.filter((name) => FIGURE_FACTS[name].handles);

/**
 * Returns the figure on which a test about all figures runs. It depends on the title only, and every figure has some tests.
 *
 * @param {string} title of the test; a tag at its end has no effect
 * @param {Name[]} [candidates]
 */
export function figureFor(title, candidates = ALL_NAMES) {
  let hash = 0;
  for (const character of title.replace(/ @\w+$/, '')) hash = (53 * hash + character.charCodeAt(0)) % 65_521;
  return candidates[hash % candidates.length];
}
