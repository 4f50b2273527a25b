/**
 * Every word of the elements, in English. A message with values in it is a function of them; numbers
 * come printed, save where their size decides on the words. *Stars* make italics, subscript digits
 * subscripts, where HTML is shown.
 *
 * @module
 */

/**
 * @param {number} count
 * @param {string} word
 */
const plural = (count, word) => `${word}${count === 1 ? '' : 's'}`;

/**
 * A sentence on an α that has nothing to multiply.
 *
 * @param {string} zero
 * @param {string} cause
 * @param {string} picture what turning that up would show
 */
const silent = (zero, cause, picture) =>
  `${zero}: no noise at all. Turn ${cause} up a little and watch it ${picture}.`;

/**
 * @typedef {string | ((...values: any[]) => string) | Message[] | { [key: string]: Message }} Message
 */

export const en = /** @satisfies {Message} */ ({
  failure: (reason) => `This interactive figure cannot run here. ${reason}`,
  play: 'Play',
  pause: 'Pause',
  step: 'Step',
  reset: 'Reset',
  newSeed: 'New seed',
  seed: (seed) => `seed ${seed}`,
  commandText: (v, omega, dt) =>
    `v = ${v} m/s, ω = ${omega} rad/s, Δt = ${dt} s`,
  command: 'Command',
  speed: 'v, commanded speed',
  turnRate: 'ω, commanded turn rate',
  duration: 'Δt, duration',
  exports: {
    label: 'Save the figure',
    png: 'PNG',
    svg: 'SVG',
    csv: 'CSV',
    pngTitle: 'The picture in twice the pixels of the screen',
    svgTitle: 'The picture as vector graphics',
    csvTitle: 'Every sample, with the parameters and the seed',
  },
  copies: {
    label: 'Share the figure',
    link: 'Copy link',
    linkTitle: 'The address of this page with the figure as it is now',
    code: 'Copy embed code',
    codeTitle: 'HTML that shows the figure as it is now on a page of your own',
    done: 'Copied.',
    byHand: 'Copy it from here:',
  },
  banana: {
    title: 'The Banana Machine',
    presets: { straight: 'Straight', gentle: 'Gentle arc', hard: 'Hard arc', pivot: 'Pivot' },
    cloud: {
      legend: 'Cloud',
      play: 'Grow the cloud',
      step: (batch) => `Add ${batch} robots`,
      reset: 'Empty the cloud; the same seed sends the same robots',
      reseed: 'Send other robots',
      count: 'N, robots in the whole cloud',
      effect: 'Robots sent: dots with headings while they are few, a density when they are many.',
    },
    overlaysLabel: 'Overlays',
    overlays: {
      command: 'commanded arc',
      ellipse: '2σ Gaussian in (x, y)',
      linearized: 'linearized (EKF) ellipse',
      exponential: '2σ Gaussian in exponential coordinates',
    },
    effects: {
      v: 'How far along the arc; below zero the robot backs up.',
      omega: 'How sharply the arc bends; positive turns left.',
      dt: 'How long it drives: errors spread on the way.',
    },
    modelAndNoise: 'Model and noise',
    model: 'Motion model',
    models: { velocity: 'velocity', odometry: 'odometry' },
    noise: 'Noise',
    noises: { normal: 'normal', triangular: 'triangular' },
    alphas: 'Noise parameters',
    isolate: 'Isolate one',
    only: (alpha) => `Only ${alpha}`,
    off: (value) => `${value} off`,
    /** One line for each α: the noise it feeds, and what that does to the picture. */
    alphaEffects: {
      velocity: [
        ['v² into v̂', 'smears the cloud along the arc'],
        ['ω² into v̂', 'smears it too, but only in turns'],
        ['v² into ω̂', 'fans the cloud open and bends it'],
        ['ω² into ω̂', 'fans it too, but only in turns'],
        ['v² into γ̂', 'turns each robot where it stopped'],
        ['ω² into γ̂', 'turns it too, but only in turns'],
      ],
      odometry: [
        ['rotation into rotation', 'swings the cloud about the start'],
        ['distance into rotation', 'fans the cloud, even on a straight'],
        ['distance into distance', 'smears it along the line of travel'],
        ['rotation into distance', 'smears it too, but only in turns'],
      ],
    },
    notes: {
      still: 'The command is to stand still, and a robot at rest has no motion noise.',
      silent: 'Every α is 0: no noise at all, so every robot stops exactly where it was told to.',
      unfed: 'No α that is above 0 has anything to multiply in this command: no noise at all.',
      headings: 'Only γ̂ is noisy: every robot stops at the same point, and only the headings fan out.',
      circle:
        'Some robots turn nearly a full circle. Exponential coordinates end there, and their figures with them.',
      backwards: 'Odometry reads backing up as two half turns, and the table charges noise for both.',
      line: 'Only one number is noisy: the robots lie on a line, and an outline without area holds no share of them.',
    },
    alphaIsZero: (alpha) => `${alpha} is alone and 0: no noise at all. Turn it up.`,
    /** For each α what feeds it and is 0, and what turning that up would show. */
    alphaIsSilent: {
      velocity: [
        silent('α₁ multiplies v², and v is 0', 'v', 'smear along the arc'),
        silent('α₂ multiplies ω², and ω is 0', 'ω', 'smear along the arc'),
        silent('α₃ multiplies v², and v is 0', 'v', 'fan'),
        silent('α₄ multiplies ω², and ω is 0', 'ω', 'fan'),
        silent('α₅ multiplies v², and v is 0', 'v', 'turn in place'),
        silent('α₆ multiplies ω², and ω is 0', 'ω', 'blur its headings'),
      ],
      odometry: [
        silent('α₁ multiplies the squared rotations, and they are 0', 'ω', 'swing'),
        silent('α₂ multiplies the squared distance, and it is 0', 'v', 'fan'),
        silent('α₃ multiplies the squared distance, and it is 0', 'v', 'smear'),
        silent('α₄ multiplies the squared rotations, and they are 0', 'ω', 'smear'),
      ],
    },
    announcement: (robots, command, outcome) =>
      `${robots} robots, ${command}. ${outcome}`,
    skew: (skew) => `Cross-track skew ${skew}.`,
    noSkew: 'Cross-track skew undefined.',
    plane: (command) =>
      `View of the floor from above, x to the right and y up. Commanded: ${command}.`,
    drawnOver: (overlays) => `Drawn over it: ${overlays}.`,
    noRobots: 'No robots yet.',
    oneRobot: 'One robot.',
    mean: (robots, x, y) =>
      `${robots} robots end around x ${x} m, y ${y} m.`,
    spread: (x, y) => `Standard deviations ${x} m in x and ${y} m in y.`,
    bend: {
      unsure: (skew) => `Too few robots to tell to which side the cloud leans: skew ${skew}.`,
      hardly: (skew) => `The cloud hardly leans to either side: skew ${skew}.`,
      right: (skew) =>
        `The cloud is bent, with its tail to the right of the mean heading: skew ${skew}.`,
      left: (skew) =>
        `The cloud is bent, with its tail to the left of the mean heading: skew ${skew}.`,
    },
    fewRobots: 'Too few robots for a skew.',
    robotsHere: (count, printed) =>
      `${printed} ${plural(count, 'robot')} here`,
    exactSkew: (skew) => `exact skew ${skew}`,
    noExactSkew: 'exact skew undefined',
    twist: 'The same robots in exponential coordinates',
    twistIs: {
      odometry:
        'only roughly a Gaussian. Odometry noise enters at three hinges, not along one arc, and the predicted skew misses.',
      triangular: 'no longer bent, though triangular noise is not Gaussian.',
      turned: 'nearly a Gaussian. What keeps it from being one is γ̂, which turns a robot after its arc.',
      exact: 'exactly a Gaussian, whose outline is an ellipse.',
    },
    twistAxes: 'ξ along to the right and ξ heading up',
    twistMoments: (along, heading, deviationAlong, deviationHeading, share) =>
      `Mean ${along} m and ${heading} rad, standard deviations ${deviationAlong} m and ${deviationHeading} rad. ` +
      `${share} lie inside the 2σ ellipse.`,
    axisAlong: 'ξ along (m)',
    axisHeading: 'ξ heading (rad)',
    handle: 'End of the commanded arc',
    handleKeys: 'Arrow keys move it over the floor',
    handleTitle: 'Drag the end of the arc',
    chart: 'Exact cross-track skew against commanded ω, for the present noise',
    chartAxis: 'cross-track skew',
    chartMarker: 'Commanded ω on the chart',
    chartText: (omega, skew) => `ω = ${omega} rad/s, ${skew}`,
    chartCaption:
      'Exact skew against commanded *ω*, and the robots’ own with its standard error. The dashed line is any Gaussian in *(x, y)*.',
    readouts: {
      skew: 'cross-track skew ± standard error',
      gaussian: 'skew, exponential-coordinate Gaussian',
      plane: 'skew, any Gaussian in *(x, y)*',
      rho: '*ρ*(cross-track, heading)',
      robots: 'robots shown, *n* of *N*',
      exponential: 'inside 2σ, exponential coordinates',
      ellipse: 'inside 2σ, Gaussian in *(x, y)*',
      nominal: 'inside 2σ, nominal',
    },
    nOfAll: (n, all) => `${n} of ${all}`,
    robot: 'Robot',
    markHint: 'Point at one in either view to mark it in both.',
    table: {
      caption:
        'Moments of the pose: linearized at the command, exact, and measured on the robots shown. Metres and radians.',
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
  },
  squeeze: {
    title: 'Map Squeeze',
    presets: { doorway: 'Facing a doorway', wall: 'Facing a wall', corridor: 'Open corridor' },
    samplers: { endpoint: 'endpoint', 'whole-arc': 'whole arc', 'sub-stepped': 'sub-stepped' },
    samplerEffects: {
      endpoint: 'Keeps a draw if the robot fits where it ends; nobody asks how it got there.',
      'whole-arc': 'Keeps a draw if the robot touches no wall all along the arc it drove.',
      'sub-stepped':
        'Splits the command into *k* parts and keeps a part if the robot fits where that ends. At the doorway and in the corridor fewer pass a wall as *k* grows; facing the wall a larger share does, until the robot is stuck.',
      off: 'Off: every draw is kept, wherever it ends.',
    },
    cloud: {
      legend: 'Samples',
      play: 'Draw one after the other',
      step: (batch) => `Draw ${batch} more`,
      reset: 'Take all away; the same seed draws the same again',
      reseed: 'Draw others',
      count: 'N, samples',
      effect: 'Motions tried: more of them narrow the interval of the share through a wall.',
    },
    place: 'Place',
    view: 'View',
    views: { whole: 'whole map', close: 'close-up' },
    map: 'Map',
    condition: 'Condition on it',
    sampler: 'Sampler',
    steps: 'k, parts of the command',
    commandAndNoise: 'Command and noise',
    noise: 'n, noise',
    clearance: 'r, clearance',
    effects: {
      v: 'How far it is sent, and so how many walls it may meet.',
      omega: 'Bends the way there: it can end in the open behind a corner.',
      dt: 'How long it drives unwatched between two looks at the map.',
      noise: 'Spreads the cloud: *α*₁ to *α*₄ are *n*, the others *n*/4.',
      clearance: 'Radius of the robot: a wider one fits in fewer places and meets more walls.',
      steps: 'Parts of the command. Each has noise of its own, so that the spread shrinks as 1/√*k*.',
    },
    wedged: (accepted, printed, all, drawn) =>
      `The robot is wedged: ${accepted === 0 ? 'no motion' : `only ${printed} of ${all} motions`} came to an end in the ${drawn} draws that were tried before giving up.`,
    nothing: (count, drawn, wholeArc) =>
      `Nothing was accepted: of the ${drawn} ${plural(count, 'draw')} that ${count === 1 ? 'was' : 'were'} tried, none ${wholeArc ? 'touches no wall on its way' : 'ends where the robot fits'}.`,
    noRoom: 'The robot does not fit where it stands, so that every way from here begins in a wall.',
    /** What is said of a draw that stays: without the condition nothing is judged, so nothing is accepted. */
    accepted: { kept: 'accepted', through: 'accepted through a wall', ofThem: 'through a wall' },
    kept: { kept: 'kept', through: 'kept, way not free', ofThem: 'with a way that is not free' },
    rejected: 'rejected',
    verdict: {
      part: 'one of its parts found no free end',
      end: 'the robot does not fit where it ends',
      free: 'free at the end and all along the way',
      way: 'free at the end, but its way touches a wall or leaves the map',
    },
    byConstruction: '0, by construction',
    counts: (drawn, accepted, kept) =>
      `${drawn} drawn, ${accepted} ${kept}`,
    ofThem: (through, ofThem, share) =>
      `, ${through} of them ${ofThem}: ${share}`,
    apartment: 'The apartment',
    pasted: 'Pasted plan',
    mapText: (name, width, height, walls, printed) =>
      `${name}: ${width} m × ${height} m, ${printed} ${plural(walls, 'wall')}`,
    picture: (map) => `Floor plan from above, x to the right and y up. ${map}.`,
    robotAt: (x, y, theta, command) =>
      `The robot stands at x ${x} m, y ${y} m, heading ${theta} rad. Commanded: ${command}.`,
    outcome: (drawn, accepted, kept, through, ofThem) =>
      `${drawn} drawn; ${accepted} ${kept}, as dots; ${through} of those ${ofThem}, ringed.`,
    rest: 'The rest is rejected, as crosses.',
    robot: 'Robot',
    robotKeys: 'Arrow keys move it; [ and ], or Shift with an arrow key, turn it',
    robotTitle: 'Drag the robot',
    robotText: (x, y) => `x = ${x} m, y = ${y} m`,
    heading: 'Heading of the robot',
    headingKeys: 'Arrow keys turn it',
    headingTitle: 'Turn the robot',
    key: {
      accepted: (kept) => `${kept}, with its heading`,
      through: (through) =>
        `${through}: the way it took, the thin line, is not free, it touches a wall or leaves the map`,
      commanded: 'the command without noise',
    },
    tally: {
      drawn: 'drawn',
      rate: 'acceptance rate',
      rateOfParts: 'acceptance rate of a part',
      draws: (kept) => `draws per ${kept} sample`,
      share: (kept) => `share of the ${kept}`,
      interval: ' (95 %)',
      paths: 'of these, drawn with their path',
      first: (count) => `the first ${count}`,
      tests: (kept) => `wall tests per ${kept} sample`,
    },
    sample: 'Sample',
    markHint: 'Point at one to see its path and the verdict on it.',
    costs: {
      caption:
        'One accepted sample of each sampler under the settings above, timed on this device when nothing moves; and the share of one core that 2000 particles at 20 Hz would take. All is from this one pose, and repeated runs differ by several per cent.',
      sampler: 'sampler',
      draws: 'draws',
      tests: 'wall tests',
      core: 'of a core',
      none: 'not yet measured',
      wedged: 'wedged: not one is accepted',
      few: 'too few are accepted to time',
    },
    own: {
      legend: 'A map of your own',
      text: 'Drop files anywhere on this figure, or choose them here: a floor plan in JSON, or a map of ROS map_server, its YAML file and its PGM or PNG image together. They do not leave this device.',
      files: 'Map files',
      leave: 'Back to the apartment',
      plan: 'Or a floor plan here, in metres',
      use: 'Use this plan',
    },
    /** Why files are refused: the file, the line or field, and what was expected. */
    refused: {
      cannot: (reason) => `The map cannot be opened: ${reason}.`,
      kind: (name) =>
        `${name}: this kind of file is not read; expected is a .json floor plan, or a .yaml file together with its .pgm or .png image.`,
      several: (names, count) =>
        `${names}: these are ${count} maps; expected is one at a time.`,
      noFile: 'No file',
      alone: (name) =>
        `${name}: an image alone has no scale; expected is its .yaml file together with it.`,
      gone: (name, reason) =>
        `${name}: the file cannot be read (${reason}); expected is one that is still there.`,
      plan: (name, reason, form) =>
        `${name}: ${reason}; a floor plan is ${form} in metres.`,
      planForm: (form) => `${form} in metres`,
      yamlForm: 'one field a line, as in resolution: 0.05',
      syntax: (name, line, format, reason, expected) =>
        `${name}${line ? `, line ${line}` : ''}: this is not ${format} (${reason}); expected is ${expected}.`,
      image: (name, value) =>
        `${name}: image is ${value || 'missing'}; expected is the name of a .pgm or .png file.`,
      pair: (name, wanted, given) =>
        `${name}: image names ${wanted}, which is not there${given && ` (${given} came instead)`}; expected are both files together.`,
      fields: (name) =>
        `${name}: there are no fields in it; expected are at least image, resolution and origin.`,
      noPng: (name) =>
        `${name}: its first bytes are not those of a PNG image; expected is PNG.`,
      large: (name, size, side, pixels) =>
        `${name}: width × height is ${size}; expected are sides up to ${side} and at most ${pixels} pixels.`,
      broken: (name) =>
        `${name}: the image data cannot be decoded; expected is a complete PNG image.`,
      line: (name, line, reason) =>
        `${name}, line ${line}: ${reason}.`,
      cells: (name, reason) =>
        `${name}: its occupied cells have too many sides: ${reason}.`,
    },
  },
});
