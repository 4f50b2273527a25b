/** Texts of Arc Anatomy in the current language. */

import { addEnglish, words } from '../../messages/registry.ts';
import { fixed, percent, formatPowerOfTen, formatSignificant } from '../../ui/format.ts';
import { commandText } from '../shared/sliders.ts';
import { en } from './en.ts';
import type { ArcAnatomy, Pose } from '../../types.d.ts';

addEnglish({ anatomy: en });

/** Values of the simulation that the picture and the readouts need. */
export type ViewModel = ReturnType<ArcAnatomy['read']>;

/** Limit below which numbers are printed as powers of ten: p is a product of three densities, and spans many decades. */
const MIN_PLAIN_NUMBER = 0.0005;

function scientificText(value: number) {
  const [mantissa, exponent] = value.toExponential(1).split('e').map(Number);
  return `${fixed(mantissa, 1)}·${formatPowerOfTen(exponent)}`;
}

/** Returns true if a number is printed as a power of ten. */
export const isTiny = (value: number) => value > 0 && value < MIN_PLAIN_NUMBER;

export const shareText = (share: number) => (isTiny(share) ? scientificText(share) : percent(share));

export const densityText = (density: number) => (isTiny(density) ? scientificText(density) : formatSignificant(density, 3));

/** Returns a sentence about the factor that makes p small. */
export function captionOf({ config, stats: { factors, weakest, share, driven, inverted } }: ViewModel) {
  const texts = words.anatomy.verdict;
  const { deviations, share: keptShare, deviation } = factors[weakest];
  const estimateName = `${words.anatomy.bars.names[weakest]} ${['v̂', 'ω̂', 'γ̂'][weakest]}`;
  if (config.printed && driven.arcLength !== inverted.arcLength) return texts.printed(fixed(factors[0].estimate, 2), shareText(share));
  if (share === 1) return texts.peak;
  if (deviation === 0) return texts.noiseless(estimateName);
  return texts.off(estimateName, fixed(Math.abs(deviations), 1), shareText(keptShare), shareText(share));
}

const poseText = ({ x, y, theta }: Pose) => words.anatomy.pose(fixed(x, 2), fixed(y, 2), fixed(theta, 2));

export function pictureText(viewModel: ViewModel) {
  const { config, stats: { inverted } } = viewModel;
  const texts = words.anatomy.picture;
  return [
    texts.poses(poseText(config.start), commandText(config.command), poseText(config.next)),
    inverted.center === null ? texts.straight : texts.arc(fixed(inverted.radius, 2), inverted.radius > 0),
    captionOf(viewModel),
  ].join(' ');
}
