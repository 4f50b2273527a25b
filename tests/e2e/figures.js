// Facts about each element for the tests, and the choice of the element on which a test of common behaviour runs.

/**
 * Facts that tests need about an element.
 *
 * @typedef {object} FigureFacts
 * @property {boolean} [hasCloud] true if the figure has a cloud that grows, by Play, Step and Clear
 * @property {string[]} [handleSelectors] selectors of the handles in its pictures
 * @property {string} sliderId id of a slider that is visible when the figure opens
 * @property {string[]} statePath path of the slider's setting in a state
 * @property {[number, number]} sliderValues two values of the slider that are not the default
 * @property {[string, number]} otherSetting name of another setting that the first picture shows, and a value that is not the default
 * @property {string} buttonLabel label of a visible button that changes the state
 * @property {{ disclosureIndex: number, fieldSelector: string, typedText: string }} fieldInFold index of a disclosure with a field, and a value to type there
 * @property {{ disclosureIndex: number, partSelector: string }} printedPart index of a disclosure with a part that is printed, and its selector
 */

/** @satisfies {Partial<FigureFacts>} */
const SPEED_SLIDER_FACTS = { sliderId: 'v', statePath: ['command', 'v'], sliderValues: /** @type {[number, number]} */ ([0.7, 0.4]), otherSetting: /** @type {[string, number]} */ (['omega', 1.25]) };
const MARKED_SAMPLE_FIELD = { disclosureIndex: 1, fieldSelector: 'input[type=number]', typedText: '7' };

/** @typedef {'banana-machine' | 'map-squeeze' | 'arc-anatomy' | 'odometry-decomposer' | 'dead-reckoning' | 'alpha-calibrator'} Name */

/** @type {Record<Name, FigureFacts>} */
export const FIGURE_FACTS = {
  'banana-machine': {
    ...SPEED_SLIDER_FACTS, hasCloud: true, handleSelectors: ['.handle'], buttonLabel: 'New seed',
    fieldInFold: MARKED_SAMPLE_FIELD, printedPart: { disclosureIndex: 1, partSelector: 'table' },
  },
  'map-squeeze': {
    ...SPEED_SLIDER_FACTS, hasCloud: true, handleSelectors: ['.handle.body', '.handle.turn'], buttonLabel: 'New seed',
    fieldInFold: MARKED_SAMPLE_FIELD, printedPart: { disclosureIndex: 1, partSelector: 'table' },
  },
  'arc-anatomy': {
    ...SPEED_SLIDER_FACTS, handleSelectors: ['.handle.body.start', '.handle.turn.start', '.handle.body.next', '.handle.turn.next'], buttonLabel: 'Right turn',
    fieldInFold: { disclosureIndex: 0, fieldSelector: '.slider:has(#alpha1) .typed', typedText: '0.070' }, printedPart: { disclosureIndex: 1, partSelector: '.lines' },
  },
  'odometry-decomposer': {
    hasCloud: true, handleSelectors: ['.handle.body.from', '.handle.turn.from', '.handle.body.to', '.handle.turn.to'],
    sliderId: 'drift', statePath: ['drift'], sliderValues: [70, 20], otherSetting: ['toY', -0.75], buttonLabel: 'Drive, turn',
    fieldInFold: { disclosureIndex: 0, fieldSelector: '.slider:has(#alpha1) .typed', typedText: '0.070' }, printedPart: { disclosureIndex: 1, partSelector: '.readouts' },
  },
  'dead-reckoning': {
    hasCloud: true, sliderId: 'headingNoise', statePath: ['alphas', '2'], sliderValues: [0.07, 0.04], otherSetting: ['omega', 1.25], buttonLabel: 'Straight',
    fieldInFold: MARKED_SAMPLE_FIELD, printedPart: { disclosureIndex: 1, partSelector: 'table' },
  },
  'alpha-calibrator': {
    sliderId: 'distance', statePath: ['distance'], sliderValues: [0.4, 0.3], otherSetting: ['angle', 0.35], buttonLabel: 'Next largest residual',
    fieldInFold: { disclosureIndex: 0, fieldSelector: '.slider:has(#inflation) .typed', typedText: '2.50' }, printedPart: { disclosureIndex: 1, partSelector: 'table' },
  },
};

export const ALL_FIGURE_NAMES = /** @type {Name[]} */ (Object.keys(FIGURE_FACTS));

/** Names of two elements, for tests of several figures on one page. */
export const TWO_FIGURE_NAMES = /** @type {const} */ (['banana-machine', 'map-squeeze']);

export const CLOUD_FIGURE_NAMES = ALL_FIGURE_NAMES.filter((figureName) => FIGURE_FACTS[figureName].hasCloud);

export const HANDLE_FIGURE_NAMES = ALL_FIGURE_NAMES.filter((figureName) => FIGURE_FACTS[figureName].handleSelectors);

/**
 * Returns the figure with which a test of common behaviour runs. The choice depends on the title only, and every figure has some tests.
 *
 * @param {string} testTitle title of the test; a tag at its end has no effect
 * @param {Name[]} [candidateNames]
 */
export function chooseFigureName(testTitle, candidateNames = ALL_FIGURE_NAMES) {
  let titleHash = 0;
  for (const character of testTitle.replace(/ @\w+$/, '')) titleHash = (53 * titleHash + character.charCodeAt(0)) % 65_521;
  return candidateNames[titleHash % candidateNames.length];
}
