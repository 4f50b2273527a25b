/** The Banana Machine in English; see messages/en.ts. */

import { plural } from '../../messages/en.ts';

export const en = {
  title: 'The Banana Machine',
  presets: { straight: 'Straight', gentle: 'Gentle arc', hard: 'Hard arc', pivot: 'Pivot', banana: 'Banana', worked: 'Worked example' },
  settings: {
    v: { effect: 'How far along the arc; below zero the robot backs up.' },
    omega: { effect: 'How sharply the arc bends; positive turns left.' },
    dt: { effect: 'How long it drives: errors spread on the way.' },
    model: { name: 'Motion model' },
    noise: { name: 'Noise' },
    alphas: {
      name: 'Noise parameters',
      /** One line for each α: the noise it adds to, its effect on the cloud, and the motion to watch for while it is raised from 0. */
      effects: {
        velocity: [
          ['v² into v̂', 'smears the cloud along the arc', 'smear along the arc'],
          ['ω² into v̂', 'smears it too, but only in turns', 'smear along the arc'],
          ['v² into ω̂', 'fans the cloud open and bends it; α₁ and α₂ blur it', 'fan'],
          ['ω² into ω̂', 'fans it too, but only in turns', 'fan'],
          ['v² into γ̂', 'turns each robot where it stopped', 'turn in place'],
          ['ω² into γ̂', 'turns each stopped robot, if ω ≠ 0', 'blur its headings'],
        ],
        odometry: [
          ['rotation into rotation', 'swings the cloud about the start', 'swing'],
          ['distance into rotation', 'fans the cloud, even on a straight', 'fan'],
          ['distance into distance', 'smears it along the line of travel', 'smear'],
          ['rotation into distance', 'smears it too, but only in turns', 'smear'],
        ],
      },
    },
    samples: { name: 'robots', effect: 'Robots sent: few are dots, many a density.' },
  },
  floor: 'On the floor',
  ellipseIs: { large: 'no ellipse fits', misshapen: 'the ellipse fits in size only', near: 'the ellipse nearly fits' },
  overlays: {
    command: 'commanded arc',
    ellipse: 'Gaussian in (x, y), 2σ',
    linearized: 'linearized (EKF), 2σ',
    additive: 'noise added to the pose, 2σ',
    exponential: 'Gaussian in ξ, 2σ',
  },
  notCarried: 'around the start, on the floor alone',
  modelGroup: 'Model',
  models: { velocity: 'velocity', odometry: 'odometry' },
  reverseAware: 'Reverse without half-turn noise',
  isolate: 'Isolate one α',
  only: (alpha) => `Only ${alpha}`,
  off: (value) => `${value} off`,
  notes: {
    still: 'The command is to stand still, and a robot at rest has no motion noise.',
    silent: 'Every α is 0: no noise at all, so every robot stops exactly where it was told to.',
    unfed: 'No α that is above 0 has anything to multiply in this command: no noise at all.',
    headings: 'Only γ̂ is noisy: every robot stops at the same point, and only the headings fan out.',
    circle: 'Some robots turn by nearly 2π. The logarithm is not unique there, so there are no statistics in ξ.',
    backwards: 'Odometry reads backing up as two half turns, and the table charges noise for both.',
    line: 'Only one noise moves the robots: they lie on a line, and an outline without area holds no share of them.',
  },
  alphaIsZero: (alpha) => `${alpha} is alone and 0: no noise at all. Turn it up.`,
  alphaIsSilent: (alpha, factor, cause, picture) =>
    `${alpha} multiplies ${factor}: no noise at all. Turn ${cause} up a little and watch it ${picture}.`,
  /** Factor of an α that has no effect, because this speed of the command is 0. */
  nothingToMultiply: {
    velocity: { v: 'v², and v is 0', ω: 'ω², and ω is 0' },
    odometry: { v: 'the squared distance, and it is 0', ω: 'the squared rotations, and they are 0' },
  },
  announcement: (robots, command, outcome) => `${robots} robots, ${command}. ${outcome}`,
  skew: (skew) => `Cross-track skew ${skew}.`,
  noSkew: 'No cross-track skew.',
  between: (share, command) => `${share} of the way from the floor to exponential coordinates. Commanded: ${command}.`,
  plane: (command) => `View of the floor from above, x to the right and y up. Commanded: ${command}.`,
  drawnOver: (overlays) => `Drawn over it: ${overlays}.`,
  noRobots: 'No robots yet.',
  oneRobot: 'One robot.',
  mean: (robots, x, y) => `${robots} robots end around x ${x} m, y ${y} m.`,
  onePlace: (robots, x, y) => `All ${robots} end at one place, x ${x} m, y ${y} m.`,
  spread: (x, y) => `Standard deviations ${x} m in x and ${y} m in y.`,
  bend: {
    unsure: (skew, exactly) => `Too few robots to show the lean: skew ${skew}, exactly ${exactly}.`,
    hardly: (skew, exactly) => `Both sides are nearly alike: skew ${skew}, exactly ${exactly}.`,
    neither: (skew) => `Both sides are alike: skew ${skew}, exactly 0 by symmetry.`,
    /** Text before the sentence on the skew. */
    wide: (ratio) => `The cloud is bent: its ellipse covers ${ratio} times the area of the ξ outline.`,
    gains: (gain, isBent) => `${isBent ? 'Bent: the' : 'The'} ξ outline fits better by ${gain} nats per robot.`,
    bowTie: {
      velocity: (speed, deviation, skew) =>
        `A bow-tie: turning adds noise α₂ω² to the speed. v̂ is ${speed}\u00a0±\u00a0${deviation}\u00a0m/s, so robots end ahead of the start and behind it. Skew ${skew}.`,
      odometry: (length, deviation, skew) =>
        `A bow-tie: the rotations’ noise α₄ spreads a drive of ${length} m by ${deviation} m, ahead of the start and behind it. Skew ${skew}.`,
    },
    right: (skew) => `The cloud is bent, with its tail to the right of the mean heading: skew ${skew}, where any Gaussian in (x, y) has 0.`,
    left: (skew) => `The cloud is bent, with its tail to the left of the mean heading: skew ${skew}, where any Gaussian in (x, y) has 0.`,
  },
  fewRobots: 'Too few robots for a skew.',
  robotsHere: (count, printed) => `${printed} ${plural(count, 'robot')} here`,
  exactSkew: (skew) => `exact skew ${skew}`,
  noExactSkew: 'no exact skew',
  twist: 'Same robots, exponential coordinates ξ',
  twistIs: {
    odometry:
      'only roughly a Gaussian. Odometry noise enters in a turn, a drive and a turn, not along one arc, and the predicted skew misses.',
    triangular: 'no longer bent, though triangular noise is not Gaussian.',
    turned: 'nearly a Gaussian. What keeps it from being one is γ̂, which turns a robot after its arc.',
    exact: 'exactly a Gaussian, whose outline is an ellipse.',
  },
  twistAxes: 'ξ along to the right and ξ heading up',
  twistMoments: (along, heading, deviationAlong, deviationHeading, share) =>
    `Mean ${along} m and ${heading} rad, standard deviations ${deviationAlong} m and ${deviationHeading} rad.` +
    (share && ` ${share} lie inside the 2σ ellipse.`),
  axisAlong: 'ξ along (m)',
  axisHeading: 'ξ heading (rad)',
  morph: {
    name: 'From the floor to exponential coordinates',
    play: 'Play the morph',
    title: 'On the way to exponential coordinates',
    floor: 'floor',
    twist: 'exponential coordinates',
    text: (share) => `${share} of the way to exponential coordinates`,
  },
  /** Texts in the picture, with line breaks. */
  callouts: ['only the ellipse\ncovers this floor', 'no robot\nstops here'],
  handle: 'End of the commanded arc',
  handleKeys: 'Arrow keys move it over the floor, with Shift by larger steps; Page Up and Page Down move it far in y, Home and End to the ends along x',
  handleTitle: 'Drag the end of the arc',
  handleHint: 'drag me',
  pin: 'Pin',
  unpin: 'Unpin',
  pinned: 'pinned',
  pinTitle: 'Keep these outlines and numbers to compare with',
  pinNotInCode: 'The pinned outlines are not in it.',
  slidersEnd: 'The sliders end here',
  chart: 'Exact cross-track skew against commanded ω, for the present noise',
  chartAxis: 'cross-track skew',
  chartMarker: 'Commanded ω on the chart',
  chartText: (omega, skew) => `ω = ${omega} rad/s, ${skew}`,
  chartCaption:
    'Exact skew against commanded *ω*, and the robots’ own with its standard error. The dashed line is any Gaussian in *(x, y)*. ' +
    'At *ω* = 0 it is 0 by symmetry, however bent the cloud is: see the gain in fit.',
  chartGaussian: 'any Gaussian in *(x, y)*',
  readouts: {
    skew: 'cross-track skew',
    exactly: (value) => `exactly ${value}`,
    unwrapped: (value) => `exactly ${value} without wrapping at ±π`,
    gain: 'gain in fit by *ξ* (nats per robot)',
    gainOnFloor: 'gain in fit on the floor (nats per robot)',
    nat: '1 nat: a factor of *e*',
    withoutLimit: 'in *ξ* without limit, as there is no *γ̂*',
    onLine: 'no limit: in *ξ* all on one line',
    area: 'area covered: ellipse / *ξ* outline',
    areaDetail: (error, ellipse, exponential) => `${error && `± ${error}; `}inside: ellipse ${ellipse}, outline ${exponential}`,
    gaussian: 'skew that the Gaussian in *ξ* predicts',
    rho: 'correlation *ρ* of lateral place and heading',
    robots: 'robots shown, *n* of *N*',
    exactArea: 'exact area ratio',
    nominal: 'of any Gaussian inside its 2σ ellipse',
  },
  gainIs:
    'Gain in fit: the robots’ mean log-likelihood under the Gaussian in *ξ*, less that under the one in *(x, y, θ)*. ' +
    'On the floor *θ* is left out: a Gaussian in length and turn of the arc to each place, against one in *(x, y)*.',
  nOfAll: (count, total) => `${count} of ${total}`,
  robot: 'Robot',
  markHint: 'Point at one in either view to mark it in both.',
  table: {
    caption:
      'Moments of the pose: linearized at the command, as an extended Kalman filter (EKF) does, exact, and measured on the robots shown. Metres and radians.',
    twistCaption: 'Moments in exponential coordinates: of the command with its noise, and measured.',
    quantity: 'quantity',
    linearized: 'linearized',
    exact: 'exact',
    measured: 'measured',
    command: 'command',
    mean: (symbol) => `mean ${symbol}`,
    variance: (symbol) => `variance of ${symbol}`,
    skew: 'cross-track skew',
    axes: ['*ξ* along', '*ξ* lateral', '*ξ* heading'],
  },
} satisfies import('../../messages/registry.ts').Message;
