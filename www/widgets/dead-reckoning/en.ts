/** Dead Reckoning in English; see messages/en.ts. */

import { formatCount } from '../../messages/en.ts';

export const en = {
  title: 'Dead Reckoning',
  presets: { chapter: 'The chapter’s 20 steps', doubled: 'Heading σ doubled', fine: 'Same path, 200 steps', straightDrive: 'Straight' },
  settings: {
    omega: { effect: 'How sharply each step bends: what is missing from the recursion grows with *ωΔt*.' },
    dt: { name: 'duration of a step', effect: 'How long a step takes; the path grows with it.' },
    step: { name: 'selected step' },
    steps: { name: 'steps', effect: 'The same path in more and shorter steps.' },
    headingNoise: { name: 'heading noise *α*₃ to *α*₆', effect: '*α*₃ and *α*₄; *α*₅ and *α*₆ are a quarter. They scale variances: times 4 doubles *σ*.' },
    compounding: { name: 'Recursion: predicts the spread step by step' },
    perNames: { name: 'α’s apply per' },
    samples: { name: 'robots', effect: 'The more robots, the narrower the bands.' },
  },
  drivenTime: (drivenSeconds, totalSeconds) => `t = ${drivenSeconds} s of ${totalSeconds} s`,
  recursions: { chapter: 'the chapter’s', 'first-order': 'with Jᵣ, the turn during a step', 'fourth-order': 'fourth order' },
  perNames: { step: 'step', path: 'whole path' },
  chartTitle: 'Predicted share of the robots’ variance, by step',
  floorTitle: 'On the floor, outlines at 2σ',
  atStepTitle: (step) => `Step ${step} in exponential coordinates`,
  overlays: {
    lateral: 'lateral',
    along: 'along the track',
    heading: 'heading',
    tolerance: 'within 5 %',
    command: 'command',
    measured: 'measured',
    ellipse: 'predicted in (x, y)',
    exponential: 'predicted in ξ',
  },
  alongAxisLabel: 'ξ along (m)',
  lateralAxisLabel: 'ξ lateral (m)',
  /** Notes after the name of the lateral axis: they name the axis with the larger scale, and the ratio of the scales. */
  enlargementNotes: { along: (scaleRatio) => `ξ along enlarged ${scaleRatio} times`, lateral: (scaleRatio) => `enlarged ${scaleRatio} times` },
  componentAdjectives: { along: 'along-track', lateral: 'lateral', heading: 'heading' },
  ratioAxisLabel: 'predicted / measured variance',
  stepAxisLabel: 'step',
  stepMark: (step) => `step ${step}`,
  /** Parts of the headline: the text before the ratio of predicted to measured variance, and the text after it. */
  beforeRatio: (component) => `predicted ${component} variance`,
  afterRatio: (ratioError, step, robotCount) => `${ratioError && `± ${ratioError} `}times the measured, at step ${step}, ${formatCount(robotCount, 'robot')}`,
  chartDescription: (recursion, step, ratioTexts) =>
    `Predicted over measured variance by step; recursion: ${recursion}. At step ${step}: ${ratioTexts}.`,
  wrongPrediction: (worstComponent, ratioList, endError, endComponent) => `At the end the predicted ${endComponent} variance is off by ${endError}. Before, the ${worstComponent} one is ${ratioList} of the measured one.`,
  correctPrediction: (robotCount) => `Within 5 % of what ${robotCount} robots do, in every component at every step.`,
  conditions: {
    noRobots: 'No robots yet.',
    noNoise: 'No noise: every robot is where it was told to be, without variance.',
    noCovariance: 'The fourth-order series gives no valid covariance: the noise is too large for it.',
    fewRobots: 'Too few robots to detect an error of 5 %: the bands are wider.',
  },
  missTable: {
    caption: 'Steps at which predicted and measured variance differ by more than 5 %, and the difference after the last step',
    componentHeader: 'component',
    noMiss: 'never',
    tooFewRobots: 'too few',
    stepRange: (firstStep, lastStep) => (firstStep === lastStep ? `step ${firstStep}` : `steps ${firstStep}–${lastStep}`),
    atEndLabel: (component) => `${component}, at the end`,
  },
  straightDrive: {
    title: 'Why bananas bend',
    alongCurve: 'along the track, *α*₁*v*²*Δt*²',
    acrossCurve: 'across it, ¼*α*₃*v*⁴*Δt*⁴',
    exactCurves: 'exact',
    varianceAxisLabel: 'variance (m²)',
    caption: 'Straight ahead at *v*, to first order and exactly. From the crossing on, (2/*v*)·√(*α*₁/*α*₃), heading decides, however good the encoders.',
  },
} satisfies import('../../messages/registry.ts').MessageEntry;
