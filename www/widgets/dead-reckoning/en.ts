/** Dead Reckoning in English; see messages/en.ts. */

import { formatCount } from '../../messages/en.ts';

export const en = {
  title: 'Dead Reckoning',
  presets: { chapter: 'The chapter’s 20 steps', doubled: 'Heading σ doubled', fine: 'Same path, 200 steps', straight: 'Straight' },
  settings: {
    omega: { effect: 'How sharply each step bends: what is missing from the recursion grows with *ωΔt*.' },
    dt: { name: 'duration of a step', effect: 'How long a step takes; the path grows with it.' },
    step: { name: 'selected step' },
    steps: { name: 'steps', effect: 'The same path in more and shorter steps.' },
    headingNoise: { name: 'heading noise *α*₃ to *α*₆', effect: '*α*₃ and *α*₄; *α*₅ and *α*₆ are a quarter. They scale variances: times 4 doubles *σ*.' },
    compounding: { name: 'Recursion' },
    per: { name: 'α’s apply per' },
    samples: { name: 'robots', effect: 'The more robots, the narrower the bands.' },
  },
  walked: (time, duration) => `t = ${time} s of ${duration} s`,
  recursions: { chapter: 'the chapter’s', 'first-order': 'with Jᵣ, the turn during a step', 'fourth-order': 'fourth order' },
  per: { step: 'step', path: 'whole path' },
  chart: 'Predicted share of the robots’ variance, by step',
  floor: 'On the floor, outlines at 2σ',
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
  axisAlong: 'ξ along (m)',
  axisLateral: 'ξ lateral (m)',
  /** Note on the axis with the larger scale, after the name of the lateral axis. */
  stretched: { along: (factor) => `ξ along enlarged ${factor} times`, lateral: (factor) => `enlarged ${factor} times` },
  of: { along: 'along-track', lateral: 'lateral', heading: 'heading' },
  ratioAxis: 'predicted / measured variance',
  stepAxis: 'step',
  atStepMark: (step) => `step ${step}`,
  /** Before the ratio, and after it. */
  predicted: (component) => `predicted ${component} variance`,
  ofMeasured: (error, step, robots) => `${error && `± ${error} `}of the measured, at step ${step}, ${formatCount(robots, 'robot')}`,
  ratioText: (recursion, step, ratios) =>
    `Predicted over measured variance by step; recursion: ${recursion}. At step ${step}: ${ratios}.`,
  wrong: (worst, list, end, far) => `At the end the predicted ${far} variance is off by ${end}. Before, the ${worst} one is ${list} of the measured one.`,
  right: (robots) => `Within 5 % of what ${robots} robots do, in every component at every step.`,
  conditions: {
    none: 'No robots yet.',
    still: 'No noise: every robot is where it was told to be, without variance.',
    lost: 'The fourth order has left no covariance: too much noise for a series.',
    few: 'Too few robots to tell 5 %: the bands are wider than that.',
  },
  plane: (command, steps, robots, step, x, y, recursion) =>
    `View of the floor from above, x to the right and y up. ${formatCount(robots, 'robot')} ${robots === '1' ? 'drives' : 'drive'} ${formatCount(steps, 'step')} of ${command}. Clouds grow along the path; after step ${step} the command is at x ${x} m, y ${y} m. Outlines by the recursion: ${recursion}.`,
  stepText: (step, measured, predicted) =>
    `Step ${step} in exponential coordinates, ξ along to the right and ξ lateral up. Standard deviations measured ${measured[0]} m and ${measured[1]} m, predicted ${predicted[0]} m and ${predicted[1]} m.`,
  misses: {
    caption: 'Steps at which predicted and measured variance differ by more than 5 %, and the difference after the last step',
    component: 'component',
    never: 'never',
    unknown: 'too few',
    from: (first, last) => (first === last ? `step ${first}` : `steps ${first}–${last}`),
    endOf: (component) => `${component}, at the end`,
  },
  straight: {
    title: 'Why bananas bend',
    label: (crossing) => `Variances of a straight drive against its duration, on logarithmic axes. ${crossing}`,
    crossing: (duration) => `Equal to first order after ${duration} s.`,
    never: 'They never cross.',
    along: 'along the track, *α*₁*v*²*Δt*²',
    across: 'across it, ¼*α*₃*v*⁴*Δt*⁴',
    exact: 'exact',
    y: 'variance (m²)',
    caption: 'Straight ahead at *v*, to first order and exactly. From the crossing on, (2/*v*)·√(*α*₁/*α*₃), heading decides, however good the encoders.',
  },
  robot: 'Robot',
  markHint: 'Point at one on the floor to see its way.',
} satisfies import('../../messages/registry.ts').Message;
