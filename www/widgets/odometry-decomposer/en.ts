/** The Odometry Decomposer in English; see messages/en.ts. */

export const en = {
  title: 'The Odometry Decomposer',
  presets: {
    all: 'Turn, drive, turn',
    'turn-drive': 'Turn, drive',
    'drive-turn': 'Drive, turn',
    reverse: 'Reverse',
    spin: 'Spin',
    wheelJitter: 'At rest',
  },
  ruleNames: {
    thrun: 'Table 5.6',
    nav2: 'AMCL of Nav2',
    beluga: 'Beluga 2',
    omni: 'AMCL, omnidirectional',
  },
  settings: {
    rule: { name: 'Noise model' },
    correlation: {
      name: 'correlation of the rotations',
      effect: 'Between the noises of the two rotations: turns the outcomes where they stand and moves none.',
    },
    phase: { name: 'progress of the motion', effect: 'The first rotation up to 1, the drive up to 2, the second rotation up to 3.' },
    drift: { name: 'drift time', effect: 'Moves the odometry frame away from the world. The prediction stays.' },
    samples: { name: 'outcomes', effect: 'Outcomes: more of them narrow the error of what they measure.' },
  },
  playLabels: { phase: 'Play the motion', drift: 'Play the drift' },
  handles: { from: ['Odometry before', 'Heading before'], to: ['Odometry after', 'Heading after'] },
  legsTitle: 'One odometry reading, four noise models',
  worldTitle: 'In the world: odometry drifts',
  overlays: {
    legs: 'reading',
    deviation: '± *σ*',
    outcomes: 'outcomes',
    prediction: 'prediction *x*',
    odometry: 'odometry *x̄*',
    difference: 'drift *x̄* − *x*',
  },
  headline: { beforeRatio: 'Table 5.6 expects', afterRatio: 'the turn noise of Nav2’s AMCL' },
  outcomesLabel: (rule) => `outcomes by ${rule}`,
  spreadLabel: (rule) => `spread (2σ)\nby ${rule}`,
  readouts: {
    firstRotationDeviation: 'from the first rotation alone, *δ*_{trans} · *σ*(*δ*_{rot1})',
    acrossDeviation: '*σ* across the path, measured',
    headingDeviation: '*σ* of the heading, measured',
    exactValue: (exactNumber) => `exactly ${exactNumber}`,
    exactAndIndependentValues: (exactNumber, independentNumber) => `exactly ${exactNumber}; if independent ${independentNumber}`,
  },
  table: {
    caption: 'Standard deviations: of each part’s noise, then of the end, across the path and in *θ*. Bold on a tint: not as in Table 5.6 of *Probabilistic Robotics*.',
    columns: ['*δ*_{rot1} (rad)', '*δ*_{trans} (m)', '*δ*_{rot2} (rad)', 'side (m)', 'across (m)', '*θ* (rad)'],
  },
  captionSentences: {
    lever: (deviation, trans, lever) =>
      `The first rotation has the long lever: its ± ${deviation} rad at the start become ± ${lever} m across the path after ${trans} m.`,
    reverse: 'Reverse driving decomposes into two rotations beyond π/2. Table 5.6 adds noise for both; the others use min(|\u2060δ\u2060|,\u00a0π\u00a0−\u00a0|\u2060δ\u2060|).',
    wheelJitter: (trans, rot1) =>
      `The wheels stand still and their encoders jitter by ${trans} mm. Table 5.6 takes it for a rotation of ${rot1} rad, and adds noise for that.`,
    ignoredWheelJitter: (trans) => `Less than a centimetre: ${trans} mm has no direction in this noise model, so there is nearly no noise.`,
    spin: 'A turn on the spot is all in the second rotation. Only the noise of α₄ moves the robot.',
    spinFromEitherSide: (remainingTurn) => `Beyond a quarter turn this noise model uses what is left to a half turn, here ${remainingTurn} rad: a half turn on the spot has no noise.`,
    omnidirectional: (strafe) => `This noise model has no noise in the first rotation: the direction of travel is exact, and the robot is off by ± ${strafe} m sideways, however it turns.`,
    noNoise: 'Without noise every outcome is the reading.',
  },
  worldCaption: (driftDistance) =>
    `Only the motion from *x̄*_{t−1} to *x̄*_{t} enters: the prediction does not drift. The place *x̄*_{t} itself is off by ${driftDistance} m.`,
  correlationNote:
    'The noise models draw both rotations independently. A correlation *ρ* leaves the noise of each as it is and every outcome in its place; the headings spread from the difference of the two deviations (*ρ* = −1) to their sum (*ρ* = 1). At *ρ* = 0 neither is seen.',
  plot: {
    title: 'Spread against the length of the drive',
    acrossCurve: 'across the path, exact',
    alongCurve: 'along the path',
    readingMark: 'read',
    caption: 'The rotations as they were read. The point is that of the outcomes, with its standard error.',
  },
  readingDescription: (rot1, trans, rot2) => `The reading: a first rotation by ${rot1} rad, a drive of ${trans} m, a second rotation by ${rot2} rad`,
} satisfies import('../../messages/registry.ts').MessageEntry;
