/** The Banana Machine in English; see messages/en.ts. */

import { formatCount } from '../../messages/en.ts';

export const en = {
  title: 'The Banana Machine',
  presets: { straight: 'Straight', gentle: 'Gentle arc', hard: 'Hard arc', pivot: 'Pivot', banana: 'Banana', worked: 'Worked example' },
  settings: {
    model: { name: 'Motion model' },
    noise: { name: 'Noise' },
    morph: { name: 'from the floor to exponential coordinates' },
    samples: { name: 'robots', effect: 'Robots sent: few are dots, many a density.' },
  },
  floorTitle: 'On the floor',
  ellipseDescriptions: { tooLarge: 'no ellipse fits', wrongShape: 'the ellipse fits in size only', nearlyFitting: 'the ellipse nearly fits' },
  overlays: {
    command: 'commanded arc',
    ellipse: 'Gaussian in (x, y), 2σ',
    linearized: 'linearized (EKF), 2σ',
    additive: 'noise added to the pose, 2σ',
    exponential: 'Gaussian in ξ, 2σ',
  },
  modelGroupTitle: 'Model',
  modelNames: { velocity: 'velocity', odometry: 'odometry' },
  reverseAwareLabel: 'Reverse without half-turn noise',
  isolateLabel: 'Isolate one α',
  isolateAlphaLabel: (alphaName) => `Only ${alphaName}`,
  ignoredAlphaText: (alphaText) => `${alphaText} off`,
  notes: {
    standingStill: 'The command is to stand still, and a robot at rest has no motion noise.',
    noNoise: 'No α above 0 has a motion to multiply: no noise at all, so every robot stops exactly where it was told to.',
    onlyHeadings: 'Only γ̂ is noisy: every robot stops at the same point, and only the headings fan out.',
    fullTurns: 'Some robots turn by nearly 2π. The logarithm is not unique there, so there are no statistics in ξ.',
    reverseDrive: 'Odometry reads a drive in reverse as two half turns, and the table adds noise for both.',
    onLine: 'Only one noise displaces the robots: they lie on a line, and an outline without area contains none of them.',
  },
  noRobotsNote: 'No robots yet.',
  skewSentences: {
    tooFewRobots: (skew, exactSkew) => `Too few robots to show the lean: skew ${skew}, exactly ${exactSkew}.`,
    nearlySymmetric: (skew, exactSkew) => `Both sides are nearly alike: skew ${skew}, exactly ${exactSkew}.`,
    symmetric: (skew) => `Both sides are alike: skew ${skew}, exactly 0 by symmetry.`,
    /** Sentence on an ellipse that is too large. The sentence on the skew follows it. */
    largeEllipse: (areaRatio) => `The cloud is bent: its ellipse covers ${areaRatio} times the area of the ξ outline.`,
    betterFit: (likelihoodRatio, isBent) => `${isBent ? 'Bent: the' : 'The'} Gaussian in ξ fits better: a robot is ${likelihoodRatio} times as likely.`,
    bowTie: (driveLength, deviation, skew) =>
      `A bow-tie: noise spreads a drive of ${driveLength} m by ${deviation} m, ahead of the start and behind it. Skew ${skew}.`,
    bent: (skew, isLeft) => `The cloud is bent, with its tail to the ${isLeft ? 'left' : 'right'} of the mean heading: skew ${skew}, where any Gaussian in (x, y) has 0.`,
  },
  fewRobotsNote: 'Too few robots for a skew.',
  robotCountLabel: (robotCount) => `${formatCount(robotCount, 'robot')} here`,
  twistTitle: 'Same robots, exponential coordinates ξ',
  twistDescriptions: {
    odometry:
      'only roughly a Gaussian. Odometry noise enters in a turn, a drive and a turn, not along one arc, and the predicted skew misses.',
    triangular: 'no longer bent, though triangular noise is not Gaussian.',
    lastTurn: 'nearly a Gaussian. What keeps it from being one is γ̂, which turns a robot after its arc.',
    exact: 'exactly a Gaussian, whose outline is an ellipse.',
  },
  alongAxisLabel: 'ξ along (m)',
  headingAxisLabel: 'ξ heading (rad)',
  morph: {
    playLabel: 'Play the morph',
    morphingTitle: 'On the way to exponential coordinates',
    morphedTitle: 'The floor, morphed to exponential coordinates ξ',
  },
  /** Texts of the callouts in the picture. They contain line breaks. */
  callouts: ['only the ellipse\ncovers this floor', 'no robot\nstops here'],
  handleName: 'End of the commanded arc',
  handleKeysHint: 'Arrow keys move it over the floor, with Shift by larger steps; Page Up and Page Down move it far in y, Home and End to the ends along x',
  dragHint: 'drag me',
  pinLabel: 'Pin to compare',
  unpinLabel: 'Unpin',
  pinnedLabel: 'pinned',
  pinTooltip: 'Keep these outlines and numbers for comparison',
  sliderLimitText: 'The sliders end here',
  chartDescription: 'Exact cross-track skew against commanded ω, for the present noise',
  chartSliderName: 'Commanded ω on the chart',
  chartSliderText: (omega, skew) => `ω = ${omega} rad/s, exact skew ${skew}`,
  chartCaption:
    'Exact skew against commanded *ω*, and the robots’ own with its standard error. The dashed line is any Gaussian in *(x, y)*. ' +
    'At *ω* = 0 it is 0 by symmetry, however bent the cloud is: see the gain in fit.',
  gaussianLineName: 'any Gaussian in *(x, y)*',
  readouts: {
    skew: 'cross-track skew',
    exactValue: (value) => `exactly ${value}`,
    exactUnwrappedValue: (value) => `exactly ${value} without wrapping at ±π`,
    gain: 'gain in fit by *ξ* (log-likelihood, nats per robot)',
    gainOnFloor: 'gain in fit on the floor (log-likelihood, nats per robot)',
    likelihoodNote: (likelihoodRatio) => `a robot is ${likelihoodRatio} times as likely`,
    unlimitedGain: 'in *ξ* without limit, as there is no *γ̂*',
    unlimitedGainOnLine: 'no limit: in *ξ* all on one line',
    areaRatio: 'area covered: ellipse / *ξ* outline',
    areaRatioDetail: (ratioError, ellipse, exponential) => `${ratioError && `± ${ratioError}; `}inside: ellipse ${ellipse}, outline ${exponential}`,
    gaussianSkew: 'skew that the Gaussian in *ξ* predicts',
    headingCorrelation: 'correlation *ρ* of lateral position and heading',
    shownRobots: 'robots shown, *n* of *N*',
    nominalCoverage: 'of any Gaussian inside its 2σ ellipse',
  },
  gainNote:
    'Gain in fit: the robots’ mean log-likelihood under the Gaussian in *ξ*, less that under the one in *(x, y, θ)*. ' +
    'On the floor *θ* is left out: a Gaussian in length and turn of the arc to each place, against one in *(x, y)*.',
  countOfTotal: (count, totalCount) => `${count} of ${totalCount}`,
  robot: 'Robot',
  markHint: 'Point at one in either view to mark it in both.',
  table: {
    caption:
      'Moments of the pose: linearized at the command, as an extended Kalman filter (EKF) does, exact, and measured on the robots shown. Metres and radians.',
    quantity: 'quantity',
    linearized: 'linearized',
    exact: 'exact',
    measured: 'measured',
    mean: (symbol) => `mean ${symbol}`,
  },
} satisfies import('../../messages/registry.ts').MessageEntry;
