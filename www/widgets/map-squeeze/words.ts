/**
 * Texts of Map Squeeze in the current language: outcomes, sentences about robots that cannot move, and the text equivalent of the picture.
 */

import { addEnglish, words } from '../../messages/registry.ts';
import { verdict as bits } from '../../../build/settings.js';
import { integer, fixed, percent } from '../../ui/format.ts';
import { commandText } from '../shared/sliders.ts';
import { en } from './en.ts';
import { throughWallText, type ViewModel } from './view-model.ts';
import type { Plan, SqueezeSettings as Settings, SqueezeStats as Stats } from '../../types.d.ts';

addEnglish({ squeeze: en });

/** Returns the text of a verdict, whose bits are in `verdict` of settings.js. */
export function verdictText(verdict: number, config: Settings) {
  const hasBit = (bit: number) => (verdict & bit) !== 0;
  const { overlays, verdict: reasons } = words.squeeze;
  const isAccepted = hasBit(bits.accepted);
  if (!isAccepted && config.sampler === 'sub-stepped') return `${overlays.rejected}: ${reasons.part}`;
  const outcomeText = isAccepted ? overlays.accepted : overlays.rejected;
  if (!hasBit(bits.endFree)) return `${outcomeText}: ${reasons.end}`;
  if (hasBit(bits.pathFree)) return `${outcomeText}: ${reasons.free}`;
  return `${isAccepted ? overlays.through : outcomeText}: ${reasons.way}`;
}

/** Returns the headline: the share of accepted motions that went through a wall. */
export function headlineOf({ attempts, accepted, throughWall }: Pick<Stats, 'attempts' | 'accepted' | 'throughWall'>) {
  const texts = words.squeeze.headline;
  if (attempts === 0) return texts.untried;
  if (accepted === 0) return texts.nothing;
  return throughWall === 0 ? texts.none : texts.share(percent(throughWall / accepted));
}

/** Returns the caption: the counts of the samples, or why the robot cannot move. */
export function captionOf({ config: { conditioned, sampler }, stats, note }: ViewModel) {
  const { accepted, attempts, gaveUp } = stats;
  const texts = words.squeeze;
  // If the robot cannot move, the note contains the number of motions.
  if (note && (accepted === 0 || gaveUp)) return note;
  if (attempts === 0) return `${texts.headline.untried}.`;
  const testedText = texts.tested[conditioned ? sampler : 'off'](integer(accepted), integer(attempts));
  return `${testedText}; ${throughWallText(stats, conditioned && sampler === 'whole-arc')}. ${note}`.trim();
}

/** Returns the name of a map with its size. */
export function mapText(name: string, { bounds, walls }: Plan) {
  const [left, bottom, right, top] = bounds;
  return words.squeeze.mapText(name, fixed(right - left, 1), fixed(top - bottom, 1), integer(walls.length / 4));
}

/** Returns the text equivalent of the picture, with the map as `mapText` has it. */
export function pictureText(viewModel: ViewModel, map: string) {
  const { start: { x, y, theta }, command } = viewModel.config;
  const texts = words.squeeze;
  return [texts.picture(map), texts.robotAt(fixed(x, 2), fixed(y, 2), fixed(theta, 2), commandText(command)), captionOf(viewModel)].join(' ');
}
