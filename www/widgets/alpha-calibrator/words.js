/** Texts of the Alpha Calibrator in the present language. */

import { addEnglish, words } from '../../messages/registry.js';
import { counted, fixed, percent, powerOfTen } from '../../ui/format.js';
import { en } from './en.js';
import { isLocalizer } from './lines.js';
import { uncorrectedText } from './systematic.js';

/**
 * @import { CalibrationCheck, LegView } from '../../types.d.ts'
 * @import { Reading } from './reading.js'
 */

addEnglish({ calibrator: en });

/** Printed checks that are a count, and those that are a fraction; the others are plain numbers. */
const COUNTS = ['enough-legs'];
const FRACTIONS = ['legs-lost', 'outliers-few', 'holdout-covered', 'window-1m-covered', 'window-2m-covered', 'window-5m-covered'];

/**
 * Returns the rating of the α's, with the first failed check, warnings and the next step as sentences. A warning makes consistent α's
 * questionable.
 *
 * @param {Reading} reading
 * @param {string} log name
 * @returns {{ rating: Reading['stats']['diagnostics']['verdict'], badge: string, finding: string, next: string }}
 */
export function judgementOf(reading, log) {
  const { stats: { diagnostics: { verdict, checks } }, legs } = reading;
  const say = words.calibrator;
  const warnings = [uncorrectedText(reading), isLocalizer(log) ? say.nav2.localizer : ''].filter(Boolean);
  const rating = verdict === 'consistent' && warnings.length > 0 ? 'questionable' : verdict;
  const result = (/** @type {string} */ finding, /** @type {string} */ next) => ({ rating, badge: say.badges[rating], finding: [finding, ...warnings].join(' '), next });
  if (legs.count === 0) return result(say.none, say.longer);
  const failed = checks.filter(({ passed }) => !passed);
  if (failed.length > 0) return result(say.failed(say.checks.names[failed[0].name], counted(failed.length), counted(checks.length)), messageOf(failed[0]));
  return verdict === 'unusable' ? result(say.noAlpha, '') : result(say.passed(counted(checks.length)), rating === 'consistent' ? say.use : '');
}

/** Returns what a failed check means and what to do. @param {CalibrationCheck} check */
export const messageOf = ({ name, passed, message }) => (passed ? '' : words.calibrator.checks.message(name, message));

/** Prints the value of a check, or a limit of it. @param {CalibrationCheck['name']} name @param {number} value */
export function checked(name, value) {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? percent(value) : '∞';
  return COUNTS.includes(name) ? counted(value) : FRACTIONS.includes(name) ? percent(value) : fixed(value, 3);
}

/** Prints the values of a check that pass. @param {CalibrationCheck} check */
export function expectedOf({ name, expected: [low, high] }) {
  if (high === Infinity) return `≥ ${checked(name, low)}`;
  return low === 0 ? `≤ ${checked(name, high)}` : words.calibrator.alphas.between(checked(name, low), checked(name, high));
}

/** Returns why the recommended α's are what they are. @param {Reading} reading */
export function reasonOf({ stats: { recommended, diagnostics: { checks, windows } } }) {
  const say = words.calibrator.recommended;
  if (!recommended) return say.none;
  const [{ count, coverage, nees }] = windows;
  if (!checks.some(({ name }) => name === 'window-1m-covered')) return say.few(counted(count));
  const { inflation } = recommended;
  return inflation === 1 ? say.covered(percent(coverage), counted(count)) : say.inflated(fixed(inflation, 2), percent(coverage), counted(count), fixed(nees, 2));
}

/** Returns the names of the noises of a model. @param {Reading['config']['model']} model */
export const noiseNames = (model) => words.alphas[model === 'velocity' ? 'velocity' : 'odometry'];

/** The subscript of an α. @param {number} index from 0 */
export const alphaName = (index) => String.fromCharCode(0x2081 + index);

/** Prints a number that is in the format of files, as 1.5e-7. @param {string} number */
export const localized = (number) => number.replace('.', fixed(0.5, 1)[1]).replace(/e(-?\d+)$/, (_, exponent) => `·${powerOfTen(Number(exponent))}`);

/**
 * Scales small numbers by a power of 1000, as they have no room beside an axis.
 *
 * @param {number} highest
 * @returns {{ scaled: (value: number) => number, unit: string }} the unit is empty where it is 1
 */
export function thousandths(highest) {
  const exponent = Math.min(0, 3 * Math.floor(Math.log10(highest) / 3));
  return { scaled: (value) => value * 10 ** -exponent, unit: exponent < 0 ? powerOfTen(exponent) : '' };
}

/** Returns the legs and outliers of the log in a sentence; empty if there are none. @param {Reading} reading @param {string} log name */
export function legsText({ legs }, log) {
  if (legs.count === 0) return '';
  const outliers = legs.outliers.reduce((sum, is) => sum + is, 0);
  return words.calibrator.present(log, counted(legs.count), outliers > 0 ? counted(outliers) : '');
}

/** Returns the caption of the pictures: the judgement and the legs. @type {typeof legsText} */
export function captionOf(reading, log) {
  const { badge, finding, next } = judgementOf(reading, log);
  return [`${badge}.`, finding, next, legsText(reading, log)].filter(Boolean).join(' ');
}

/**
 * The text equivalent of the way.
 *
 * @param {Reading} reading
 * @param {number} chosen
 */
export function wayText({ legs, classes }, chosen) {
  if (chosen < 0) return words.calibrator.noWay;
  const far = classes.reduce((sum, place) => sum + Number(place > 1), 0);
  return words.calibrator.way(counted(legs.count), counted(far), counted(chosen + 1));
}

/**
 * The text equivalent of a leg.
 *
 * @param {LegView | null} leg
 * @param {number} chosen
 */
export function legText(leg, chosen) {
  if (!leg) return words.calibrator.noLeg;
  const [readX, readY, endX, endY] = [leg.read[0], leg.read[1], leg.ended[0], leg.ended[1]];
  return words.calibrator.legText(counted(chosen + 1), fixed(readX, 3), fixed(readY, 3), fixed(endX, 3), fixed(endY, 3));
}
