/** The Odometry Decomposer's readouts, sentences and text equivalents: statistics of the outcomes, and standard deviations against the length of the drive. */

import { html } from 'lit';
import { addEnglishMessages, words } from '../../messages/registry.ts';
import { formatMarkup } from '../../ui/controls.ts';
import { formatFixed, NO_VALUE, formatRounded, formatWithError } from '../../ui/format.ts';
import { plotHtml } from '../../ui/plot.ts';
import { readoutsHtml } from '../../ui/readouts.ts';
import { en } from './en.ts';
import { poseAt, type ViewModel } from './settings.ts';

addEnglishMessages({ decomposer: en });

/** Length of a reading, m, below which it is called jitter. */
const MAX_JITTER = 0.01;

export function captionOf({ config: { rule, alphas }, rules, legs, deviations, stats }: ViewModel) {
  const texts = words.decomposer.caption;
  const [{ legs: { rot1, trans } }] = rules;
  const isReverseAware = rule === 'nav2' || rule === 'beluga';
  const transMillimetres = formatFixed(1000 * trans, 1);
  if (alphas.every((alpha) => alpha === 0)) return texts.still;
  if (rule === 'omni') return texts.omni(formatFixed(deviations.strafe, 2));
  if (trans > 0 && trans < MAX_JITTER) return isReverseAware ? texts.restSpin(transMillimetres) : texts.rest(transMillimetres, formatFixed(rot1, 2));
  if (trans === 0) {
    const remainingTurn = Math.PI - Math.abs(legs.rot2);
    return isReverseAware && remainingTurn < Math.PI / 2 ? texts.spinEitherWay(formatFixed(remainingTurn, 2)) : texts.spin;
  }
  if (rule === 'thrun' && Math.abs(rot1) > Math.PI / 2 && Math.abs(legs.rot2) > Math.PI / 2) return texts.reverse;
  return texts.lever(formatFixed(deviations.rot1, 2), formatFixed(trans, 2), formatFixed(stats.exactCrossTrack, 2));
}

/** Returns the distance between the odometry's own pose and the predicted pose, m. */
export function driftDistanceOf({ drifted, linkage }: ViewModel) {
  const [odometryPose, predictedPose] = [poseAt(drifted.poses, 2), poseAt(linkage, 3)];
  return Math.hypot(odometryPose.x - predictedPose.x, odometryPose.y - predictedPose.y);
}

const formatMetres = (value: number) => `${formatFixed(value, 3)} m`;

/** Returns the headline: the ratio of the turn noise of Table 5.6 to the turn noise of Nav2. */
export function headlineHtml({ rules: [thrun, nav2] }: ViewModel) {
  const texts = words.decomposer.headline;
  const headingNoiseRatio = thrun.heading / nav2.heading;
  return readoutsHtml([[texts.expects, Number.isFinite(headingNoiseRatio) ? `${formatRounded(headingNoiseRatio, 2)} ×` : NO_VALUE, texts.noise]], 0);
}

/** Returns the readouts: the contribution of the first rotation, and the standard deviations of the outcomes. */
export function outcomeReadoutsHtml({ stats }: ViewModel) {
  const texts = words.decomposer.readouts;
  const { crossTrack, crossTrackError, exactCrossTrack, heading, headingError, exactHeading, independentHeading } = stats;
  const exactText = texts.exactly(formatFixed(exactHeading, 3));
  const independentText = texts.independent(formatFixed(exactHeading, 3), formatFixed(independentHeading, 3));
  return readoutsHtml([
    [texts.lever, formatMetres(stats.lever)],
    [texts.crossTrack, `${formatWithError(crossTrack, crossTrackError, 3)} m`, texts.exactly(formatMetres(exactCrossTrack))],
    [texts.heading, `${formatWithError(heading, headingError, 3)} rad`, exactHeading === independentHeading ? exactText : independentText],
  ]);
}

/** Number of points of the curves, about one for each pixel on a large screen. */
const CURVE_POINTS = 121;

export function spreadPlotHtml(curveOf: (longest: number, points: number) => Float64Array, { legs, stats }: ViewModel) {
  const texts = words.decomposer.plot;
  const maxLength = Math.max(1, 2 * legs.trans);
  const curveRows = curveOf(maxLength, CURVE_POINTS);
  const curveColumnOf = (index: number) => Float64Array.from({ length: CURVE_POINTS }, (_, i) => curveRows[4 * i + index]);
  const [x, crossTrack, lever, along] = [0, 1, 2, 3].map(curveColumnOf);
  const maxDeviation = Math.max(0.1, ...crossTrack, ...along, stats.crossTrack + stats.crossTrackError || 0);
  return html`<figure>
    <p class="panel-title">${texts.title}</p>
    ${plotHtml({
      label: texts.label(formatFixed(legs.trans, 2), formatFixed(stats.exactCrossTrack, 3)),
      x: { name: 'δ trans (m)', from: 0, to: maxLength },
      y: { name: 'σ (m)', from: 0, to: 1.08 * maxDeviation },
      curves: [
        { name: texts.crossTrack, role: 'prediction', x, y: crossTrack },
        { name: words.decomposer.readouts.lever, role: 'muted', dash: '2 4', x, y: lever },
        { name: texts.along, role: 'prior', dash: '7 4', x, y: along },
      ],
      points: [{ role: 'prediction', x: legs.trans, y: stats.crossTrack, error: stats.crossTrackError }],
      marks: [{ x: legs.trans, text: texts.here }],
    })}
    <figcaption>${formatMarkup(texts.caption)}</figcaption>
  </figure>`;
}
