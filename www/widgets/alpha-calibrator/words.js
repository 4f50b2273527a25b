/** Texts of the Alpha Calibrator in the present language. */

import { addEnglish, words } from '../../messages/registry.js';
import { counted, fixed, percent, powerOfTen, rounded, significant } from '../../ui/format.js';
import { en } from './en.js';

/**
 * @import { LegView } from '../../types.d.ts'
 * @import { Reading } from './reading.js'
 *
 * @typedef {'reference' | 'position' | 'heading' | null} Exact
 */

addEnglish({ calibrator: en });

/** @typedef {'trust' | 'caution' | 'unusable'} Rating */

/** Ratings of verdicts; the others are a caution. @type {Partial<Record<string, Rating>>} */
const RATINGS = { fits: 'trust', 'few-legs': 'unusable', unrelated: 'unusable', 'long-legs': 'unusable' };

/**
 * Returns the rating of the α's, with the verdict and the next step as sentences.
 *
 * @param {Reading} reading
 * @returns {{ rating: Rating, badge: string, finding: string, next: string }}
 */
export function judgementOf({ stats: { doubts: { verdict, heldOut } }, legs }) {
  const { badges, nextSteps, none, verdicts } = words.calibrator;
  const rating = legs.count === 0 ? 'unusable' : (RATINGS[verdict] ?? 'caution');
  const finding = legs.count === 0 ? none : verdicts[verdict](percent(heldOut.coverage));
  return { rating, badge: badges[rating], finding, next: nextSteps[legs.count === 0 ? 'few-legs' : verdict] };
}

/** Returns the names of the noises of a model. @param {Reading['config']['model']} model */
export const noiseNames = (model) => words.alphas[model === 'velocity' ? 'velocity' : 'odometry'];

/** The subscript of an α. @param {number} index from 0 */
export const alphaName = (index) => String.fromCharCode(0x2081 + index);

/** Prints an α with three digits, or two with a power of ten. @param {number} alpha */
export const significantly = (alpha) => (alpha >= 1e-4 ? rounded(alpha, 3) : significant(alpha, 2));

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

/**
 * Returns the legs of the log in a sentence; empty if there are none.
 *
 * @param {Reading} reading
 * @param {string} log name
 * @param {Exact} exact part of the reference that is assumed to be exact
 */
export function legsText({ legs }, log, exact) {
  const say = words.calibrator;
  return legs.count === 0 ? '' : say.present(log, counted(legs.count), exact && say.exact[exact]);
}

/** Returns the caption of the pictures: the judgement and the legs. @type {typeof legsText} */
export function captionOf(reading, log, exact) {
  const { badge, finding, next } = judgementOf(reading);
  return `${badge}. ${finding} ${next} ${legsText(reading, log, exact)}`.trim();
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
