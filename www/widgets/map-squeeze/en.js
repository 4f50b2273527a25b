/** Map Squeeze in English; see messages/en.js. */

import { plural } from '../../messages/en.js';

export const en = /** @satisfies {import('../../messages/registry.js').Message} */ ({
  title: 'Map Squeeze',
  keyAndSample: 'What is drawn',
  countsLabel: 'Counts and costs',
  presets: { doorway: 'Facing a doorway', wall: 'Facing a wall', corridor: 'Open corridor' },
  samplers: { endpoint: 'endpoint', 'whole-arc': 'whole arc', 'sub-stepped': 'sub-stepped' },
  samplerEffects: {
    endpoint: 'Keeps a draw if the robot fits where it ends; nobody asks how it got there.',
    'whole-arc': 'Keeps a draw if the robot touches no wall all along the arc it drove.',
    'sub-stepped':
      'Splits the command into *k* parts, and keeps a part if the robot fits where that ends.',
    off: 'Off: every draw is kept, wherever it ends.',
  },
  settings: {
    v: { effect: 'How far it is sent, and so how many walls it may meet.' },
    omega: { effect: 'Bends the way there: it can end in the open behind a corner.' },
    dt: { effect: 'How long it drives unwatched between two looks at the map.' },
    noise: { name: 'noise', effect: 'Spreads the cloud: *α*₁ to *α*₄ are *n*, the others *n*/4.' },
    clearance: { name: 'clearance', effect: 'Radius of the robot: a wider one fits in fewer places and meets more walls.' },
    unknown: { name: 'Unknown cells' },
    sampler: { name: 'Sampler' },
    steps: { name: 'parts of the command', effect: 'Sub-stepped: parts of the command, each with noise of its own.' },
    samples: { name: 'samples', effect: 'Motions tried: more of them narrow the interval of the share through a wall.' },
    view: { name: 'View' },
  },
  place: 'Place',
  unknown: { free: 'free', blocked: 'blocked' },
  views: { whole: 'whole map', close: 'close-up' },
  map: 'Map',
  mapNotInCode: 'The code is without your map: a page gives that to the property map.',
  condition: 'Condition on the map',
  commandAndNoise: 'Command, noise and parts',
  wedged: (drawn, accepted, printed, all, through) =>
    `The robot is wedged: in ${drawn} draws of parts ${accepted === 0 ? 'no motion came to its end' : `only ${printed} of ${all} motions came to their end; ${through}`}.`,
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
  /** What the picture shows, in one sentence: what was tested, and how many came through a wall all the same. */
  tested: {
    endpoint: (accepted, all) => `${accepted} of ${all} motions end where the robot fits and are accepted`,
    'whole-arc': (accepted, all) => `${accepted} of ${all} motions keep clear of walls all the way and are accepted`,
    'sub-stepped': (accepted, all) => `${accepted} of ${all} motions end, part by part, where the robot fits and are accepted`,
    off: (accepted) => `Without the map all ${accepted} motions are kept`,
  },
  throughOf: (count, through, share) =>
    count === 0 ? 'none of them went through a wall' : `${through} of them, ${share}, went through a wall`,
  verdictOf: (tested, through) => `${tested}; ${through}.`,
  noneYet: 'No motion has been tried yet.',
  apartment: 'The apartment',
  pasted: 'Pasted plan',
  mapText: (name, width, height, walls, printed) =>
    `${name}: ${width} m × ${height} m, ${printed} ${plural(walls, 'wall')}`,
  picture: (map) => `Floor plan from above, x to the right and y up. ${map}.`,
  robotAt: (x, y, theta, command) =>
    `The robot stands at x ${x} m, y ${y} m, heading ${theta} rad. Commanded: ${command}.`,
  outcome: (drawn, parts, accepted, kept, through, ofThem, density) =>
    `${drawn} ${parts ? 'parts ' : ''}drawn; ${accepted} ${parts ? 'motions ' : ''}${kept}, as ${density ? 'a density' : 'dots'}; ${through} of those ${ofThem}${density ? '' : ', ringed'}.`,
  rest: (density) => `The rest is rejected${density ? '' : ', as crosses'}.`,
  robot: {
    robot: 'Robot',
    robotTitle: 'Drag the robot',
    heading: 'Heading of the robot',
    headingTitle: 'Turn the robot',
    ends: 'The map ends here',
  },
  rates: {
    accepted: 'accepted',
    ofParts: 'accepted, of all parts drawn',
    kept: 'kept',
    through: 'of these, through a wall',
    interval: 'of these, through a wall (95\u202f% interval)',
  },
  key: {
    density: 'So many are a density, the darker the more: each spot has the colour of what most there are.',
    unknown: 'unknown: the map says nothing',
    overview: 'In the corner: the whole map, and the part of it that is shown.',
    accepted: (kept) => `${kept}, with its heading`,
    through: (through) =>
      `${through}: its way, the thin line, touches a wall or leaves the map`,
    commanded: 'the command without noise',
  },
  tally: {
    drawn: 'drawn',
    draws: (kept) => `draws needed for one ${kept}`,
    paths: 'of these, path drawn for',
    first: (count) => `the first ${count}`,
    tests: (kept) => `wall distances computed for one ${kept}`,
  },
  sample: 'Sample',
  markHint: 'Point at one to see its path and the verdict on it.',
  costs: {
    caption:
      'One accepted sample of each sampler under the settings above, timed on this device when nothing moves; and the share of a core that 2000 particles at 20 Hz would take. All from this pose; repeated runs differ by several per cent.',
    sampler: 'sampler',
    draws: 'draws',
    tests: 'wall distances',
    core: 'of a core',
    none: 'not yet measured',
    wedged: 'wedged: not one is accepted',
    few: 'too few are accepted to time',
  },
  own: {
    reading: 'Reading the map …',
    legend: 'A map of your own',
    text: 'Drop files anywhere on this figure, or choose them here: a floor plan in JSON, or a map of ROS map_server, its YAML file and its PGM or PNG image together. They do not leave this device.',
    files: 'Map files',
    open: 'In the open',
    leave: 'Back to the apartment',
    back: (name) => `Back to ${name}`,
    plan: 'Or a floor plan here, in metres',
    use: 'Use this plan',
  },
  /** Why files are refused: the file, the line or field, and what was expected. */
  refused: {
    cannot: (reason) => `The map cannot be opened: ${reason}.`,
    kind: (name) =>
      `${name}: this kind of file is not read; expected is a .json floor plan, or a .yaml file together with its .pgm or .png image.`,
    several: (names, count) => `${names}: these are ${count} maps; expected is one at a time.`,
    noFile: 'No file',
    alone: (name) => `${name}: an image alone has no scale; expected is its .yaml file together with it.`,
    gone: (name, reason) => `${name}: the file cannot be read (${reason}); expected is one that is still there.`,
    long: (name, bytes, most) => `${name}: the file has ${bytes} bytes; expected are at most ${most}.`,
    plan: (name, reason, form) => `${name}: ${reason}; a floor plan is ${form} in metres.`,
    planForm: (form) => `${form} in metres`,
    yamlForm: 'one field a line, as in resolution: 0.05',
    syntax: (name, line, format, reason, expected) =>
      `${name}${line ? `, line ${line}` : ''}: this is not ${format} (${reason}); expected is ${expected}.`,
    image: (name, value) => `${name}: image is ${value || 'missing'}; expected is the name of a .pgm or .png file.`,
    pair: (name, wanted, given) =>
      `${name}: image names ${wanted}, which is not there${given && ` (${given} came instead)`}; expected are both files together.`,
    fields: (name) => `${name}: there are no fields in it; expected are at least image, resolution and origin.`,
    broken: (name, reason) => `${name}: ${reason}.`,
    line: (name, line, reason) => `${name}, line ${line}: ${reason}.`,
  },
});
