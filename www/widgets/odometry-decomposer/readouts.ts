/** Readouts of the Odometry Decomposer and their text alternatives: statistics of the outcomes, and standard deviations over the length of the drive. */

import { html } from 'lit';
import { addEnglishMessages, words } from '../../messages/registry.ts';
import { formatMarkup } from '../../ui/controls.ts';
import { formatFixed, NO_VALUE, formatRounded, formatWithError } from '../../ui/format.ts';
import { plotHtml } from '../../ui/plot.ts';
import { readoutsHtml } from '../../ui/readouts.ts';
import { en } from './en.ts';
import { poseAt, type ViewModel } from './settings.ts';

addEnglishMessages({ decomposer: en });

/** Length (m) of a drive below which the caption calls an odometry reading jitter of the encoders. */
const MAX_JITTER_LENGTH = 0.01;

export function captionOf({ config: { rule, alphas }, rules, legs, deviations, stats }: ViewModel) {
  const texts = words.decomposer.captionSentences;
  const [{ legs: { rot1, trans } }] = rules;
  const isReverseAware = rule === 'nav2' || rule === 'beluga';
  const transMillimetres = formatFixed(1000 * trans, 1);
  if (alphas.every((alpha) => alpha === 0)) return texts.noNoise;
  if (rule === 'omni') return texts.omnidirectional(formatFixed(deviations.strafe, 2));
  if (trans > 0 && trans < MAX_JITTER_LENGTH) return isReverseAware ? texts.ignoredWheelJitter(transMillimetres) : texts.wheelJitter(transMillimetres, formatFixed(rot1, 2));
  if (trans === 0) {
    const remainingTurn = Math.PI - Math.abs(legs.rot2);
    return isReverseAware && remainingTurn < Math.PI / 2 ? texts.spinFromEitherSide(formatFixed(remainingTurn, 2)) : texts.spin;
  }
  if (rule === 'thrun' && Math.abs(rot1) > Math.PI / 2 && Math.abs(legs.rot2) > Math.PI / 2) return texts.reverse;
  return texts.lever(formatFixed(deviations.rot1, 2), formatFixed(trans, 2), formatFixed(stats.exactCrossTrack, 2));
}

/** Returns the distance (m) between the pose that odometry reports and the predicted pose. */
export function driftDistanceOf({ drifted, linkage }: ViewModel) {
  const [odometryPose, predictedPose] = [poseAt(drifted.poses, 2), poseAt(linkage, 3)];
  return Math.hypot(odometryPose.x - predictedPose.x, odometryPose.y - predictedPose.y);
}

const formatMetres = (lengthMetres: number) => `${formatFixed(lengthMetres, 3)} m`;

/** Returns the headline: the ratio of the turn noise of Table 5.6 to the turn noise of Nav2. */
export function headlineHtml({ rules: [thrun, nav2] }: ViewModel) {
  const texts = words.decomposer.headline;
  const headingNoiseRatio = thrun.heading / nav2.heading;
  return readoutsHtml([[texts.beforeRatio, Number.isFinite(headingNoiseRatio) ? `${formatRounded(headingNoiseRatio, 2)} ×` : NO_VALUE, texts.afterRatio]], 0);
}

/** Returns the readouts: the lateral standard deviation due to the first rotation, and the standard deviations of the outcomes. */
export function outcomeReadoutsHtml({ stats }: ViewModel) {
  const texts = words.decomposer.readouts;
  const { crossTrack, crossTrackError, exactCrossTrack, heading, headingError, exactHeading, independentHeading } = stats;
  const exactText = texts.exactValue(formatFixed(exactHeading, 3));
  const independentText = texts.exactAndIndependentValues(formatFixed(exactHeading, 3), formatFixed(independentHeading, 3));
  return readoutsHtml([
    [texts.firstRotationDeviation, formatMetres(stats.lever)],
    [texts.acrossDeviation, `${formatWithError(crossTrack, crossTrackError, 3)} m`, texts.exactValue(formatMetres(exactCrossTrack))],
    [texts.headingDeviation, `${formatWithError(heading, headingError, 3)} rad`, exactHeading === independentHeading ? exactText : independentText],
  ]);
}

/** Number of points of each curve. On a large screen, that is about one point per pixel. */
const CURVE_POINT_COUNT = 121;

export function spreadPlotHtml(readCurve: (maxLength: number, pointCount: number) => Float64Array, { legs, stats }: ViewModel) {
  const texts = words.decomposer.plot;
  const maxLength = Math.max(1, 2 * legs.trans);
  const curveNumbers = readCurve(maxLength, CURVE_POINT_COUNT);
  const curveColumnOf = (columnIndex: number) => Float64Array.from({ length: CURVE_POINT_COUNT }, (_, i) => curveNumbers[4 * i + columnIndex]);
  const [driveLengths, acrossDeviations, leverDeviations, alongDeviations] = [0, 1, 2, 3].map(curveColumnOf);
  const maxDeviation = Math.max(0.1, ...acrossDeviations, ...alongDeviations, stats.crossTrack + stats.crossTrackError || 0);
  return html`<figure>
    <p class="panel-title">${texts.title}</p>
    ${plotHtml({
      plotLabel: `${texts.title}, ${texts.acrossCurve}: ${formatMetres(stats.exactCrossTrack)}`,
      x: { axisLabel: 'δ trans (m)', min: 0, max: maxLength },
      y: { axisLabel: 'σ (m)', min: 0, max: 1.08 * maxDeviation },
      plotCurves: [
        { name: texts.acrossCurve, colourRole: 'prediction', x: driveLengths, y: acrossDeviations },
        { name: words.decomposer.readouts.firstRotationDeviation, colourRole: 'muted', dash: [2, 4], x: driveLengths, y: leverDeviations },
        { name: texts.alongCurve, colourRole: 'prior', dash: [7, 4], x: driveLengths, y: alongDeviations },
      ],
      dataPoints: [{ colourRole: 'prediction', x: legs.trans, y: stats.crossTrack, error: stats.crossTrackError }],
      verticalMarks: [{ x: legs.trans, text: texts.readingMark }],
    })}
    <figcaption>${formatMarkup(texts.caption)}</figcaption>
  </figure>`;
}
