/** What Arc Anatomy says when, in the words of the present language. */

import { addEnglish, words } from '../../messages/registry.js';
import { fixed, percent, powerOfTen, significant } from '../../ui/format.js';
import { commandText } from '../shared/command.js';
import { en } from './en.js';

/**
 * @import { Pose } from '../../types.d.ts'
 * @import { Reading } from './reading.js'
 */

addEnglish({ anatomy: en });

/** Smaller numbers are printed as powers of ten: p is a product of three densities, and spans many decades. */
const SMALL = 0.0005;

/** @param {number} value above 0 */
function powerText(value) {
  const [mantissa, exponent] = value.toExponential(1).split('e').map(Number);
  return `${fixed(mantissa, 1)}·${powerOfTen(exponent)}`;
}

/** Checks whether a number is printed as a power of ten. @param {number} value */
export const isTiny = (value) => value > 0 && value < SMALL;

/** @param {number} share from 0 to 1 */
export const shareText = (share) => (isTiny(share) ? powerText(share) : percent(share));

/** @param {number} density */
export const densityText = (density) => (isTiny(density) ? powerText(density) : significant(density, 3));

const SYMBOLS = ['v̂', 'ω̂', 'γ̂'];

/** Which factor kills p, in a sentence. @param {Reading} reading */
export function verdictOf({ config, stats: { factors, weakest, share, driven, inverted } }) {
  const say = words.anatomy.verdict;
  const { deviations, share: kept, deviation } = factors[weakest];
  const symbol = SYMBOLS[weakest];
  if (config.printed && driven.arcLength !== inverted.arcLength) return say.printed(fixed(factors[0].estimate, 2), shareText(share));
  if (share === 1) return say.peak;
  if (deviation === 0) return say.noiseless(symbol);
  return say.off(symbol, fixed(Math.abs(deviations), 1), shareText(kept), shareText(share));
}

/** @param {Pose} pose */
const poseText = ({ x, y, theta }) => words.anatomy.pose(fixed(x, 2), fixed(y, 2), fixed(theta, 2));

/** The text equivalent of the picture. @param {Reading} reading */
export function pictureText(reading) {
  const { config, stats: { inverted, factors } } = reading;
  const say = words.anatomy.picture;
  const [v, omega, gamma] = factors.map(({ estimate }) => fixed(estimate, 2));
  return [
    say.poses(poseText(config.start), commandText(config.command), poseText(config.next)),
    inverted.center === null ? say.straight : say.arc(fixed(inverted.radius, 2), inverted.radius > 0),
    say.estimates(v, omega, gamma),
    verdictOf(reading),
  ].join(' ');
}
