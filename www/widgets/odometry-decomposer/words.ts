/** Texts of the Odometry Decomposer in the current language. */

import { addEnglish, words } from '../../messages/registry.ts';
import { integer, fixed } from '../../ui/format.ts';
import { en } from './en.ts';
import { poseAt, type ViewModel } from './view-model.ts';

addEnglish({ decomposer: en });

/** Length of a reading, m, below which it is called jitter. */
const MAX_JITTER = 0.01;

export function captionOf({ config: { rule, alphas }, rules, legs, deviations, stats }: ViewModel) {
  const texts = words.decomposer.caption;
  const [{ legs: { rot1, trans } }] = rules;
  const isReverseAware = rule === 'nav2' || rule === 'beluga';
  const transMillimetres = fixed(1000 * trans, 1);
  if (alphas.every((alpha) => alpha === 0)) return texts.still;
  if (rule === 'omni') return texts.omni(fixed(deviations.strafe, 2));
  if (trans > 0 && trans < MAX_JITTER) return isReverseAware ? texts.restSpin(transMillimetres) : texts.rest(transMillimetres, fixed(rot1, 2));
  if (trans === 0) {
    const remainingTurn = Math.PI - Math.abs(legs.rot2);
    return isReverseAware && remainingTurn < Math.PI / 2 ? texts.spinEitherWay(fixed(remainingTurn, 2)) : texts.spin;
  }
  if (rule === 'thrun' && Math.abs(rot1) > Math.PI / 2 && Math.abs(legs.rot2) > Math.PI / 2) return texts.reverse;
  return texts.lever(fixed(deviations.rot1, 2), fixed(trans, 2), fixed(stats.exactCrossTrack, 2));
}

/** Returns the distance between the odometry's own pose and the predicted pose, m. */
export function driftDistance({ drifted, linkage }: ViewModel) {
  const [odometryPose, predictedPose] = [poseAt(drifted.poses, 2), poseAt(linkage, 3)];
  return Math.hypot(odometryPose.x - predictedPose.x, odometryPose.y - predictedPose.y);
}

export function legsPictureText(viewModel: ViewModel) {
  const { legs: { rot1, trans, rot2 }, config: { to }, stats } = viewModel;
  const texts = words.decomposer;
  const outcomesText = stats.n === 0 ? texts.none : texts.outcomes(integer(stats.n), fixed(stats.crossTrack, 2), fixed(stats.heading, 2));
  return `${texts.picture(fixed(rot1, 2), fixed(trans, 2), fixed(rot2, 2), fixed(to.x, 2), fixed(to.y, 2))} ${outcomesText} ${captionOf(viewModel)}`;
}

export function worldText(viewModel: ViewModel) {
  const { x, y, theta } = poseAt(viewModel.drifted.poses, 0);
  return words.decomposer.worldPicture(fixed(x, 2), fixed(y, 2), fixed(theta, 2), fixed(driftDistance(viewModel), 2));
}
